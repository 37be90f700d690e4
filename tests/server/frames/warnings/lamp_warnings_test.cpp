// Lamps that light nothing are told; those that stand free, in open shades or in rooms are not.
#include "server/frames/warnings/lamp_warnings.h"

#include <gtest/gtest.h>

namespace herr::test {
namespace {

// Twelve triangles of [-1, 1]^3, fronts outwards; without the top's two it is a box that is open above.
TriangleMesh cube(bool open_above, bool inwards) {
  TriangleMesh mesh;
  for (unsigned corner = 0; corner < 8; ++corner)
    mesh.positions.emplace_back((corner & 1u) != 0 ? 1 : -1, (corner & 2u) != 0 ? 1 : -1,
                                (corner & 4u) != 0 ? 1 : -1);
  // Per face two triangles, counter-clockwise from outside.
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5},
                    {0, 5, 4}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  if (!open_above) mesh.triangles.insert(mesh.triangles.end(), {{2, 6, 7}, {2, 7, 3}});
  if (inwards)
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

// One object of edge 2 about (0, 0, -3), and a lamp at `lamp`.
Scene scene_of(ShapeKind kind, const glm::dvec3& lamp, TriangleMesh mesh = {}) {
  Scene scene;
  Material material;
  scene.materials.push_back(material);
  scene.meshes.push_back(std::move(mesh));
  Instance crate;
  crate.name = "crate";
  crate.kind = kind;
  crate.world_from_object[3] = {0, 0, -3};
  scene.instances.push_back(crate);
  AreaLight light;
  light.name = "lamp";
  light.centre = lamp;
  light.intensity_w_sr = glm::vec3(12);
  scene.lights.push_back(light);
  return scene;
}

const std::string kInside =
    "light \"lamp\" stands inside \"crate\", which is opaque and hides its light; move its \"centre\" out of "
    "it";

// (0.9, 0.9, -3) lies in the box's corner and 0.27 outside the ball of radius 1.
TEST(LampWarnings, ALampInsideAnOpaqueShapeIsTold) {
  EXPECT_EQ(lamp_warnings(scene_of(ShapeKind::box, {0.9, 0.9, -3})), std::vector{kInside});
  EXPECT_EQ(lamp_warnings(scene_of(ShapeKind::sphere, {0.9, 0.9, -3})), std::vector<std::string>{});
  EXPECT_EQ(lamp_warnings(scene_of(ShapeKind::sphere, {0.5, 0.5, -3})), std::vector{kInside});
  EXPECT_EQ(lamp_warnings(scene_of(ShapeKind::box, {0, 1.1, -3})), std::vector<std::string>{});
}

TEST(LampWarnings, OfMeshesTheClosedOnesHideIt) {
  EXPECT_EQ(lamp_warnings(scene_of(ShapeKind::mesh, {0.3, 0.2, -3.4}, cube(false, false))),
            std::vector{kInside});
  // Seen from the middle of an open box the missing face is a sixth of the sphere: 5/6 of a turn is left.
  EXPECT_EQ(lamp_warnings(scene_of(ShapeKind::mesh, {0, 0, -3}, cube(true, false))),
            std::vector<std::string>{});
  EXPECT_EQ(lamp_warnings(scene_of(ShapeKind::mesh, {0, 0, -3}, cube(false, true))),
            std::vector<std::string>{});
  // Mirrored by its matrix it is the same box.
  Scene mirrored = scene_of(ShapeKind::mesh, {0, 0, -3}, cube(false, false));
  mirrored.instances[0].world_from_object[0] *= -1;
  EXPECT_EQ(lamp_warnings(mirrored), std::vector{kInside});
}

TEST(LampWarnings, GlassRoomsAndRealSurfacesHideNoLamp) {
  Scene glass = scene_of(ShapeKind::sphere, {0, 0, -3});
  glass.materials[0].transmission = 1;
  EXPECT_EQ(lamp_warnings(glass), std::vector<std::string>{});
  Scene room = scene_of(ShapeKind::box, {0, 0, -3});
  room.instances.push_back(room.instances[0]);  // something of a tenth of its size stands in it
  for (int axis = 0; axis < 3; ++axis) room.instances[1].world_from_object[axis] *= 0.1;
  room.instances[1].world_from_object[3] = {0.5, 0, -3};
  EXPECT_EQ(lamp_warnings(room), std::vector<std::string>{});
  Scene real = scene_of(ShapeKind::box, {0, 0, -3});
  real.instances[0].catcher = true;
  EXPECT_EQ(lamp_warnings(real), std::vector<std::string>{});
  real.lights[0].is_virtual = true;
  EXPECT_EQ(lamp_warnings(real), std::vector{kInside});
}

TEST(LampWarnings, AVoxelThatIsThereHidesTheLampInIt) {
  Scene scene = scene_of(ShapeKind::voxels, {1.5, 0.5, -2.5});  // in voxel (1, 0, 0)
  scene.voxel_grids.emplace_back();
  scene.voxel_grids[0].allocate({2, 1, 1});
  EXPECT_EQ(lamp_warnings(scene), std::vector<std::string>{});
  scene.voxel_grids[0].set({1, 0, 0}, 0xff0000ffu);
  EXPECT_EQ(lamp_warnings(scene), std::vector{kInside});
}

TEST(LampWarnings, IntensityZeroIsToldUntilTheTimelineSetsIt) {
  Scene scene = scene_of(ShapeKind::box, {0, 4, 0});
  scene.lights[0].intensity_w_sr = glm::vec3(0);
  scene.lights.push_back(scene.lights[0]);
  EXPECT_EQ(
      lamp_warnings(scene),
      std::vector<std::string>{"light \"lamp\" (and 1 more lamp) has intensity 0 and lights nothing; write "
                               "\"intensity_w_sr\": [12, 12, 12], or leave it out"});
  SceneChange change;
  change.kind = ChangeKind::set_light;
  change.name = "lamp";
  scene.timeline.push_back(change);
  EXPECT_EQ(lamp_warnings(scene), std::vector<std::string>{});
}

}  // namespace
}  // namespace herr::test
