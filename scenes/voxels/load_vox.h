// Loads a MagicaVoxel .vox file into a scene: a grid for each model that is shown, and instances that place
// it. Before: load_scene, scene_document_voxels. After: Scene::voxel_grids.
#pragma once

#include <filesystem>
#include <vector>

#include "scenes/model/scene.h"

namespace herr {

inline constexpr double kVoxSize_m = 0.1;  // of a voxel of a .vox file, as MagicaVoxel exports meshes

// Instances in voxels, y up, x to the right, standing as they do in MagicaVoxel: its origin is theirs. All
// have one new matte material. Throws InputError for anything that is wrong with the file.
std::vector<Instance> append_vox(const std::filesystem::path& file, Scene& scene);

// Appends the material that voxels have where nothing else is said: white times the voxels' own colours.
std::uint32_t append_voxel_material(const std::string& name, Scene& scene);

}  // namespace herr
