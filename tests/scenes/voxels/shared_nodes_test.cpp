// Shapes and groups of a .vox scene graph that have several parents: shown below each, and bounded.
#include <gtest/gtest.h>

#include "scenes/voxels/vox_graph.h"
#include "tests/scenes/voxels/vox_files.h"

namespace herr::test {
namespace {

std::string block(int side) {
  std::vector<std::array<std::uint8_t, 4>> voxels;
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        voxels.push_back(
            {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(z), 216});
      }
    }
  }
  return vox_model(side, side, side, voxels);
}

VoxShow show_of(const std::string& bytes) {
  const VoxFile vox = parse_vox(bytes, "model.vox");
  return placed_models(vox, "model.vox");
}

std::string show_error(const std::string& bytes) {
  try {
    show_of(bytes);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

// `levels` groups, each holding the next one twice, above what `leaf` holds under the number `levels`.
std::string doubling_groups(int levels, const std::string& leaf) {
  std::string graph;
  for (int i = 0; i < levels; ++i) graph += vox_group(i, {i + 1, i + 1});
  return graph + leaf;
}

TEST(VoxSharedNodes, AShapeBelowTwoTransformsStandsInBothPlaces) {
  // A model of 4 voxels a side turns about its voxel (2, 2, 2), so that it reaches from -2 to 2 about its
  // place. Places at -5, 0, 2 and 5, 0, 2 voxels of 0.1 m: x from -0.7 to -0.3 and from 0.3 to 0.7, z (up)
  // from 0 to 0.4, y from -0.2 to 0.2; with y up that is y from 0 to 0.4 and z from -0.2 to 0.2. 2 times 64
  // voxels.
  const std::string graph = vox_transform(0, 1, {}) + vox_group(1, {2, 3}) +
                            vox_transform(2, 4, {{"_t", "-5 0 2"}}) + vox_transform(3, 4, {{"_t", "5 0 2"}}) +
                            vox_shape(4, 0);
  const TemporaryFolder folder;
  const Scene scene = load_scene(folder.write("two.vox", vox_bytes(block(4) + graph)));
  ASSERT_EQ(scene.instances.size(), 2u);
  ASSERT_EQ(scene.voxel_grids.size(), 1u);
  EXPECT_EQ(scene.voxel_grids[0].voxels(), 64);
  const double lower_x[2] = {-0.7, 0.3};
  for (int i = 0; i < 2; ++i) {
    const glm::dmat4x3& placed = scene.instances[static_cast<std::size_t>(i)].world_from_object;
    const glm::dvec3 a = placed * glm::dvec4(0, 0, 0, 1), b = placed * glm::dvec4(4, 4, 4, 1);
    const glm::dvec3 lower = glm::min(a, b), upper = glm::max(a, b);
    EXPECT_NEAR(lower.x, lower_x[i], 1e-12);
    EXPECT_NEAR(upper.x, lower_x[i] + 0.4, 1e-12);
    EXPECT_NEAR(lower.y, 0, 1e-12);
    EXPECT_NEAR(upper.y, 0.4, 1e-12);
    EXPECT_NEAR(lower.z, -0.2, 1e-12);
    EXPECT_NEAR(upper.z, 0.2, 1e-12);
  }
}

TEST(VoxSharedNodes, AGroupBelowTwoTransformsIsShownWholeBelowEach) {
  // Two places of a group that holds the model at +1 and -1: x at 10 + 1, 10 - 1, -10 + 1, -10 - 1, in the
  // file's order, each with the name of the nearest transform that has one.
  const std::string graph =
      vox_group(0, {1, 2}) + vox_transform(1, 3, {{"_t", "10 0 0"}}, {{"_name", "right"}}) +
      vox_transform(2, 3, {{"_t", "-10 0 0"}}, {{"_name", "left"}}) + vox_group(3, {4, 5}) +
      vox_transform(4, 6, {{"_t", "1 0 0"}}) + vox_transform(5, 6, {{"_t", "-1 0 0"}}) + vox_shape(6, 0);
  const VoxShow show = show_of(vox_bytes(block(1) + graph));
  const double expected[4] = {11, 9, -9, -11};
  ASSERT_EQ(show.models.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(show.models[i].vox_from_model[3].x, expected[i]) << i;
    EXPECT_EQ(show.models[i].name, i < 2 ? "right" : "left");
  }
}

TEST(VoxSharedNodes, HiddenBelowOneParentIsShownBelowTheOther) {
  const std::string graph = vox_group(0, {1, 2}) + vox_transform(1, 3, {}, {{"_hidden", "1"}}) +
                            vox_transform(2, 3, {}) + vox_group(3, {4, 4, 4}) + vox_shape(4, 0);
  const VoxShow show = show_of(vox_bytes(block(1) + graph));
  EXPECT_EQ(show.models.size(), 3u);
  EXPECT_EQ(show.hidden, 3);
}

TEST(VoxSharedNodes, GroupsThatDoubleAreRefusedBeyondAMillionModels) {
  // Nineteen doublings are 524,288 models, twenty are 1,048,576 and too many; sixty-four would not end.
  EXPECT_EQ(show_of(vox_bytes(block(1) + doubling_groups(19, vox_shape(19, 0)))).models.size(), 524288u);
  const std::string message = show_error(vox_bytes(block(1) + doubling_groups(20, vox_shape(20, 0))));
  EXPECT_TRUE(contains(message, "places 1048576 models")) << message;
  const std::string endless = show_error(vox_bytes(block(1) + doubling_groups(64, vox_shape(64, 0))));
  EXPECT_TRUE(contains(endless, "places more than 2^60 models")) << endless;
}

TEST(VoxSharedNodes, PlacedVoxelsAreBoundedToo) {
  // 64^3 voxels are 2^18; shown 2^19 times they are 2^37, above the limit of 2^36.
  const std::string message = show_error(vox_bytes(block(64) + doubling_groups(19, vox_shape(19, 0))));
  EXPECT_TRUE(contains(message, "places 137438953472 voxels")) << message;
}

TEST(VoxSharedNodes, GroupsThatDoubleAndShowNothingCostNothing) {
  // An empty group, or a hidden one, below sixty doublings: walked node by node it would not end.
  EXPECT_TRUE(show_of(vox_bytes(block(1) + doubling_groups(60, vox_group(60, {})))).models.empty());
  const VoxShow hidden =
      show_of(vox_bytes(block(1) + doubling_groups(10, vox_transform(10, 11, {}, {{"_hidden", "1"}}) +
                                                           doubling_groups(0, vox_shape(11, 0)))));
  EXPECT_TRUE(hidden.models.empty());
  EXPECT_EQ(hidden.hidden, 1024);
}

TEST(VoxSharedNodes, DepthCountsAlongTheLongestWay) {
  // Node 1 lies 40 nodes above the shape and is met first directly below the root, then below 30 groups more.
  std::string graph = vox_group(0, {1, 100});
  for (int i = 1; i < 41; ++i) graph += vox_group(i, {i + 1});
  for (int i = 100; i < 130; ++i) graph += vox_group(i, {i < 129 ? i + 1 : 1});
  const std::string message = show_error(vox_bytes(block(1) + graph + vox_shape(41, 0)));
  EXPECT_TRUE(contains(message, "deeper than 64 nodes")) << message;
}

}  // namespace
}  // namespace herr::test
