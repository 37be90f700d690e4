// The octree over a grid of voxels, stored level by level: level 0 is the grid, a node of level k is a cube
// of 2^k voxels along each side. Every level is kept as bricks of 4x4x4 nodes; a block without voxels costs
// four bytes. A node holds the mean of its eight children, empty ones included: colour weighted by coverage,
// and coverage. A wall that fills half of a node still hides everything behind it, so a node also holds its
// opacity along x, y and z (after Crassin et al., "Interactive Indirect Illumination Using Voxel Cone
// Tracing", 2011). Before: Scene::voxel_grids. After: voxel_traversal.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scenes/model/voxel_grid.h"

namespace herr {

inline constexpr int kMostVoxelLevels = 11;  // 2^10 = kMostVoxelsAlong
// A block of the octree without a node: this bit, and in the lower ones how many times the empty cube around
// it can be doubled.
inline constexpr std::uint32_t kEmptyBlock = 0x80000000u;

class VoxelOctree {
 public:
  // `grid` must outlive the octree: its colours are level 0.
  explicit VoxelOctree(const VoxelGrid& grid);

  struct Level {
    glm::ivec3 nodes{1}, blocks{1};
    std::int32_t first_block = 0;  // in blocks()
  };
  int levels() const { return static_cast<int>(levels_.size()); }  // the last has one node
  const Level& level(int k) const { return levels_[static_cast<std::size_t>(k)]; }
  const VoxelGrid& grid() const { return *grid_; }

  // Brick of each block, x fastest, all levels one after the other: those of the grid first.
  const std::vector<std::uint32_t>& blocks() const { return blocks_; }
  // Two words for each brick: bit x + 4 (y + 4 z) is set where there is a node.
  const std::vector<std::uint32_t>& masks() const { return masks_; }
  // Of bricks above level 0, 64 nodes each: mean colour (sRGB, not premultiplied) and coverage as RGBA8;
  // opacity along x, y and z in the three low bytes.
  const std::vector<std::uint32_t>& colours() const { return colours_; }
  const std::vector<std::uint32_t>& opacities() const { return opacities_; }

  std::int64_t bytes() const;  // without the grid's own

 private:
  // A node before it is rounded to bytes. Null columns: no node.
  struct Node {
    glm::vec3 premultiplied{0.0f};  // linear light
    float coverage = 0;
    // What hides along each axis, voxel by voxel of the node's face: 3 faces of 4^k bytes.
    const std::uint8_t* columns = nullptr;
  };
  struct Nodes {
    std::vector<std::array<Node, 64>> bricks;
    std::vector<std::uint8_t> columns;  // of all nodes with coverage
  };

  void add_grid();
  void add_level(const Nodes& finer, Nodes& coarser);
  Node child(const Nodes& finer, std::uint32_t brick, std::size_t place,
             std::array<std::uint8_t, 3>& own) const;
  std::uint32_t add_brick();
  void store(std::uint32_t brick, std::size_t place, const Node& node, int k);
  std::size_t block_index(int level, const glm::ivec3& block) const;
  bool has_node(int level, const glm::ivec3& node) const;
  void measure_empty_blocks();

  const VoxelGrid* grid_;
  std::vector<Level> levels_;
  std::vector<std::uint32_t> blocks_, masks_, colours_, opacities_;
};

// Linear light of an sRGB byte.
const std::array<float, 256>& linear_of_srgb();

}  // namespace herr
