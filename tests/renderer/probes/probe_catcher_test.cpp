// Indirect light on the camera feed: what virtual surfaces throw on real ones, and nothing else.
#include <gtest/gtest.h>

#include "tests/renderer/probes/probe_scenes.h"

namespace herr {
namespace {

test::TestCamera even_feed() {
  return test::TestCamera::pinhole(8, 8, 60, [](int, int) {
    const std::uint16_t half = test::to_half(0.5);
    return std::array<std::uint16_t, 4>{half, half, half, 0x3c00};
  });
}

// A real floor and wall under a lamp.
Scene corner() {
  Scene scene;
  test::add(scene, test::floor_quad(3), test::matte(glm::vec3{0.6f}), true);
  test::add(scene, test::quad({-3, 0, -3}, {6, 0, 0}, {0, 3, 0}), test::matte(glm::vec3{0.6f}), true);
  scene.lights = {test::light_at({0, 2.5, 0}, glm::vec3{4.0f})};
  scene.environment = glm::vec3{0.2f};
  scene.probes = {{8, 6, 8}, Bounds{{-3, 0, -3}, {3, 3, 3}}};
  return scene;
}

FrameSample above(const test::TestCamera& camera) {
  FrameSample sample = test::looking_down({0, 2, 0});
  camera.attach_to(sample);
  return sample;
}

TEST(ProbeCatcherTest, WithoutVirtualObjectsTheFeedStaysBitForBit) {
  const test::TestCamera camera = even_feed();
  test::ProbeRun run(corner(), test::small_profile(), test::probe_settings(), above(camera));
  EXPECT_TRUE(run.renderer.plan().catcher_probes);
  run.run(5);
  EXPECT_GT(run.frame.counters.rays[RayKind::catcher_probe], 0);
  const Scene nothing;
  test::expect_same_bits(test::render(nothing, test::small_profile(), test::planar_settings(), run.sample),
                         run.frame);
}

TEST(ProbeCatcherTest, ARedBoxReddensTheFloorBesideIt) {
  const test::TestCamera camera = even_feed();
  Scene scene = corner();
  test::add(scene, test::box({0.8f, 0.01f, -1}, {1.2f, 1.5f, 1}), test::matte({0.9f, 0.05f, 0.05f}));
  const DisplayProfile profile = test::single_view(64, 64, 40, 40);
  test::ProbeRun run(scene, profile, test::probe_settings(), above(camera));
  run.run(60);
  int reddened = 0;
  test::for_each_pixel(run.frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    // The floor within 0.2 ... 0.6 m of the box's face at x = 0.8, in the lamp's light.
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    const double at_x = 2 * d.x / -d.z, at_z = -2 * d.y / -d.z;
    if (at_x < 0.2 || at_x > 0.6 || std::abs(at_z) > 0.5) return;
    ++reddened;
    EXPECT_GT(pixel[0], 1.01 * pixel[1]) << x << ", " << y;
    EXPECT_GT(pixel[0], 0.5);  // a wall in the light adds light
  });
  EXPECT_GT(reddened, 50);
}

TEST(ProbeCatcherTest, TheSecondSetExistsForCatchersAndProbesOnly) {
  Scene scene = corner();
  RenderSettings settings = test::probe_settings();
  EXPECT_TRUE(plan_frame(scene, settings, true).catcher_probes);
  EXPECT_TRUE(plan_frame(scene, settings, true).coloured_ratio);
  settings.probes.on = false;
  EXPECT_FALSE(plan_frame(scene, settings, true).catcher_probes);
  settings.probes.on = true;
  for (Instance& instance : scene.instances) instance.catcher = false;
  EXPECT_FALSE(plan_frame(scene, settings, true).catcher_probes);
  EXPECT_TRUE(plan_frame(scene, settings, true).probes);
}

}  // namespace
}  // namespace herr
