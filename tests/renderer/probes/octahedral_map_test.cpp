// The octahedral map: there and back, seams included; planes without error; its density; ray sets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "renderer/probes/octahedral_map.h"
#include "renderer/probes/probe_grid.h"
#include "renderer/probes/probe_rays.h"
#include "tests/renderer/probes/scalar_probes.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
}

TEST(OctahedralMapTest, ADirectionComesBack) {
  std::mt19937 random(1);
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < 1000; ++i) directions.push_back(random_direction(random));
  for (int axis = 0; axis < 3; ++axis) {  // axes, folds and seams, also with negative zeros
    for (const double sign : {1.0, -1.0}) {
      glm::dvec3 d{-0.0};
      d[axis] = sign;
      directions.push_back(d);
      d[(axis + 1) % 3] = -sign;
      directions.push_back(glm::normalize(d));
    }
  }
  for (const glm::dvec3& d : directions) {
    const glm::dvec2 place = octahedral_from_direction(2.5 * d);
    EXPECT_LE(std::max(std::abs(place.x), std::abs(place.y)), 1.0);
    EXPECT_LT(glm::distance(direction_from_octahedral(place), d), 1e-15 * 8)
        << d.x << " " << d.y << " " << d.z;
  }
}

TEST(OctahedralMapTest, NodesOfOneDirectionAreOne) {
  using Nodes = OctahedralNodes<8>;
  std::set<int> firsts;
  for (int node = 0; node < Nodes::kCount; ++node) {
    const int first = Nodes::first_of(node);
    EXPECT_LE(first, node);
    EXPECT_EQ(Nodes::first_of(first), first);
    EXPECT_LT(glm::distance(Nodes::direction(node), Nodes::direction(first)), 1e-15) << node;
    firsts.insert(first);
  }
  EXPECT_EQ(static_cast<int>(firsts.size()), Nodes::kDirections);
  for (const int a : firsts) {
    for (const int b : firsts) {
      if (a == b) continue;
      EXPECT_GT(glm::distance(Nodes::direction(a), Nodes::direction(b)), 0.1);
    }
  }
}

// The whole sphere is 4 pi: the density summed over the map's square of side 2 by the midpoint rule.
TEST(OctahedralMapTest, ItsDensityCoversTheSphere) {
  constexpr int kSteps = 400;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      sum += octahedral_density({(2 * i + 1.0) / kSteps - 1, (2 * j + 1.0) / kSteps - 1});
    }
  }
  EXPECT_NEAR(sum * 4 / (kSteps * kSteps), 4 * glm::pi<double>(), 1e-3);
}

TEST(OctahedralMapTest, TheInverseDistanceOfAPlaneIsInterpolatedWithoutError) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 normal = random_direction(random);
    for (int j = 0; j < 50; ++j) {
      const glm::dvec3 d = random_direction(random);
      const test::ScalarTaps<8> taps(d);
      double inverse = 0, weights = 0;
      for (int tap = 0; tap < 3; ++tap) {
        const glm::dvec3 node = OctahedralNodes<8>::direction(taps.node[tap]);
        inverse += taps.weight[tap] * glm::dot(normal, node) /
                   (std::abs(node.x) + std::abs(node.y) + std::abs(node.z));
        weights += taps.weight[tap];
        EXPECT_GE(taps.weight[tap], -1e-15);
      }
      EXPECT_NEAR(weights, 1, 1e-14);
      EXPECT_NEAR(inverse, glm::dot(normal, d) / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z)), 1e-14);
    }
  }
}

