// A regular grid of coloured voxels, kept as bricks of 4x4x4: a block without voxels costs four bytes.
// Before: load_vox, raw_grid and voxelise_mesh fill one. After: Scene::voxel_grids, renderer/geometry builds
// an octree over it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace herr {

inline constexpr int kBrickSide = 4;
inline constexpr std::uint32_t kNoBrick = ~0u;
inline constexpr int kMostVoxelsAlong = 1024;  // of a grid, per axis

// Object space is counted in voxels: voxel (x, y, z) fills [x, x + 1] x [y, y + 1] x [z, z + 1].
struct VoxelGrid {
  // Voxel (x, y, z) at x + 4 (y + 4 z), coordinates within the brick.
  using Brick = std::array<std::uint32_t, kBrickSide * kBrickSide * kBrickSide>;

  std::string name;
  glm::ivec3 counts{1};  // voxels per axis, 1 ... kMostVoxelsAlong
  // Per block of the grid, x fastest, then y, then z: which brick, or kNoBrick where there is no voxel.
  std::vector<std::uint32_t> brick_of;
  // RGBA8, R in the low byte: sRGB, not premultiplied; A = coverage, 0 = no voxel.
  std::vector<Brick> bricks;

  // Makes an empty grid. `most_along` of the counts is the caller's to check.
  void allocate(const glm::ivec3& voxel_counts);
  glm::ivec3 blocks() const { return (counts + (kBrickSide - 1)) / kBrickSide; }
  std::size_t block_index(const glm::ivec3& block) const;
  static std::size_t place_in_brick(const glm::ivec3& voxel);
  // 0 where there is none. The voxel must lie within the grid.
  std::uint32_t at(const glm::ivec3& voxel) const;
  // Makes the voxel's brick when it has none; `rgba` may be 0.
  void set(const glm::ivec3& voxel, std::uint32_t rgba);

  std::int64_t voxels() const;  // those with coverage
  std::int64_t bytes() const;   // of bricks and blocks
};

// Blocks of a grid of these counts.
std::int64_t block_count(const glm::ivec3& voxel_counts);

}  // namespace herr
