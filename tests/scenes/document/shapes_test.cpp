// Analytic shapes in scene documents: what each field becomes, and what is said about each that is wrong.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

Scene with_shapes(const char* shapes) {
  const TemporaryFolder folder;
  json document = {{"format_version", 1}, {"name", "shapes"}};
  document["shapes"] = json::parse(shapes);
  return load_scene(folder.write("shapes.scene.json", document.dump()));
}

TEST(Shapes, EveryFieldArrives) {
  const Scene scene = with_shapes(R"([
    {"name": "ball", "sphere": {"centre": [1, 2, 3], "radius": 0.5}, "material": {"transmission": 1, "roughness": 0}},
    {"sphere": {"centre": [0, 0, 0], "radii": [1, 2, 3], "rotation_xyzw": [0, 0.70710678, 0, 0.70710678]}},
    {"box": {"min": [0, 0, 0], "max": [1, 2, 4]}, "catcher": true},
    {"box": {"centre": [5, 0, 0], "half_extents": [1, 2, 3]}}])");
  ASSERT_EQ(scene.instances.size(), 4u);
  const Instance& ball = scene.instances[0];
  EXPECT_EQ(ball.name, "ball");
  EXPECT_EQ(ball.kind, ShapeKind::sphere);
  EXPECT_EQ(ball.world_from_object[0], glm::dvec3(0.5, 0, 0));
  EXPECT_EQ(ball.world_from_object[3], glm::dvec3(1, 2, 3));
  EXPECT_FALSE(ball.catcher);
  EXPECT_EQ(scene.materials[ball.material].transmission, 1);
  EXPECT_TRUE(may_mirror(scene.materials[ball.material])) << "smooth glass reflects";
  // A quarter turn about y takes x to -z and z to x.
  const Instance& egg = scene.instances[1];
  EXPECT_NEAR(glm::distance(egg.world_from_object[0], glm::dvec3(0, 0, -1)), 0, 1e-7);
  EXPECT_NEAR(glm::distance(egg.world_from_object[2], glm::dvec3(3, 0, 0)), 0, 1e-7);
  const Instance& crate = scene.instances[2];
  EXPECT_EQ(crate.name, "shapes[2]");
  EXPECT_EQ(crate.kind, ShapeKind::box);
  EXPECT_TRUE(crate.catcher);
  EXPECT_EQ(crate.world_from_object, glm::dmat4x3({0.5, 0, 0}, {0, 1, 0}, {0, 0, 2}, {0.5, 1, 2}));
  const Bounds bounds = instance_bounds(scene, scene.instances[3]);
  EXPECT_EQ(bounds.lower, glm::dvec3(4, -2, -3));
  EXPECT_EQ(bounds.upper, glm::dvec3(6, 2, 3));
  EXPECT_EQ(triangle_count(scene, true), 0);
}

TEST(Shapes, EveryFaultIsAnInputErrorThatNamesTheField) {
  const std::vector<std::pair<const char*, const char*>> faults{
      {R"([{"name": "nothing"}])", "shapes[0] needs a sphere or a box"},
      {R"([{"sphere": {"centre": [0, 0, 0], "radius": 1}, "box": {"min": [0, 0, 0], "max": [1, 1, 1]}}])",
       "shapes[0] needs a sphere or a box"},
      {R"([{"sphere": {"center": [0, 0, 0], "radius": 1}}])", "centre"},
      {R"([{"sphere": {"centre": [0, 0, 0]}}])", "needs a radius"},
      {R"([{"sphere": {"centre": [0, 0, 0], "radius": 0}}])", "shapes[0].sphere.radius leaves no thickness"},
      {R"([{"sphere": {"centre": [0, 0, 0], "radius": -1}}])", "shapes[0].sphere.radius"},
      {R"([{"sphere": {"centre": [0, 0, 0], "radius": 1e-13}}])", "flattens or shrinks"},
      {R"([{"sphere": {"centre": [0, 1e300, 0], "radius": 1}}])", "shapes[0].sphere.centre"},
      {R"([{"sphere": {"centre": [0, 0, 0], "radii": [1, 1, 0]}}])",
       "shapes[0].sphere.radii leaves no thickness on the z axis"},
      {R"([{"sphere": {"centre": [0, 0, 0], "radius": "wide"}}])", "shapes[0].sphere.radius"},
      {R"([{"box": {"min": [0, 0, 0], "max": [1, 0, 1]}}])",
       "shapes[0].box.max leaves no thickness on the y axis"},
      {R"([{"box": {"min": [0, 0, 0], "max": [1, -1, 1]}}])", "shapes[0].box.max is below min"},
      {R"([{"box": {"min": [0, 0, 0]}}])", "shapes[0].box.max"},
      {R"([{"box": {"min": [0, 0, 0], "max": [1, 1, 1], "half_extents": [1, 1, 1]}}])", "both by corners"},
      {R"([{"box": {"centre": [0, 0, 0], "half_extents": [1, 1, 1], "rotation_xyzw": [0, 0, 0, 2]}}])",
       "rotation_xyzw"},
      {R"([{"box": {"centre": [0, 0, 0], "half_extents": [1, 1]}}])", "shapes[0].box.half_extents"},
      {R"([{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "catcher": 1}])", "shapes[0].catcher"},
      {R"([{"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "material": {"metalic": 1}}])", "metallic"},
      {R"({"sphere": {}})", "shapes"},
  };
  for (const auto& [shapes, expected] : faults) {
    try {
      with_shapes(shapes);
      ADD_FAILURE() << "accepted: " << shapes;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos)
          << shapes << "\n  said: " << error.what();
    }
  }
}

}  // namespace
}  // namespace herr::test