// A turned Fibonacci set of 64 rays estimates the cosine-weighted mean of 1 + d.z, 1 + 2/3 n.z, to 1 %.
TEST(OctahedralMapTest, WeightsOfRaysSumToOneAndMeanWhatTheyShould) {
  std::vector<glm::dvec3> nodes;
  for (int node = 0; node < OctahedralNodes<8>::kCount; ++node) {
    if (OctahedralNodes<8>::first_of(node) == node) nodes.push_back(OctahedralNodes<8>::direction(node));
  }
  ProbeDirections directions;
  directions.allocate(64, static_cast<int>(nodes.size()));
  for (const std::uint32_t key : {1u, 77u, 123456u}) {
    directions.aim(key, nodes);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      double sum = 0, mean = 0;
      for (auto i = directions.first_weight[node]; i < directions.first_weight[node + 1]; ++i) {
        const auto& w = directions.weights[static_cast<std::size_t>(i)];
        sum += double{w.weight};
        mean += double{w.weight} * (1 + double{directions.z[static_cast<std::size_t>(w.ray)]});
      }
      EXPECT_NEAR(sum, 1, 1e-6);
      EXPECT_NEAR(mean, 1 + 2.0 / 3 * nodes[node].z, 0.02);
    }
  }
}

TEST(ProbeGridTest, ProbesStandInTheMiddlesOfEqualParts) {
  const ProbeGrid grid = grid_over({{0, 0, 0}, {5, 2.5, 10}}, {16, 8, 16});
  EXPECT_EQ(grid.position({0, 0, 0}), (glm::dvec3{0.15625, 0.15625, 0.3125}));
  EXPECT_EQ(grid.position({15, 7, 15}), (glm::dvec3{4.84375, 2.34375, 9.6875}));
  for (const int index : {0, 15, 16, 100, 2047}) EXPECT_EQ(grid.index(grid.place(index)), index);
}

TEST(ProbeGridTest, SixteenProbesInARowAreNeighboursOnEveryWall) {
  // Morton's curve takes aligned blocks of 4 x 4 one after the other in any plane of the grid.
  const ProbeGrid grid = grid_over({{0, 0, 0}, {5, 2.5, 10}}, {16, 8, 16});
  const auto order = neighbour_order(grid);
  EXPECT_EQ(std::set<std::int32_t>(order.begin(), order.end()).size(), 2048u);
  for (int axis = 0; axis < 3; ++axis) {
    for (int layer = 0; layer < grid.counts[axis]; ++layer) {
      std::vector<glm::ivec3> wall;
      for (const std::int32_t probe : order) {
        if (grid.place(probe)[axis] == layer) wall.push_back(grid.place(probe));
      }
      for (std::size_t first = 0; first < wall.size(); first += 16) {
        for (std::size_t i = first; i < first + 16; ++i)
          EXPECT_EQ(wall[i] / 4, wall[first] / 4) << axis << ", " << i;
      }
    }
  }
}

TEST(ProbeGridTest, AWallBeyondTheOutermostProbesNeedsThoseAlone) {
  // The box's own walls lie half a cell outside the grid, where a look-up clamps to the outermost
  // layer. A closed room of 6 x 5 x 4 probes needs all of them but 4 x 3 x 2 inside; a floor
  // alone, one layer of 6 x 4.
  const auto near = [](const Scene& scene) {
    const auto flags = probes_near_geometry(grid_over({{0, 0, 0}, {6, 5, 4}}, {6, 5, 4}), scene);
    return std::count(flags.begin(), flags.end(), true);
  };
  Scene room;
  test::add(room, test::box({0, 0, 0}, {6, 5, 4}), test::matte(glm::vec3{0.5f}));
  EXPECT_EQ(near(room), 6 * 5 * 4 - 4 * 3 * 2);
  Scene floor;
  test::add(floor, test::quad({0, 0, 4}, {6, 0, 0}, {0, 0, -4}), test::matte(glm::vec3{0.5f}));
  EXPECT_EQ(near(floor), 6 * 4);
  // Inside, a surface between two layers needs both.
  Scene shelf;
  test::add(shelf, test::quad({0, 2.2f, 4}, {6, 0, 0}, {0, 0, -4}), test::matte(glm::vec3{0.5f}));
  EXPECT_EQ(near(shelf), 2 * 6 * 4);
}

TEST(ProbeGridTest, AFlatBoxIsGivenAThickness) {
  const ProbeGrid grid = grid_over({{-8, 1, -4}, {8, 1, 4}}, {4, 2, 4});
  EXPECT_DOUBLE_EQ(grid.lower.y, 0.5);
  EXPECT_DOUBLE_EQ(grid.spacing.y, 0.5);
}

}  // namespace
}  // namespace herr
