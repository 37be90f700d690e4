// Soft shadows of a straight edge under a large light, against the light's visible share in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <vector>

#include "renderer/direct_light/light_records.h"
#include "tests/renderer/direct_light/penumbra_error.h"
#include "tests/renderer/penumbra_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

using test::edge_scene;
using test::penumbra_error;

// Slope of a straight line through (log n, log error) by least squares.
double slope(const std::vector<double>& n, const std::vector<double>& error) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto count = static_cast<double>(n.size());
  for (std::size_t i = 0; i < n.size(); ++i) {
    const double x = std::log(n[i]), y = std::log(error[i]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

TEST(PenumbraTest, AFlatLightsEdgeIsRightToAHundredthAndItsErrorFallsWithThreeQuarters) {
  // n x n strata: the edge crosses n of them, each a coin of deviation 1/2 at most, so the share's deviation
  // is sqrt(n) / 2 / n^2 = N^(-3/4) / 2; independent samples would give N^(-1/2).
  std::vector<double> n, error;
  for (const int samples : {4, 16, 64, 256}) {
    n.push_back(samples);
    error.push_back(penumbra_error({1, 0, 1}, samples));
    std::cout << samples << " samples: mean error " << error.back() << "\n";
  }
  EXPECT_LE(error.back(), 0.01);
  std::cout << "slope " << slope(n, error) << "\n";
  EXPECT_LE(slope(n, error), -0.70);
}

TEST(PenumbraTest, ABoxLightsErrorFallsWithTwoThirds) {
  // n^3 strata: the edge's plane crosses about n^2 of them, so the deviation is n / 2 / n^3 = N^(-2/3) / 2.
  std::vector<double> n, error;
  for (const int samples : {8, 64, 512}) {
    n.push_back(samples);
    error.push_back(penumbra_error({1, 0.6f, 1}, samples));
    std::cout << samples << " samples: mean error " << error.back() << "\n";
  }
  std::cout << "slope " << slope(n, error) << "\n";
  EXPECT_LE(slope(n, error), -0.62);
  EXPECT_LE(penumbra_error({1, 0.6f, 1}, 256), 0.01);
}

TEST(LightSamplesTest, MayChangeFromFrameToFrame) {
  const Scene scene = edge_scene({1, 0, 1});
  const RenderSettings settings = test::small_settings();
  Renderer renderer(scene, test::small_profile(), settings, false);
  SceneState state;
  scene_state_at(scene, 0, state);
  RenderedFrame frame;
  const FrameSample sample = test::looking_down({0, 0.9, 0});
  renderer.render_frame(sample, state, {16}, frame);
  const std::int64_t soft = frame.counters.rays[RayKind::shadow];
  renderer.render_frame(sample, state, {1}, frame);
  // Samples of one hit face the light or not one by one, the floor and the screen's underside alike: 16 times
  // within a few per cent.
  EXPECT_NEAR(static_cast<double>(soft) / static_cast<double>(frame.counters.rays[RayKind::shadow]), 16, 1);
  RenderSettings sixteen = settings;
  sixteen.light_samples = 16;
  renderer.render_frame(sample, state, {16}, frame);
  test::expect_same_bits(frame, test::render(scene, test::small_profile(), sixteen, sample));
  EXPECT_THROW(renderer.render_frame(sample, state, {0}, frame), std::invalid_argument);
  EXPECT_THROW(renderer.render_frame(sample, state, {4097}, frame), std::invalid_argument);
}

}  // namespace
}  // namespace herr
