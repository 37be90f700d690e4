// The octree of a grid: what its levels keep of the voxels below.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vector_relational.hpp>
#include <random>

#include "renderer/voxels/voxel_octree.h"
#include "tests/renderer/voxels/voxel_grids.h"

namespace herr::test {
namespace {

// Word of a node above level 0; none where there is no node.
std::optional<std::uint32_t> word_at(const VoxelOctree& octree, int k, const glm::ivec3& node,
                                     const std::vector<std::uint32_t>& words) {
  const VoxelOctree::Level& level = octree.level(k);
  const glm::ivec3 block = node / kBrickSide;
  const std::uint32_t brick = octree.blocks()[static_cast<std::size_t>(
      level.first_block + block.x + level.blocks.x * (block.y + level.blocks.y * block.z))];
  if ((brick & kEmptyBlock) != 0) return std::nullopt;
  const std::size_t place = VoxelGrid::place_in_brick(node);
  if ((octree.masks()[2 * std::size_t{brick} + place / 32] >> place % 32 & 1) == 0) return std::nullopt;
  return words[64 * (std::size_t{brick} - octree.grid().bricks.size()) + place];
}

template <typename Visit>
void for_each_node(const glm::ivec3& counts, const Visit& visit) {
  for (int z = 0; z < counts.z; ++z) {
    for (int y = 0; y < counts.y; ++y) {
      for (int x = 0; x < counts.x; ++x) visit(glm::ivec3{x, y, z});
    }
  }
}

double linear(std::uint32_t rgba, int channel) {
  return double{linear_of_srgb()[rgba >> (8 * channel) & 255]};
}

TEST(VoxelOctree, EveryNodeIsTheMeanOfTheVoxelsInItsCube) {
  // Coverage in 8 bits is off by half a step, and so is a colour in sRGB; its slope is 2.4 / 1.055 at most,
  // so the linear value is off by 0.5 / 255 * 2.3.
  std::mt19937 random(11);
  SCOPED_TRACE("seed 11");
  for (const glm::ivec3 counts : {glm::ivec3{16, 16, 16}, glm::ivec3{13, 7, 21}, glm::ivec3{1, 30, 2}}) {
    const VoxelGrid grid = voxel_grid(
        counts, [&](int, int, int) { return random() % 3 == 0 ? static_cast<std::uint32_t>(random()) : 0u; });
    const VoxelOctree octree(grid);
    for (int k = 1; k < octree.levels(); ++k) {
      for_each_node(octree.level(k).nodes, [&](const glm::ivec3& node) {
        double coverage = 0;
        glm::dvec3 colour{0.0};
        for_each_node(glm::ivec3(1 << k), [&](const glm::ivec3& within) {
          const glm::ivec3 voxel = (1 << k) * node + within;
          if (glm::any(glm::greaterThanEqual(voxel, counts))) return;
          const std::uint32_t rgba = grid.at(voxel);
          const double alpha = static_cast<double>(rgba >> 24) / 255 / std::pow(8.0, k);
          coverage += alpha;
          for (int c = 0; c < 3; ++c) colour[c] += alpha * linear(rgba, c);
        });
        const auto word = word_at(octree, k, node, octree.colours());
        ASSERT_EQ(word.has_value(), coverage > 0);
        if (!word) return;
        EXPECT_NEAR(static_cast<double>(*word >> 24) / 255, coverage, 0.5 / 255 + 1e-6);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(linear(*word, c), colour[c] / coverage, 0.5 / 255 * 2.3);
      });
    }
  }
}

TEST(VoxelOctree, CoverageAddsUpToThatOfTheGridAtEveryLevel) {
  // Rounding to bytes moves each node by at most 0.5 / 255.
  const VoxelGrid grid = holed_ball(50, 6);
  const VoxelOctree octree(grid);
  for (int k = 1; k < octree.levels(); ++k) {
    double sum = 0;
    int nodes = 0;
    for_each_node(octree.level(k).nodes, [&](const glm::ivec3& node) {
      if (const auto word = word_at(octree, k, node, octree.colours())) {
        sum += static_cast<double>(*word >> 24) / 255 * std::pow(8.0, k);
        ++nodes;
      }
    });
    const auto voxels = static_cast<double>(grid.voxels());
    EXPECT_NEAR(sum, voxels, std::pow(8.0, k) * 0.5 / 255 * nodes + 1e-3) << "level " << k;
  }
}

TEST(VoxelOctree, AWallIsOpaqueAcrossItselfAndThinAlongItself) {
  // One layer of 16 x 16 voxels at x = 5. At level k its nodes hide all along x, and 1 of 2^k along y and z.
  const VoxelGrid grid = voxel_grid({16, 16, 16}, [](int x, int, int) { return x == 5 ? 0xff808080u : 0u; });
  const VoxelOctree octree(grid);
  for (int k = 1; k < octree.levels(); ++k) {
    const auto word = word_at(octree, k, {5 >> k, 0, 0}, octree.opacities());
    ASSERT_TRUE(word.has_value());
    EXPECT_EQ(*word & 255, 255u);
    EXPECT_EQ(*word >> 8 & 255, static_cast<std::uint32_t>(std::lround(255.0 / (1 << k))));
    EXPECT_EQ(*word >> 16 & 255, *word >> 8 & 255);
  }
}

TEST(VoxelOctree, EmptyCubesAreAsLargeAsTheyCanBe) {
  // One voxel in a corner of 64^3: the block at level 0 that lies farthest is (15, 15, 15). Its cube of 4
  // doubles to 8, 16 and 32; the whole grid of 64 has the voxel in it.
  const VoxelGrid grid =
      voxel_grid({64, 64, 64}, [](int x, int y, int z) { return x + y + z == 0 ? ~0u : 0u; });
  const VoxelOctree octree(grid);
  EXPECT_EQ(octree.blocks()[16 * 16 * 16 - 1], kEmptyBlock | 3);
  EXPECT_EQ(octree.blocks()[0], 0u);
  // Its neighbour along x shares every larger cube with the voxel.
  EXPECT_EQ(octree.blocks()[1], kEmptyBlock | 0);
}

TEST(VoxelOctree, GridsOfOneVoxelOfNoneAndOfAll) {
  const VoxelGrid one = voxel_grid({1, 1, 1}, [](int, int, int) { return ~0u; });
  EXPECT_EQ(VoxelOctree(one).levels(), 1);
  const VoxelGrid none = voxel_grid({40, 3, 9}, [](int, int, int) { return 0u; });
  const VoxelOctree empty(none);
  EXPECT_TRUE(empty.colours().empty());
  for (const std::uint32_t block : empty.blocks()) EXPECT_NE(block & kEmptyBlock, 0u);
  const VoxelGrid all = voxel_grid({8, 8, 8}, [](int, int, int) { return 0xff0000ffu; });
  const VoxelOctree full(all);
  EXPECT_EQ(full.levels(), 4);
  EXPECT_EQ(word_at(full, 3, {0, 0, 0}, full.colours()), 0xff0000ffu);
  EXPECT_EQ(word_at(full, 3, {0, 0, 0}, full.opacities()), 0x00ffffffu);
}

TEST(VoxelOctree, BlocksWithoutVoxelsCostFourBytesPerLevel) {
  const VoxelGrid grid =
      voxel_grid({256, 256, 256}, [](int x, int y, int z) { return x + y + z == 0 ? ~0u : 0u; });
  // 64^3 + 32^3 + ... + 1 blocks of 4 bytes (level 7 and 8 have one block too); 9 bricks of 8 bytes of mask,
  // 8 of them with 64 nodes of 8 bytes.
  std::int64_t blocks = 0;
  for (const std::int64_t side : {64, 32, 16, 8, 4, 2, 1, 1, 1}) blocks += side * side * side;
  EXPECT_EQ(VoxelOctree(grid).bytes(), 4 * blocks + 9 * 8 + 8 * 64 * 8);
}

}  // namespace
}  // namespace herr::test
