// What a mesh loses when its corners are baked into 32 bytes a triangle.
#include "renderer/geometry/triangle_records.h"

#include <gtest/gtest.h>

#include <bit>
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

TEST(TriangleRecordsTest, TheCurvatureOfATriangleOnASphereIsOneOverItsRadius) {
  // n = p / r: all differences of normals are those of places over r. Floats of about 1 are off by 6e-8, over
  // edges of about 0.1 r.
  for (const float radius : {1e-4f, 0.5f, 1e5f}) {
    const std::array<glm::vec3, 3> n{glm::normalize(glm::vec3{0.2f, 0.9f, 0.1f}),
                                     glm::normalize(glm::vec3{0.3f, 0.9f, 0.1f}),
                                     glm::normalize(glm::vec3{0.25f, 0.9f, 0.2f})};
    const float curvature = shading_curvature({n[0] * radius, n[1] * radius, n[2] * radius}, n);
    EXPECT_NEAR(curvature * radius, 1.0, 4 * 6e-8 / 0.1);
  }
}

TEST(TriangleRecordsTest, TheCurvatureOfACylinderIsTheRootOfTheMeanSquareOverDirections) {
  // Turns 1/r around the axis and 0 along it: sqrt((1/r^2 + 0) / 2), however long the triangle is. Chords
  // stand for arcs on both.
  for (const float length : {0.01f, 1.0f, 100.0f}) {
    const glm::vec3 a{1, 0, 0}, b{std::cos(0.1f), 0, std::sin(0.1f)}, along{0, length, 0};
    const float curvature = shading_curvature({2.0f * a, 2.0f * b, 2.0f * b + along}, {a, b, b});
    EXPECT_NEAR(curvature, 0.5 / std::sqrt(2.0), 4 * 6e-8 / 0.1) << length;
  }
}

TEST(TriangleRecordsTest, FlatTrianglesAndSliversDoNotSeemCurved) {
  const glm::vec3 up = glm::normalize(glm::vec3{0.1f, 0.9f, 0.3f});
  EXPECT_EQ(shading_curvature({glm::vec3{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {up, up, up}), 0.0f);
  // A sliver 1 long and 1e-6 wide whose normals are off by 1e-3: along its edges they turn by 1e-3 per 0.5,
  // across it by 1e-3 per 1e-6.
  const glm::vec3 noisy = glm::normalize(up + glm::vec3{1e-3f, 0, 0});
  const float sliver = shading_curvature({glm::vec3{0, 0, 0}, {1, 0, 0}, {0.5f, 0, 1e-6f}}, {up, up, noisy});
  EXPECT_LT(sliver, 1.01 * 1e-3 / 0.5);
  // No extent at all.
  EXPECT_EQ(shading_curvature({up, up, up}, {up, noisy, noisy}), 0.0f);
}

TEST(TriangleRecordsTest, ATriangleIsRoundedAsItsCornersAlongItsNormal) {
  // Level, y up: of corners and edges only heights count, 2 and none.
  for (const float half : {1.0f, 1e4f, 5e8f}) {
    const std::array<glm::vec3, 3> level{glm::vec3{-half, 2, half}, {half, 2, half}, {half, 2, -half}};
    EXPECT_EQ(rounded_length(level), 2.0f);
    // Of any direction: (2 half, 2, 2 half) and edges of (2 half, 0, 2 half).
    EXPECT_FLOAT_EQ(most_rounded_length(level), static_cast<float>(std::sqrt(18.0 * half * half + 4)));
  }
  // The plane x + y = 3 between (3, 0) and (0, 3): normal (1, 1, 0) / sqrt 2, largest coordinates and
  // edges 3.
  EXPECT_FLOAT_EQ(rounded_length({glm::vec3{3, 0, 0}, {0, 3, 0}, {0, 3, 9}}),
                  static_cast<float>(12 / std::sqrt(2.0)));
  // No area: a point, a line.
  EXPECT_EQ(rounded_length({glm::vec3{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}), 0.0f);
  EXPECT_EQ(rounded_length({glm::vec3{0, 2, 3}, {1, 2, 3}, {1e8f, 2, 3}}), 0.0f);
}

TEST(TriangleRecordsTest, ARoundedLengthIsKeptAsTheNextPowerOfTwo) {
  for (const float length : {1e-30f, 0.3f, 1.0f, 1.1f, 5e8f, 1e30f}) {
    for (const float curvature : {0.0f, 1e-5f, 0.7f, 1e30f}) {
      const std::uint32_t word = curvature_and_rounding(curvature, length);
      const double kept = std::ldexp(1.0, static_cast<int>(word & 0xffu) - 127);
      EXPECT_GE(kept, double{length});
      EXPECT_LT(kept, 2 * double{length});
      // 24 significant bits less 8.
      EXPECT_NEAR(std::bit_cast<float>(word & ~0xffu), curvature, 0x1p-15 * double{curvature});
    }
  }
  EXPECT_EQ(curvature_and_rounding(0, 0), 0u);
  // By a power of two both grow bit for bit.
  EXPECT_EQ(curvature_and_rounding(0.7f / 8, 1.1f * 8), curvature_and_rounding(0.7f, 1.1f) - (3u << 23) + 3);
}

}  // namespace
}  // namespace herr
