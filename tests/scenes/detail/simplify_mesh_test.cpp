// Simplified meshes: halves, subsets, and no farther from the original than they say.
#include "scenes/detail/simplify_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace herr {
namespace {

constexpr float kPi = 3.14159265f;

// A unit sphere of 2 * n * n * ... triangles, its seam closed.
TriangleMesh sphere(std::uint32_t rings) {
  const std::uint32_t columns = 2 * rings;
  TriangleMesh mesh;
  mesh.name = "ball";
  for (std::uint32_t y = 0; y <= rings; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      const float theta = kPi * static_cast<float>(y) / static_cast<float>(rings);
      const float phi = 2 * kPi * static_cast<float>(x) / static_cast<float>(columns);
      const glm::vec3 p{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
      mesh.positions.push_back(p);
      mesh.normals.push_back(p);
      mesh.uvs.push_back({p.x, p.y});
    }
  }
  for (std::uint32_t y = 0; y < rings; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      const std::uint32_t a = y * columns + x, b = y * columns + (x + 1) % columns;
      if (y > 0) mesh.triangles.push_back({a, b, a + columns});
      if (y + 1 < rings) mesh.triangles.push_back({b, b + columns, a + columns});
    }
  }
  return mesh;
}

TEST(SimplifyMesh, EachLevelHasAboutHalfTheTrianglesOfTheOneBefore) {
  const TriangleMesh mesh = sphere(64);
  const auto levels = simplified_meshes(mesh);
  ASSERT_GE(levels.size(), 4u);
  std::size_t before = mesh.triangles.size();
  for (const SimplifiedMesh& level : levels) {
    EXPECT_LE(level.mesh.triangles.size(), 8 * before / 10);
    EXPECT_GE(level.mesh.triangles.size(), kFewestTriangles / 2);
    before = level.mesh.triangles.size();
  }
}

TEST(SimplifyMesh, VerticesKeepTheirNormalsAndTextureCoordinates) {
  for (const SimplifiedMesh& level : simplified_meshes(sphere(32))) {
    const TriangleMesh& mesh = level.mesh;
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      EXPECT_EQ(mesh.normals[i], mesh.positions[i]);
      EXPECT_EQ(mesh.uvs[i].x, mesh.positions[i].x);
    }
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) EXPECT_LT(corner, mesh.positions.size());
    }
  }
}

TEST(SimplifyMesh, ALevelLiesNoFartherFromTheSphereThanTwiceWhatItSays) {
  // Its vertices lie on the sphere, so it is farthest at the middle of a triangle: 1 - |centroid|. What
  // meshoptimizer states is a root of quadrics, a mean over the collapsed faces and no bound: the largest of
  // all triangles stays below twice the stated value here, and within half of it the statement would be idle.
  for (const SimplifiedMesh& level : simplified_meshes(sphere(64))) {
    float farthest = 0;
    for (const auto& t : level.mesh.triangles) {
      const auto& p = level.mesh.positions;
      farthest = std::max(farthest, 1 - glm::length(p[t[0]] + p[t[1]] + p[t[2]]) / 3);
    }
    EXPECT_LE(farthest, 2 * level.error_m) << level.mesh.triangles.size() << " triangles";
    EXPECT_GE(farthest, level.error_m / 8) << level.mesh.triangles.size() << " triangles";
  }
}

TEST(SimplifyMesh, ErrorsNeverFallFromLevelToLevel) {
  float before = 0;
  for (const SimplifiedMesh& level : simplified_meshes(sphere(48))) {
    EXPECT_GE(level.error_m, before);
    EXPECT_TRUE(std::isfinite(level.error_m));
    before = level.error_m;
  }
}

TEST(SimplifyMesh, ASceneNamesTheCoarserFormsOfAMeshOnce) {
  Scene scene;
  scene.meshes = {sphere(24), sphere(5)};
  add_coarser_meshes(scene, 0);
  const std::size_t forms = scene.meshes[0].coarser.size();
  ASSERT_GE(forms, 2u);
  EXPECT_EQ(scene.meshes.size(), 2 + forms);
  for (std::size_t i = 0; i < forms; ++i) EXPECT_EQ(scene.meshes[0].coarser[i].mesh, 2 + i);
  add_coarser_meshes(scene, 0);
  add_coarser_meshes(scene, 1);  // too small to have any
  EXPECT_EQ(scene.meshes.size(), 2 + forms);
}

TEST(SimplifyMesh, ASmallMeshHasNoCoarserForm) {
  EXPECT_TRUE(simplified_meshes(sphere(5)).empty());  // 80 triangles, below twice the fewest
}

TEST(SimplifyMesh, AMeshOfPointsHasNoForm) {
  // 1,000 triangles that are all one point: nothing to measure, nothing may break.
  TriangleMesh mesh;
  mesh.positions.assign(3, glm::vec3{1, 2, 3});
  mesh.normals.assign(3, glm::vec3{0, 1, 0});
  mesh.triangles.assign(1000, {0, 1, 2});
  for (const SimplifiedMesh& level : simplified_meshes(mesh)) EXPECT_TRUE(std::isfinite(level.error_m));
}

}  // namespace
}  // namespace herr
