// Walls hold indirect light: a room parted by a wall of 5 cm that no probe was told about.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/renderer/probes/probe_scenes.h"

namespace herr {
namespace {

constexpr float kWidth = 5, kHeight = 2.5f, kDepth = 10, kWall = 0.05f, kAlbedo = 0.5f;

// A closed room; a wall across it whose middle lies at `place` along `axis` (0: x, 2: z).
Scene parted_room(int axis, float place) {
  Scene scene;
  test::add(scene, test::box({0, 0, 0}, {kWidth, kHeight, kDepth}), test::matte(glm::vec3{kAlbedo}));
  glm::vec3 lower{-0.01f}, upper{kWidth + 0.01f, kHeight + 0.01f, kDepth + 0.01f};
  lower[axis] = place - 0.5f * kWall, upper[axis] = place + 0.5f * kWall;
  test::add(scene, test::box(lower, upper), test::matte(glm::vec3{kAlbedo}));
  scene.lights = {test::light_at({1.2, 1.4, 2.1}, glm::vec3{5.0f})};
  scene.probes.box = Bounds{{0, 0, 0}, {kWidth, kHeight, kDepth}};
  return scene;
}

// Light from all sides at what six views from `head` see.
std::vector<double> light_around(test::ProbeRun& run, Renderer& direct, const glm::dvec3& head) {
  std::vector<double> all;
  RenderedFrame without;
  for (int side = 0; side < 6; ++side) {
    run.sample.head.world_from_head.position = head;
    const double quarter = glm::half_pi<double>();
    run.sample.head.world_from_head.orientation =
        side < 4 ? glm::angleAxis(side * quarter, glm::dvec3{0, 1, 0})
                 : glm::angleAxis(side == 4 ? quarter : -quarter, glm::dvec3{1, 0, 0});
    run.run(1, 1e6);
    direct.render_frame(run.sample, run.state, without);
    const auto pixels = test::indirect_of_pixels(run.frame.viewports[0], without.viewports[0], kAlbedo);
    all.insert(all.end(), pixels.begin(), pixels.end());
  }
  return all;
}

struct Leak {
  double mean = 0, largest = 0;  // of the dark side's indirect light, relative to the mean of the lit side's
};
Leak leak_through(int axis, float place) {
  const DisplayProfile view = test::single_view(64, 64, 45, 45);
  const Scene scene = parted_room(axis, place);
  test::ProbeRun run(scene, view, test::probe_settings(0.05), test::sample_from({1, 1.2, 1}));
  RenderSettings direct_settings = test::probe_settings();
  direct_settings.probes.on = false;
  Renderer direct(scene, view, direct_settings, false);
  run.run(12);
  const double lit = test::mean_of(light_around(run, direct, {1.5, 1.1, 1.5}));
  glm::dvec3 behind{1.5, 1.1, 1.5};
  behind[axis] = place + 0.8;
  const std::vector<double> dark = light_around(run, direct, behind);
  return {test::mean_of(dark) / lit, *std::max_element(dark.begin(), dark.end()) / lit};
}

// Cells are 5 / 16 by 2.5 / 8 by 10 / 16 m; probe i stands at (i + 1/2) of them. The wall is put through a
// layer of probes and at three places between two layers.
TEST(ProbeLeakTest, AThinWallHoldsTheLight) {
  for (const int axis : {0, 2}) {
    const float cell = (axis == 0 ? kWidth : kDepth) / 16;
    for (const float share : {0.0f, 0.25f, 0.5f, 0.75f}) {
      if (axis == 0 && share != 0 && share != 0.5f) continue;
      SCOPED_TRACE(testing::Message() << "axis " << axis << ", " << share << " of a cell past a probe");
      const Leak leak = leak_through(axis, (8.5f + share) * cell);
      EXPECT_LE(leak.mean, 0.001);
      EXPECT_LE(leak.largest, 0.01);
    }
  }
}

}  // namespace
}  // namespace herr
