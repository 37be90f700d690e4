// Soft shadows of a straight edge under a large light, against the light's visible share in double; and light
// samples that are spent only where they disagree.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <vector>

#include "renderer/direct_light/light_records.h"
#include "tests/renderer/penumbra_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

using test::edge_scene;

// Mean absolute error of the visible share over the penumbra, for N samples.
double penumbra_error(const glm::vec3& light_size, int samples, int first_samples = 0,
                      FrameCounters* counters = nullptr) {
  const Scene scene = edge_scene(light_size);
  const DisplayProfile profile = test::penumbra_view(96, 24);
  RenderSettings settings = test::planar_settings();
  settings.light_samples = samples;
  settings.adaptive_min_samples = first_samples;
  const RenderedFrame frame = test::render(scene, profile, settings, test::penumbra_sample());
  Scene open = scene;
  open.instances.pop_back();
  const RenderedFrame unshadowed = test::render(open, profile, settings, test::penumbra_sample());
  if (counters) *counters = frame.counters;
  const std::vector<double> seen = test::shares_of(frame.viewports[0], unshadowed.viewports[0]),
                            exact = test::exact_shares(scene.lights[0], profile.viewports[0]);
  double sum = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) sum += std::abs(seen[i] - exact[i]);
  return sum / static_cast<double>(seen.size());
}

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

TEST(AdaptiveLightTest, APenumbraKeepsItsErrorAndTheRestOfTheFloorTracesFewerRays) {
  FrameCounters all, adaptive;
  const double error_all = penumbra_error({0.3f, 0, 0.3f}, 64, 0, &all);
  const double error_adaptive = penumbra_error({0.3f, 0, 0.3f}, 64, 8, &adaptive);
  const double saved =
      static_cast<double>(all.rays[RayKind::shadow]) / static_cast<double>(adaptive.rays[RayKind::shadow]);
  std::cout << "mean error " << error_all << " and " << error_adaptive << " with " << saved
            << " times fewer rays\n";
  // The penumbra of a light of 0.3 m is a quarter of the floor that is seen: were every hit of it to
  // trace 64 rays and the others 4, that would be 64 / (0.25 * 64 + 0.75 * 4) = 3.4 times fewer;
  // predicted strata make it more.
  EXPECT_GT(saved, 3.4);
  EXPECT_LE(error_adaptive, error_all + 1e-3);
}

// Of each tenth of what is seen of the light, the mean error: a screen on one side of the light's middle or
// on the other, many frames of other random numbers.
struct TenthError {
  double mean = 0, standard_error = 0;
};
std::array<TenthError, 10> errors_by_tenth(const glm::vec3& light_size, bool mirrored) {
  constexpr int kFrames = 20;
  Scene scene = edge_scene(light_size);
  if (mirrored) scene.instances.back().world_from_object[3].x += 50;
  const DisplayProfile profile = test::penumbra_view(96, 24);
  RenderSettings settings = test::planar_settings();
  settings.light_samples = 64;
  Scene open = scene;
  open.instances.pop_back();
  std::vector<double> exact = test::exact_shares(scene.lights[0], profile.viewports[0]);
  const auto width = static_cast<std::size_t>(profile.viewports[0].width_px);
  if (mirrored) {
    for (std::size_t row = 0; row < exact.size(); row += width) {
      std::reverse(exact.begin() + static_cast<std::ptrdiff_t>(row),
                   exact.begin() + static_cast<std::ptrdiff_t>(row + width));
    }
  }
  const RenderedFrame unshadowed = test::render(open, profile, settings, test::penumbra_sample());
  std::array<std::vector<double>, 10> of_frames;  // the mean error of each frame
  for (int frame = 0; frame < kFrames; ++frame) {
    settings.seed = static_cast<std::uint32_t>(frame);
    const RenderedFrame picture = test::render(scene, profile, settings, test::penumbra_sample());
    const std::vector<double> seen = test::shares_of(picture.viewports[0], unshadowed.viewports[0]);
    std::array<double, 10> sum{}, count{};
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (exact[i] <= 0.001 || exact[i] >= 0.999) continue;
      const auto tenth = static_cast<std::size_t>(exact[i] * 10);
      sum.at(tenth) += seen[i] - exact[i];
      count.at(tenth) += 1;
    }
    for (std::size_t t = 0; t < 10; ++t) of_frames.at(t).push_back(sum.at(t) / std::max(count.at(t), 1.0));
  }
  std::array<TenthError, 10> out;
  for (std::size_t t = 0; t < 10; ++t) {
    double mean = 0, square = 0;
    for (const double error : of_frames.at(t)) mean += error / kFrames;
    for (const double error : of_frames.at(t)) square += (error - mean) * (error - mean);
    out.at(t) = {mean, std::sqrt(square / (kFrames - 1) / kFrames)};
  }
  return out;
}

