// An octree as the traversal kernels read it: plain pointers and tables. Before: voxel_octree. After:
// voxel_traversal.
#pragma once

#include <array>
#include <cstdint>

#include "renderer/voxels/voxel_octree.h"

namespace herr {

struct VoxelView {
  const std::uint32_t* blocks = nullptr;
  const std::uint32_t* masks = nullptr;
  const std::uint32_t* voxels = nullptr;     // colours of level 0
  const std::uint32_t* colours = nullptr;    // and of the levels above, from their first brick on
  const std::uint32_t* opacities = nullptr;  // likewise
  const float* linear_of_srgb = nullptr;
  std::int32_t first_upper_brick = 0;
  std::array<std::int32_t, 3> counts{};
  std::int32_t top_level = 0;
  // Per level: where its blocks begin, blocks along x, blocks along x and y.
  std::array<std::int32_t, kMostVoxelLevels> first_block{}, row{}, slab{};
};

VoxelView view_of(const VoxelOctree& octree);

}  // namespace herr
