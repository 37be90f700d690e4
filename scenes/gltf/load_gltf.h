// Loads a glTF file into a scene: its meshes, materials and textures are appended, its instances and lights
// returned, so that a scene document can place the same file several times. Before: load_scene,
// scene_document.
#pragma once

#include <filesystem>
#include <vector>

#include "scenes/gltf/animated_models.h"
#include "scenes/model/scene.h"
#include "scenes/model/texture_pixels.h"

namespace herr {

// What a file shows, relative to its root. `mesh` and `material` of the instances are indices into the scene.
struct GltfContent {
  std::vector<Instance> instances;
  std::vector<AreaLight> lights;
};

// `playback`: which animation plays; the instances stand as it has them at time 0. Throws
// InputError for anything that is wrong with the file; other exceptions of the libraries become
// InputErrors, but for ModuleError.
GltfContent append_gltf(const std::filesystem::path& file, Scene& scene, const PlaybackRequest& playback = {},
                        TexturePixels pixels = TexturePixels::decoded);

}  // namespace herr
