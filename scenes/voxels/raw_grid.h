// A raw grid: a small JSON header, *.voxels.json, that names a file of RGBA8 values beside it. README.md of
// this folder has the format. Before: scene_document_voxels. After: Scene::voxel_grids.
#pragma once

#include <cstdint>
#include <filesystem>

#include "scenes/model/scene.h"

namespace herr {

struct RawGrid {
  std::uint32_t grid = 0;   // index into Scene::voxel_grids
  double voxel_size_m = 1;  // edge of a voxel
};

// Appends the grid. Throws InputError for anything that is wrong with either file.
RawGrid append_raw_grid(const std::filesystem::path& header, Scene& scene);

}  // namespace herr
