// `voxels` of a scene document: MagicaVoxel files, raw grids, and glTF meshes made of voxels, each
// placed in the scene. Before: scene_document walks the document. After: Scene::voxel_grids and
// instances of kind voxels.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "scenes/model/scene.h"
#include "sessions/files/strict_json.h"

namespace herr {

// A file that several entries name is read once; it may lie below one of `asset_roots` (named_file.h). Throws
// InputError that names the field or the file.
void append_voxel_entries(const std::vector<JsonObject>& entries,
                          std::span<const std::filesystem::path> asset_roots, Scene& scene);

}  // namespace herr
