// Indirect light over time: its recurrence, the reaction to large change, time that stands, jumps or turns.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <vector>

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

// Slope of a straight line through (n, ln e), n = 1, 2, ..., and half the width of its 95 % interval.
std::array<double, 2> logarithmic_slope(const std::vector<double>& e) {
  constexpr double kT28 = 2.048;  // Student's, 97.5 % at 28 degrees of freedom: 30 points
  const auto count = static_cast<double>(e.size());
  double mean = 0, sxx = 0, sxy = 0, rest = 0;
  for (const double value : e) mean += std::log(value) / count;
  const auto from_middle = [&](std::size_t i) { return static_cast<double>(i) - 0.5 * (count - 1); };
  for (std::size_t i = 0; i < e.size(); ++i) {
    sxx += from_middle(i) * from_middle(i), sxy += from_middle(i) * (std::log(e[i]) - mean);
  }
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double off = std::log(e[i]) - mean - sxy / sxx * from_middle(i);
    rest += off * off;
  }
  return {sxy / sxx, kT28 * std::sqrt(rest / (count - 2) / sxx)};
}

// Walls that send back a thousandth and shine with nothing: what probes see of a light that goes on is the
// same from the first frame, so the fifth root x of what they have gathered nears its end by
// x <- h x + (1 - h) y: its error is h^n.
TEST(ProbeTimeTest, FromDarkTheErrorFallsByItsRecurrence) {
  constexpr std::size_t kFrames = 30;
  Scene scene;
  Material wall = test::matte(glm::vec3{0.001f});
  wall.specular = 0;
  test::add(scene, test::sphere({0, 0, 0}, 1, 48, 96), wall);
  scene.lights = {test::light_at({0, 0, 0}, glm::vec3{1000.0f})};
  scene.probes.counts = {4, 4, 4};
  RenderSettings settings = test::probe_settings(0.1);
  settings.probes.react = false;
  test::ProbeRun run(scene, test::single_view(4, 4, 40, 40), settings, test::sample_from({0, 0, 0}));
  run.state.lights[0].intensity_w_sr = glm::vec3{0.0f};
  run.run(1);  // the first frame would take all that it sees
  run.state.lights[0].intensity_w_sr = glm::vec3{1000.0f};
  const auto gathered = [&] {  // of the first direction, mean of probes that see light
    double sum = 0;
    int probes = 0;
    const std::vector<float>& all = run.volume().sets[0].gathered;
    for (std::size_t i = 0; i < all.size(); i += kLightFloats) {
      if (all[i] > 0) sum += double{all[i]}, ++probes;
    }
    EXPECT_GE(probes, 8);
    return sum / probes;
  };
  std::vector<double> error;
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    run.run(1);
    error.push_back(gathered());
  }
  run.run(120);  // e^-17 is left
  const double end = gathered();
  for (double& x : error) x = end - x;
  const auto [slope, interval] = logarithmic_slope(error);
  const double expected = -1.0 / 90 / 0.1;
  std::cout << "ln h = " << expected << ", fitted " << slope << " +- " << interval << "\n";
  // What walls send back slows it by a thousandth; rays that scatter over the walls' facets add noise.
  EXPECT_NEAR(slope, expected, std::max(interval, 0.002 * std::abs(expected)));
  EXPECT_LT(interval, 0.02 * std::abs(expected));
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
