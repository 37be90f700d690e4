// Loads a glTF file into a scene: its meshes, materials and textures are appended, its instances returned, so
// that a scene document can place the same file several times. Before: load_scene, scene_document.
#pragma once

#include <filesystem>
#include <vector>

#include "scenes/scene.h"

namespace herr {

// `mesh` and `material` of the instances are indices into `scene`; world_from_object is relative to the
// glTF's root. Throws InputError for anything that is wrong with the file; other exceptions of the libraries
// become InputErrors.
std::vector<MeshInstance> append_gltf(const std::filesystem::path& file, Scene& scene);

}  // namespace herr
