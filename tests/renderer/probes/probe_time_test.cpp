// Indirect light over time: its recurrence, the reaction to large change, time that stands, jumps or turns.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/probes/probe_scenes.h"

namespace herr {
namespace {

constexpr float kAlbedo = 0.5f;

Scene sphere_room() {
  Scene scene;
  test::add(scene, test::sphere({0, 0, 0}, 1), test::matte(glm::vec3{kAlbedo}));
  scene.lights = {test::light_at({0, 0, 0}, glm::vec3{1.0f})};
  scene.probes.counts = {6, 6, 6};
  return scene;
}

// With corners, a lamp near a wall and so uneven light: probe rays scatter.
Scene box_room() {
  Scene scene;
  test::add(scene, test::box({-2, -1.25f, -2.5f}, {2, 1.25f, 2.5f}), test::matte(glm::vec3{kAlbedo}));
  scene.lights = {test::light_at({1, 0.8, -1.4}, glm::vec3{3.0f})};
  scene.probes.counts = {8, 6, 8};
  return scene;
}

const DisplayProfile& view() {
  static const DisplayProfile profile = test::single_view(16, 16, 40, 40);
  return profile;
}

// Mean indirect light of the view once all lights are out: nothing else is left in the picture.
double level_in_the_dark(const test::ProbeRun& run) {
  double sum = 0;
  int pixels = 0;
  test::for_each_pixel(run.frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
    sum += pixel[1];
    ++pixels;
  });
  return sum / pixels / test::scattered_share(kAlbedo);
}

double level_in_the_light(const test::ProbeRun& run) {
  RenderSettings settings = test::planar_settings();
  const RenderedFrame direct = test::render(run.scene, view(), settings, run.sample);
  return test::mean_of(test::indirect_of_pixels(run.frame.viewports[0], direct.viewports[0], kAlbedo));
}

// Dark walls send back rho of what they get, so x <- h x + (1 - h) (rho x^5)^(1/5) for x = L^(1/5): each
// frame leaves (h + (1 - h) rho^(1/5))^5 of the light.
TEST(ProbeTimeTest, WithoutReactionLightFadesByItsRecurrence) {
  RenderSettings settings = test::probe_settings(0.1);
  settings.probes.react = false;
  test::ProbeRun run(sphere_room(), view(), settings, test::sample_from({0, 0, 0}));
  run.run(120);
  const double start = level_in_the_light(run);
  run.state.lights[0].intensity_w_sr = glm::vec3{0.0f};
  const double h = std::exp(-1.0 / 90 / 0.1), keeps = std::pow(h + (1 - h) * std::pow(kAlbedo, 0.2), 5);
  for (int frame = 1; frame <= 20; ++frame) {
    run.run(1);
    const double expected = start * std::pow(keeps, frame);
    ASSERT_NEAR(level_in_the_dark(run), expected, 0.02 * expected) << frame;
    ASSERT_EQ(run.frame.probes.reacting, 0);
  }
}

TEST(ProbeTimeTest, ALightThatGoesOutIsForgottenInTwoThirdsOfASecond) {
  test::ProbeRun run(box_room(), view(), test::probe_settings(), test::sample_from({0, 0, 1}));
  run.run(90);
  const double start = level_in_the_light(run);
  run.state.lights[0].intensity_w_sr = glm::vec3{0.0f};
  double lowest = start;
  for (int frame = 1; frame <= 60; ++frame) {
    run.run(1);
    const double level = level_in_the_dark(run);
    ASSERT_LE(level, lowest + 0.005 * start) << frame;
    lowest = std::min(lowest, level);
  }
  EXPECT_LT(lowest, 0.05 * start);
}

TEST(ProbeTimeTest, ALampThatFlickersByATenthIsNoChange) {
  test::ProbeRun run(box_room(), view(), test::probe_settings(), test::sample_from({0, 0, 1}));
  run.run(90);
  for (int frame = 0; frame < 60; ++frame) {
    run.state.lights[0].intensity_w_sr = glm::vec3{frame % 2 == 0 ? 3.3f : 2.7f};
    run.run(1);
    ASSERT_EQ(run.frame.probes.reacting, 0) << frame;
    ASSERT_LT(run.frame.probes.variability, 0.25);
  }
}

TEST(ProbeTimeTest, LightThatCannotLeaveStaysFinite) {
  Scene scene = sphere_room();
  scene.materials[0].base_colour = glm::vec3{1.0f};
  scene.probes.counts = {3, 3, 3};
  RenderSettings settings = test::probe_settings(0);
  settings.probes.rays = 8;
  test::ProbeRun run(scene, test::single_view(4, 4, 40, 40), settings, test::sample_from({0, 0, 0}));
  for (int second = 0; second < 100; ++second) {
    run.run(100);
    test::expect_finite(run.frame);
  }
}

TEST(ProbeTimeTest, TimeMayStandJumpAndTurnBack) {
  for (const double tau_s : {0.0, 0.365, 11.1}) {  // 11.1 s: 0.999 kept at 90 Hz
    SCOPED_TRACE(tau_s);
    test::ProbeRun fresh(box_room(), view(), test::probe_settings(tau_s), test::sample_from({0, 0, 1}));
    test::ProbeRun run(box_room(), view(), test::probe_settings(tau_s), test::sample_from({0, 0, 1}));
    const TimeNs start = run.sample.t_ns;
    run.run(3);
    if (tau_s > 0) {
      // Nothing is gathered in no time: the same frame again is the same picture.
      run.sample.t_ns = start + 50'000'000;
      run.run(1);
      const RenderedFrame once = run.frame;
      run.sample.t_ns = start + 50'000'000;
      run.run(1);
      test::expect_same_bits(once, run.frame);
    }
    run.sample.t_ns += 7'200'000'000'000;
    run.run(1);
    test::expect_finite(run.frame);
    // Back at the start, everything is as in a renderer that has seen nothing.
    run.sample.t_ns = start;
    run.run(5);
    fresh.run(5);
    test::expect_same_bits(fresh.frame, run.frame);
  }
}

}  // namespace
}  // namespace herr
