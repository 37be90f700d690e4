// The scene over time, its bounds and counts, and the light of a bare glTF file.
#include <gtest/gtest.h>

#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

Scene circling(double phase_deg) {
  Scene scene;
  AreaLight light;
  light.centre = {10, 20, 30};
  light.path_radius_m = 2;
  light.path_period_s = 8;
  light.path_phase_deg = phase_deg;
  scene.lights.push_back(light);
  return scene;
}

glm::dvec3 centre_at(const Scene& scene, double time_s) {
  SceneState state;
  scene_state_at(scene, time_s, state);
  return state.lights.at(0).centre;
}

// cos and sin of a double near a multiple of pi/2 are off by its rounding, 2e-16 * 2 pi; times the radius 2,
// plus one rounding of a sum near 30 (4e-15): 1e-14 covers both.
constexpr double kTolerance_m = 1e-14;

void expect_near(const glm::dvec3& value, const glm::dvec3& expected) {
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(value[axis], expected[axis], kTolerance_m) << "axis " << axis;
}

TEST(SceneState, ALightStartsTowardsPlusXAndTurnsCounterClockwiseSeenFromAbove) {
  expect_near(centre_at(circling(0), 0), {12, 20, 30});
  expect_near(centre_at(circling(0), 2), {10, 20, 28});  // a quarter: +X turns to -Z
  expect_near(centre_at(circling(0), 4), {8, 20, 30});
  expect_near(centre_at(circling(90), 0), {10, 20, 28});
  expect_near(centre_at(circling(-90), 0), {10, 20, 32});
}

TEST(SceneState, ALightKeepsItsPlaceOverAThousandMillionSeconds) {
  // 1e9 = 125,000,000 * 8 exactly; 1e9 + 2 is a quarter further.
  expect_near(centre_at(circling(0), 1e9), {12, 20, 30});
  expect_near(centre_at(circling(0), 1e9 + 2), {10, 20, 28});
  expect_near(centre_at(circling(0), -2), {10, 20, 32});
}

TEST(SceneState, ALightWithoutAPathStays) {
  Scene scene = circling(45);
  scene.lights[0].path_radius_m = 0;
  EXPECT_EQ(centre_at(scene, 1e300), glm::dvec3(10, 20, 30));
}

TEST(SceneState, BoundsAreThoseOfTheTransformedVerticesWithoutCatchers) {
  const TemporaryFolder folder;
  nlohmann::json document = triangle_document();
  document["nodes"][0]["translation"] = {1000000, 2, 3};
  document["nodes"][0]["scale"] = {2, -4, 1};
  Scene scene = load_scene(write_model(folder, document));
  scene.instances.push_back(scene.instances[0]);
  scene.instances[1].catcher = true;
  scene.instances[1].world_from_object[3] = glm::dvec3(-50);
  const Bounds bounds = scene_bounds(scene);
  EXPECT_EQ(bounds.lower, glm::dvec3(1000000, -2, 3));
  EXPECT_EQ(bounds.upper, glm::dvec3(1000002, 2, 3));
  EXPECT_EQ(triangle_count(scene, false), 1);
  EXPECT_EQ(triangle_count(scene, true), 2);
  scene.instances.erase(scene.instances.begin());
  EXPECT_EQ(scene_bounds(scene).upper, glm::dvec3(-48, -50, -50));
  scene.instances.clear();
  EXPECT_EQ(scene_bounds(scene).lower, glm::dvec3(0));
}

TEST(SceneState, ABareModelIsLitFromAboveWithIrradiancePiAtItsMiddle) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(folder, triangle_document()));
  EXPECT_EQ(scene.name, "model");
  ASSERT_EQ(scene.lights.size(), 1u);
  // Bounds (0,0,0)-(1,1,0): middle (0.5, 0.5, 0), distance 0.5 + sqrt(2) above it; E = I / d^2 = pi.
  const double distance_m = 0.5 + std::sqrt(2.0);
  EXPECT_NEAR(scene.lights[0].centre.y, 0.5 + distance_m, 1e-15 * 4);
  EXPECT_NEAR(scene.lights[0].intensity_w_sr.x / (distance_m * distance_m), 3.14159265, 3.2 * 6e-8);
}

// 16 probes along x, of which the outermost stand half a spacing s outside: 15 s = 1 + s, s = 1/14; probe i
// of a box of 16 s stands at its lower end + (i + 1/2) s. 8 along y: 7 s = 1 + s, s = 1/6.
TEST(SceneState, TheOutermostProbesOfABareModelStandHalfASpacingOutsideIt) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(write_model(folder, triangle_document()));
  ASSERT_TRUE(scene.probes.box);
  const Bounds& box = *scene.probes.box;
  EXPECT_NEAR(box.lower.x + 0.5 / 14, -0.5 / 14, 1e-15);
  EXPECT_NEAR(box.lower.x + 15.5 / 14, 1 + 0.5 / 14, 4e-15);
  EXPECT_NEAR(box.upper.x - box.lower.x, 16.0 / 14, 4e-15);
  EXPECT_NEAR(box.lower.y, -1.0 / 6, 1e-15);
  EXPECT_NEAR(box.upper.y, 1 + 1.0 / 6, 4e-15);
}

}  // namespace
}  // namespace herr::test
