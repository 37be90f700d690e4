// Node trees flattened to one level, against a slow product of 4x4 matrices written out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "scenes/load_scene.h"
#include "scenes/model/transform_checks.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;
using Matrix = std::array<std::array<double, 4>, 4>;  // [row][column]

Matrix multiply(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t k = 0; k < 4; ++k) c[row][column] += a[row][k] * b[k][column];
    }
  }
  return c;
}

// T * R * S with the textbook matrix of a unit quaternion.
Matrix trs(const std::array<double, 3>& t, const std::array<double, 4>& q, const std::array<double, 3>& s) {
  const auto [x, y, z, w] = q;
  return {{{(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y - z * w) * s[1], 2 * (x * z + y * w) * s[2], t[0]},
           {2 * (x * y + z * w) * s[0], (1 - 2 * (x * x + z * z)) * s[1], 2 * (y * z - x * w) * s[2], t[1]},
           {2 * (x * z - y * w) * s[0], 2 * (y * z + x * w) * s[1], (1 - 2 * (x * x + y * y)) * s[2], t[2]},
           {0, 0, 0, 1}}};
}

TEST(GltfTransforms, AChainOfNodesIsTheProductOfItsMatrices) {
  constexpr unsigned kSeed = 20240611;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> place(-3, 3), factor(0.5, 2.0), part(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    json document = triangle_document();
    document["nodes"] = json::array();
    Matrix expected = trs({0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1});
    for (int i = 0; i < 5; ++i) {
      std::array<double, 4> q{part(random), part(random), part(random), part(random)};
      const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      for (double& value : q) value /= length;
      const std::array<double, 3> t{place(random), place(random), place(random)};
      const std::array<double, 3> s{factor(random), -factor(random), factor(random)};
      json node = {{"translation", t}, {"rotation", q}, {"scale", s}};
      if (i < 4) node["children"] = {i + 1};
      if (i == 4) node["mesh"] = 0;
      document["nodes"].push_back(node);
      expected = multiply(expected, trs(t, q, s));
    }
    const TemporaryFolder folder;
    const Scene scene = load_scene(write_model(folder, document));
    ASSERT_EQ(scene.instances.size(), 1u);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        // Entries stay below 3 * (1 + 2 + 4 + 8 + 16) * 2 < 200; five products of four terms
        // lose a few 1e-16 each.
        EXPECT_NEAR(scene.instances[0].world_from_object[column][row],
                    expected[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)], 1e-12)
            << "seed " << kSeed << " trial " << trial;
      }
    }
    // Five negative factors: mirrored.
    EXPECT_LT(determinant(scene.instances[0].world_from_object), 0);
  }
}

TEST(GltfTransforms, AMatrixIsReadColumnByColumn) {
  json document = triangle_document();
  document["nodes"][0]["matrix"] = {1, 2, 3, 0, 0, 1, 4, 0, 5, 6, 0, 0, 7, 8, 9, 1};
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(folder, document));
  EXPECT_EQ(scene.instances.at(0).world_from_object[0], glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.instances.at(0).world_from_object[3], glm::dvec3(7, 8, 9));
}

TEST(GltfTransforms, NodesThatShareAMeshShareItsTriangles) {
  json document = triangle_document();
  document["nodes"] = json::array({{{"mesh", 0}, {"translation", {2, 0, 0}}}, {{"mesh", 0}}});
  document["scenes"][0]["nodes"] = {0, 1};
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(folder, document));
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(triangle_count(scene, true), 2);
}

TEST(GltfTransforms, OnlyTheChosenSceneIsShown) {
  json document = triangle_document();
  document["nodes"] = json::array({{{"mesh", 0}, {"name", "a"}}, {{"mesh", 0}, {"name", "b"}}});
  document["scenes"] = json::array({{{"nodes", {0}}}, {{"nodes", {1}}}});
  document["scene"] = 1;
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(folder, document));
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].name, "b");
}

TEST(GltfTransforms, AScaleOfExactly1em12PassesAtAnyRotation) {
  // The determinant 1e-36 is the limit itself; rotations move it by a few 1e-16 of it.
  for (int degrees = 0; degrees < 360; ++degrees) {
    const glm::dquat turn =
        glm::angleAxis(glm::radians(double(degrees)), glm::normalize(glm::dvec3(1, 2, 3)));
    const glm::dmat3 linear = glm::mat3_cast(turn) * glm::dmat3(1e-12);
    EXPECT_FALSE(transform_problem(glm::dmat4x3(linear[0], linear[1], linear[2], glm::dvec3(0)))) << degrees;
  }
}

// The scale of a parent squeezes a child that is turned by 45 degrees: its x and y axes come to lie within
// 2 * 0.0005 / 2000 of each other, a share of 5e-7 of their box.
TEST(GltfTransforms, AShearIntoAPlaneIsRefusedByName) {
  const double c = std::sqrt(0.5);
  const glm::dmat4x3 sheared(glm::dvec3(2000 * c, 0.0005 * c, 0), glm::dvec3(-2000 * c, 0.0005 * c, 0),
                             glm::dvec3(0, 0, 1), glm::dvec3(0));
  ASSERT_TRUE(transform_problem(sheared));
  EXPECT_NE(transform_problem(sheared)->find("plane"), std::string::npos);
}

TEST(GltfTransforms, ARotationThatIsNotUnitIsNormalisedWithAWarning) {
  json document = triangle_document();
  document["nodes"][0]["rotation"] = {0, 0, 0, 0.9};
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(folder, document));
  EXPECT_EQ(scene.instances.at(0).world_from_object[0], glm::dvec3(1, 0, 0));
  EXPECT_TRUE(any_contains(scene.warnings, "not of unit length"));
}

}  // namespace
}  // namespace herr::test
