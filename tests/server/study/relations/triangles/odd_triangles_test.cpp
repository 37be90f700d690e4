// Odd triangles are what they are said to be, and leave the surface where it is.
#include "server/study/relations/triangles/odd_triangles.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/server/study/relations/lit_room.h"

namespace herr {
namespace {

double area_of(const TriangleMesh& mesh, std::size_t t) {
  const auto [a, b, c] = mesh.triangles[t];
  const glm::dvec3 p(mesh.positions[a]);
  return 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[b]) - p, glm::dvec3(mesh.positions[c]) - p));
}

double area_from(const TriangleMesh& mesh, std::size_t first) {
  double sum = 0;
  for (std::size_t t = first; t < mesh.triangles.size(); ++t) sum += area_of(mesh, t);
  return sum;
}

TEST(OddTrianglesTest, EachTriangleIsThereTwice) {
  Scene scene = test::lit_room().scene;
  const double before = area_from(scene.meshes[1], 0);
  const std::size_t count = scene.meshes[1].triangles.size();
  add_duplicates(scene);
  EXPECT_EQ(scene.meshes[1].triangles.size(), 2 * count);
  EXPECT_EQ(scene.meshes[1].triangles[count + 7], scene.meshes[1].triangles[7]);
  EXPECT_DOUBLE_EQ(area_from(scene.meshes[1], 0), 2 * before);
}

TEST(OddTrianglesTest, SurfacesThatBlendHaveNoDuplicates) {
  Scene scene = test::lit_room().scene;
  scene.materials[scene.instances[1].material].alpha_mode = AlphaMode::blend;
  EXPECT_EQ(solid_meshes(scene), std::vector<std::uint32_t>{0});
  EXPECT_EQ(rigid_meshes(scene), (std::vector<std::uint32_t>{0, 1}));
}

TEST(OddTrianglesTest, MeshesThatBendStayAsTheyAre) {
  Scene scene = test::lit_room().scene;
  scene.deformations.emplace_back().mesh = 1;
  EXPECT_EQ(rigid_meshes(scene), std::vector<std::uint32_t>{0});
}

TEST(OddTrianglesTest, TrianglesWithoutAreaHaveNone) {
  Scene scene = test::lit_room().scene;
  const std::size_t count = scene.meshes[1].triangles.size();
  add_triangles_without_area(scene);
  const TriangleMesh& mesh = scene.meshes[1];
  EXPECT_EQ(mesh.triangles.size(), count + 16);
  // The one at the origin has edges of 1e-30.
  EXPECT_LE(area_from(mesh, count), 1e-59);
  EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
  EXPECT_EQ(mesh.uvs.size(), mesh.positions.size());
}

TEST(OddTrianglesTest, NeedlesDivideTheSurfaceAndLeaveItsAreaAndEdges) {
  Scene scene = test::lit_room().scene;
  const TriangleMesh whole = scene.meshes[1];
  divide_into_needles(scene);
  const TriangleMesh& mesh = scene.meshes[1];
  EXPECT_GT(mesh.triangles.size(), 2 * whole.triangles.size());
  // Corners are rounded to floats of about 3: by 1.2e-7, of triangles a tenth wide.
  EXPECT_NEAR(area_from(mesh, 0) / area_from(whole, 0), 1, 1e-5);
  int needles = 0;
  for (std::size_t t = 0; t < whole.triangles.size(); ++t)
    needles += area_of(mesh, t) < 0.02 * area_of(whole, t) ? 1 : 0;
  EXPECT_GT(needles, 20);
  for (std::size_t i = whole.positions.size(); i < mesh.positions.size(); ++i)
    EXPECT_NEAR(glm::length(mesh.normals[i]), 1, 1e-6);
}

TEST(OddTrianglesTest, TrianglesTooSmallForFloatsStayWhole) {
  Scene scene;
  // A millionth wide at 100: floats are 7.6e-6 apart there.
  TriangleMesh mesh = test::quad({100, 100, 100}, {1e-5f, 0, 0}, {0, 1e-5f, 0});
  test::add(scene, mesh, test::matte(glm::vec3{0.5f}));
  divide_into_needles(scene);
  EXPECT_EQ(scene.meshes[0].triangles, mesh.triangles);
}

TEST(OddTrianglesTest, AFarCornerIsSeenOnOneInstanceOnly) {
  Scene scene = test::lit_room().scene;
  scene.instances.push_back(scene.instances[1]);  // both show mesh 1, the finer one
  const std::size_t count = scene.meshes[1].triangles.size();
  add_far_corner(scene, {{0, 0, 5}, {0, 0, 1}, {1, 0, 0}, 0.01});
  EXPECT_NE(scene.instances.front().mesh, scene.instances.back().mesh);
  EXPECT_NE(scene.instances[1].mesh, scene.instances.back().mesh);
  EXPECT_EQ(scene.meshes[scene.instances.back().mesh].triangles.size(), count);
  EXPECT_EQ(scene.meshes[scene.instances[1].mesh].triangles.size(), count + 1);
}

TEST(OddTrianglesTest, AFarCornerOfTheOnlyInstanceGoesIntoItsOwnMesh) {
  Scene scene = test::lit_room().scene;
  const std::size_t meshes = scene.meshes.size(), count = scene.meshes[1].triangles.size();
  add_far_corner(scene, {{0, 0, 5}, {0, 0, 1}, {1, 0, 0}, 0.01});
  EXPECT_EQ(scene.meshes.size(), meshes);
  EXPECT_EQ(scene.meshes[1].triangles.size(), count + 1);
}

}  // namespace
}  // namespace herr
