#include "renderer/voxels/voxel_view.h"

namespace herr {
VoxelView view_of(const VoxelOctree& octree) {
  VoxelView view;
  const VoxelGrid& grid = octree.grid();
  view.blocks = octree.blocks().data();
  view.masks = octree.masks().data();
  view.voxels = grid.bricks.empty() ? nullptr : grid.bricks.front().data();
  view.colours = octree.colours().data();
  view.opacities = octree.opacities().data();
  view.linear_of_srgb = linear_of_srgb().data();
  view.first_upper_brick = static_cast<std::int32_t>(grid.bricks.size());
  view.counts = {grid.counts.x, grid.counts.y, grid.counts.z};
  view.top_level = octree.levels() - 1;
  for (int k = 0; k < octree.levels(); ++k) {
    const VoxelOctree::Level& level = octree.level(k);
    const auto i = static_cast<std::size_t>(k);
    view.first_block[i] = level.first_block;
    view.row[i] = level.blocks.x;
    view.slab[i] = level.blocks.x * level.blocks.y;
  }
  return view;
}

}  // namespace herr