// Twenty frames leave a standard error of 0.0008 at most.
TEST(PenumbraTest, ItsMeanIsRightWhicheverSideIsHidden) {
  for (const glm::vec3& size : {glm::vec3{0.5f, 0, 0.5f}, glm::vec3{0.5f, 0.4f, 0.5f}}) {
    for (const bool mirrored : {false, true}) {
      const std::array<TenthError, 10> errors = errors_by_tenth(size, mirrored);
      for (std::size_t t = 0; t < 10; ++t) {
        EXPECT_LE(std::abs(errors.at(t).mean), 0.003)
            << size.y << (mirrored ? " +x" : " -x") << ", tenth " << t;
        EXPECT_LE(errors.at(t).standard_error, 0.001);
      }
    }
  }
}

TEST(AdaptiveLightTest, AsManyFirstSamplesAsThereAreIsTheSamePicture) {
  const Scene scene = edge_scene({1, 0, 1});
  RenderSettings settings = test::small_settings();
  settings.light_samples = 16;
  const RenderedFrame plain =
      test::render(scene, test::small_profile(), settings, test::looking_down({0, 0.9, 0}));
  settings.adaptive_min_samples = 16;
  test::expect_same_bits(
      plain, test::render(scene, test::small_profile(), settings, test::looking_down({0, 0.9, 0})));
}

// What the picture then is: SplitLightTest.
TEST(AdaptiveLightTest, WithoutAnythingInTheWayNeighboursShareTheirFirstRays) {
  Scene scene;
  test::add(scene, test::floor_quad(10), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({0.2, 2, 0.1}, glm::vec3{4.0f}, {1, 0.5f, 1})};
  RenderSettings settings = test::small_settings();
  settings.light_samples = 64;
  const RenderedFrame plain =
      test::render(scene, test::small_profile(), settings, test::looking_down({0, 1, 0}));
  settings.adaptive_min_samples = 4;
  const RenderedFrame adaptive =
      test::render(scene, test::small_profile(), settings, test::looking_down({0, 1, 0}));
  // 4 of 64 samples, and neighbours share them: 2 rays of 64 for all but the few hits without a neighbour.
  const double saved = static_cast<double>(plain.counters.rays[RayKind::shadow]) /
                       static_cast<double>(adaptive.counters.rays[RayKind::shadow]);
  EXPECT_GT(saved, 24);
  EXPECT_LE(saved, 32);
}

TEST(AdaptiveLightTest, AnyFewFirstStrataLieFarApart) {
  // 8 of 8 x 8 strata: at most two in any row or column.
  const int stride = spreading_stride(64);
  std::array<int, 8> rows{}, columns{};
  for (int s = 0; s < 8; ++s) {
    ++columns[static_cast<std::size_t>(s * stride % 64 % 8)];
    ++rows[static_cast<std::size_t>(s * stride % 64 / 8)];
  }
  for (int i = 0; i < 8; ++i) {
    EXPECT_LE(rows[static_cast<std::size_t>(i)], 2) << i;
    EXPECT_LE(columns[static_cast<std::size_t>(i)], 2) << i;
  }
  // A permutation for every count.
  for (int samples = 1; samples <= 300; ++samples) {
    std::vector<int> seen(static_cast<std::size_t>(samples));
    for (int s = 0; s < samples; ++s)
      ++seen[static_cast<std::size_t>(s * spreading_stride(samples) % samples)];
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), samples);
  }
}

TEST(AdaptiveLightTest, SamplesTakeEveryStratumOnceAndTheEvenLatticeFirst) {
  for (const glm::vec3& size : {glm::vec3{1, 0, 1}, glm::vec3{1, 1, 1}, glm::vec3{0, 2, 0}}) {
    for (const int samples : {2, 12, 64, 256}) {
      LightRecord light;
      light.samples = samples;
      const auto strata = strata_for(size, samples);
      std::copy(strata.begin(), strata.end(), light.strata);
      order_strata(light);
      bool lattice = true;
      std::vector<int> taken(static_cast<std::size_t>(samples));
      for (std::size_t s = 0; s < static_cast<std::size_t>(samples); ++s) {
        const int stratum = light.stratum_of[s];
        ++taken.at(static_cast<std::size_t>(stratum));
        EXPECT_EQ(light.sample_of.at(static_cast<std::size_t>(stratum)), s);
        const int x = stratum % strata[0], y = stratum / strata[0] % strata[1],
                  z = stratum / (strata[0] * strata[1]);
        const bool even = x % 2 == 0 && y % 2 == 0 && z % 2 == 0;
        EXPECT_TRUE(lattice || !even) << samples << ": sample " << s << " goes back to the lattice";
        lattice = even;
      }
      EXPECT_EQ(std::count(taken.begin(), taken.end(), 1), samples);
    }
  }
}

TEST(AdaptiveLightTest, ThePlanSaysWhenTooManySamplesAreAllTraced) {
  const Scene scene = edge_scene({1, 0, 1});
  RenderSettings settings = test::small_settings();
  settings.adaptive_min_samples = 8;
  settings.light_samples = 256;
  EXPECT_TRUE(plan_frame(scene, settings, false).light_sampling(256).adaptive());
  settings.light_samples = 257;
  EXPECT_FALSE(plan_frame(scene, settings, false).light_sampling(257).adaptive());
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
