// The sphere about what a scene shows.
#include "scenes/changes/bounding_sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace herr {
namespace {

// An instance of a mesh with these vertices, in one triangle.
void add(Scene& scene, std::vector<glm::vec3> positions, bool catcher = false) {
  TriangleMesh mesh;
  mesh.normals.assign(positions.size(), {0, 0, 1});
  mesh.positions = std::move(positions);
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(std::move(mesh));
  scene.materials.resize(1);
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
  instance.catcher = catcher;
  scene.instances.push_back(instance);
}

BoundingSphere sphere_of(const Scene& scene) {
  return bounding_sphere(scene, SceneState());
}

TEST(BoundingSphereTest, ReachesTheFarthestVertexFromTheMiddleOfTheBox) {
  Scene scene;
  // A corner triangle: its box is [0, 2] x [0, 4] x [0, 0], its middle (1, 2, 0); each corner of the triangle
  // is a corner of that box, sqrt(5) away.
  add(scene, {{0, 0, 0}, {2, 0, 0}, {0, 4, 0}});
  EXPECT_EQ(sphere_of(scene).centre, glm::dvec3(1, 2, 0));
  EXPECT_DOUBLE_EQ(sphere_of(scene).radius, std::sqrt(5.0));
  // Its size is relative: a tiny copy has a tiny sphere.
  scene.instances[0].world_from_object = glm::dmat4x3(glm::dmat4(1e-7));
  EXPECT_NEAR(sphere_of(scene).radius / (1e-7 * std::sqrt(5.0)), 1.0, 1e-12);
}

TEST(BoundingSphereTest, IsThatOfAnAnalyticBallAndOfTheCornersOfABox) {
  Scene scene;
  scene.materials.resize(1);
  Instance ball;
  ball.kind = ShapeKind::sphere;
  ball.world_from_object = glm::dmat4x3(glm::dmat4(0.5));
  ball.world_from_object[3] = {3, 0, 0};
  scene.instances = {ball};
  EXPECT_EQ(sphere_of(scene).centre, glm::dvec3(3, 0, 0));
  EXPECT_DOUBLE_EQ(sphere_of(scene).radius, 0.5);
  scene.instances[0].kind = ShapeKind::box;  // [-1, 1]^3 halved: corners sqrt(3) / 2 away
  EXPECT_NEAR(sphere_of(scene).radius, std::sqrt(0.75), 1e-12);
}

TEST(BoundingSphereTest, LeavesOutCatchersAndWhatIsNotThereUnlessNothingElseIs) {
  Scene scene;
  add(scene, {{-1, 0, 0}, {1, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(sphere_of(scene).radius, 1);
  add(scene, {{-50, 0, -50}, {50, 0, 50}, {50, 0, -50}}, true);
  add(scene, {{90, 0, 0}, {91, 0, 0}, {92, 0, 0}});
  scene.instances.back().present = false;
  EXPECT_EQ(sphere_of(scene).radius, 1);
  scene.instances[0].present = false;
  EXPECT_DOUBLE_EQ(sphere_of(scene).radius, 50 * std::sqrt(2.0)) << "of the floor alone";
  scene.instances.clear();
  EXPECT_EQ(sphere_of(scene).radius, 0);
}

// An object of one box of `shapes`, by its middle and half edges.
void add_box(Scene& scene, const std::string& name, const glm::dvec3& middle, const glm::dvec3& half) {
  scene.materials.resize(1);
  Instance instance;
  instance.kind = ShapeKind::box;
  for (int axis = 0; axis < 3; ++axis) instance.world_from_object[axis] *= half[axis];
  instance.world_from_object[3] = middle;
  scene.objects.push_back({name, {}, static_cast<std::uint32_t>(scene.instances.size()), 1, true});
  scene.instances.push_back(instance);
}

// A cube of edge 2 stands on a floor of 6 x 8 m and before a wall of 8 m: four and three times its edge. The
// sphere about the cube alone: middle (0, 1, 0), radius sqrt(3).
TEST(BoundingSphereTest, IsFramedWithoutFloorsAndWallsThatAreFarLarger) {
  Scene scene;
  add_box(scene, "floor", {0, -0.05, -1}, {3, 0.05, 4});
  add_box(scene, "model", {0, 1, 0}, {1, 1, 1});
  add_box(scene, "wall", {-3, 1.25, -1}, {0.05, 1.25, 4});
  const FramedSphere framed = framed_sphere(scene, SceneState());
  EXPECT_EQ(framed.left_out, (std::vector<std::string>{"floor", "wall"}));
  EXPECT_EQ(framed.sphere.centre, glm::dvec3(0, 1, 0));
  EXPECT_DOUBLE_EQ(framed.sphere.radius, std::sqrt(3.0));
  // The whole: x from -3.05 to 3, y from -0.1 to 2.5, z from -5 to 3; half the diagonal of that box at most.
  EXPECT_GT(sphere_of(scene).radius, 4.9);
}

TEST(BoundingSphereTest, IsFramedWithAFloorThatIsNotFarLargerOrThick) {
  Scene scene;
  add_box(scene, "model", {0, 1, 0}, {1, 1, 1});
  add_box(scene, "mat", {0, -0.05, 0}, {2.9, 0.05, 2.9});    // 5.8 m: less than three times 2 m
  add_box(scene, "plinth", {0, -0.5, 0}, {1.5, 0.16, 1.5});  // 0.32 m of 3 m: more than a tenth
  const FramedSphere framed = framed_sphere(scene, SceneState());
  EXPECT_TRUE(framed.left_out.empty());
  EXPECT_EQ(framed.sphere.radius, sphere_of(scene).radius);
}

TEST(BoundingSphereTest, OfFlatThingsAloneAllAreFramed) {
  Scene scene;
  add_box(scene, "floor", {0, 0, 0}, {5, 0.01, 5});
  add_box(scene, "card", {0, 0.1, 0}, {0.1, 0.001, 0.1});
  EXPECT_TRUE(framed_sphere(scene, SceneState()).left_out.empty());
  EXPECT_EQ(framed_sphere(scene, SceneState()).sphere.radius, sphere_of(scene).radius);
}

}  // namespace
}  // namespace herr
