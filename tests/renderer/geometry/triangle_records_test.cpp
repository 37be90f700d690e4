// What a mesh loses when its corners are baked into 32 bytes a triangle.
#include "renderer/geometry/triangle_records.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

double round_trip_deg(const glm::dvec3& n) {
  return eccentricity_deg(n, glm::dvec3(decode_octahedral(encode_octahedral(glm::vec3(n)))));
}

TEST(TriangleRecordsTest, NormalsReturnWithinHalfAStepOfBothNumbers) {
  double worst = 0;
  std::mt19937_64 random(31);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200000; ++i) {
    worst = std::max(
        worst, round_trip_deg(glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)})));
  }
  // Along the octahedron's edges and around its corners, where it folds.
  for (int i = 0; i < 2000; ++i) {
    const double t = i * glm::two_pi<double>() / 2000, tiny = std::pow(10.0, -i / 200.0);
    for (const glm::dvec3& n : {glm::dvec3{std::cos(t), std::sin(t), 0},
                                {0, std::cos(t), std::sin(t)},
                                {std::sin(t), 0, std::cos(t)},
                                {tiny, tiny, -1},
                                {-tiny, tiny, -1},
                                {1, tiny, -tiny}}) {
      worst = std::max(worst, round_trip_deg(n));
    }
  }
  std::cout << "worst normal: " << worst << " degrees\n";
  // Half a step of 1/32767 on both axes, e = 1/65534, moves the point on the octahedron by (e, e, -2e). That
  // is widest seen from the centre where a face's centre is nearest, 1/sqrt(3) away: e sqrt(6) sqrt(3) rad =
  // 0.00371 degrees. Floats add a few 6e-8 rad.
  EXPECT_LT(worst, 0.0038);
}

TEST(TriangleRecordsTest, AxesAreExact) {
  for (const glm::vec3& n : {glm::vec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
    EXPECT_EQ(decode_octahedral(encode_octahedral(n)), n);
  }
}

TEST(TriangleRecordsTest, ANormalOfNoLengthBecomesSomeUnitVector) {
  EXPECT_FLOAT_EQ(glm::length(decode_octahedral(encode_octahedral({0, 0, 0}))), 1.0f);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FLOAT_EQ(glm::length(decode_octahedral(encode_octahedral({nan, 0, 0}))), 1.0f);
}

TEST(TriangleRecordsTest, TextureCoordinatesAreOffByAtMostHalfAStepOfTheirRange) {
  TriangleMesh mesh = test::sphere({0, 0, 0}, 1);
  for (std::size_t i = 0; i < mesh.uvs.size(); ++i)
    mesh.uvs[i] = mesh.uvs[i] * glm::vec2{37.0f, 0.3f} - glm::vec2{11.0f, 0.1f};
  const BakedMesh baked = bake_triangles(mesh);
  ASSERT_EQ(baked.records.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const glm::vec2 uv = mesh.uvs[mesh.triangles[t][corner]];
      const std::uint32_t code = baked.records[t].uv[corner];
      const glm::vec2 read =
          baked.uv_lower + baked.uv_scale *
                               glm::vec2(static_cast<float>(code & 0xffff), static_cast<float>(code >> 16)) /
                               65535.0f;
      // Half of range / 65535, and floats of up to 37 (spacing 2^-18) twice.
      ASSERT_NEAR(read.x, uv.x, 37.0 / 65535 / 2 + 2 * 0x1p-18);
      ASSERT_NEAR(read.y, uv.y, 0.3 / 65535 / 2 + 2 * 0x1p-24);
    }
  }
}

TEST(TriangleRecordsTest, CoordinatesThatAreAllTheSameSurvive) {
  TriangleMesh mesh = test::floor_quad(1);
  mesh.uvs.assign(4, {0.25f, -3.0f});
  const BakedMesh baked = bake_triangles(mesh);
  EXPECT_EQ(baked.uv_lower, glm::vec2(0.25f, -3.0f));
  EXPECT_EQ(baked.uv_scale, glm::vec2(0.0f));
}

}  // namespace
}  // namespace herr
