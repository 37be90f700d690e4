#include "scenes/model/voxel_grid.h"

namespace herr {

void VoxelGrid::allocate(const glm::ivec3& voxel_counts) {
  counts = voxel_counts;
  brick_of.assign(static_cast<std::size_t>(block_count(counts)), kNoBrick);
  bricks.clear();
}

std::size_t VoxelGrid::block_index(const glm::ivec3& block) const {
  const glm::ivec3 n = blocks();
  return static_cast<std::size_t>(block.x) +
         static_cast<std::size_t>(n.x) * (static_cast<std::size_t>(block.y) +
                                          static_cast<std::size_t>(n.y) * static_cast<std::size_t>(block.z));
}

std::size_t VoxelGrid::place_in_brick(const glm::ivec3& voxel) {
  constexpr int kWithin = kBrickSide - 1;
  return static_cast<std::size_t>((voxel.x & kWithin) + kBrickSide * (voxel.y & kWithin) +
                                  kBrickSide * kBrickSide * (voxel.z & kWithin));
}

std::uint32_t VoxelGrid::at(const glm::ivec3& voxel) const {
  const std::uint32_t brick = brick_of[block_index(voxel / kBrickSide)];
  return brick == kNoBrick ? 0 : bricks[brick][place_in_brick(voxel)];
}

void VoxelGrid::set(const glm::ivec3& voxel, std::uint32_t rgba) {
  std::uint32_t& brick = brick_of[block_index(voxel / kBrickSide)];
  if (brick == kNoBrick) {
    brick = static_cast<std::uint32_t>(bricks.size());
    bricks.emplace_back().fill(0);
  }
  bricks[brick][place_in_brick(voxel)] = rgba;
}

std::int64_t VoxelGrid::voxels() const {
  std::int64_t count = 0;
  for (const Brick& brick : bricks) {
    for (const std::uint32_t rgba : brick) count += rgba >> 24 != 0 ? 1 : 0;
  }
  return count;
}

std::int64_t VoxelGrid::bytes() const {
  return static_cast<std::int64_t>(brick_of.size() * sizeof(brick_of[0]) + bricks.size() * sizeof(Brick));
}

std::int64_t block_count(const glm::ivec3& voxel_counts) {
  const glm::ivec3 n = (voxel_counts + (kBrickSide - 1)) / kBrickSide;
  return std::int64_t{n.x} * n.y * n.z;
}

}  // namespace herr
