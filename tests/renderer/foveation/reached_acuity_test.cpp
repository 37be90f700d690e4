// k against the angles between neighbouring rays of the samples that a frame traces, and against brute force.
#include "renderer/foveation/reached_acuity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "renderer/foveation/polar_samples.h"
#include "renderer/frame/renderer_impl.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr std::array<double, 6> kPlaces_deg{0, 1, 5, 10, 20, 45};

// The ray of a sample, in the gaze frame, of the very numbers that rays are made of.
glm::dvec3 ray(const PolarSamples& samples, int column, int row) {
  const double sine = samples.sin_theta()[column], cosine = samples.cos_theta()[column];
  const std::size_t r = 4 * static_cast<std::size_t>(row);
  return {sine * samples.cos_phi4()[r], sine * samples.sin_phi4()[r], cosine};
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * kDegreesPerRadian;
}

double theta_deg(const PolarSamples& samples, int column) {
  return angle_deg(ray(samples, column, 0), {0, 0, 1});
}

// The column whose sample and the next one enclose theta, as well as may be.
int column_at(const PolarSamples& samples, double theta) {
  const double column = samples.map().u_from_theta(theta) * samples.width() - 0.5;
  return std::clamp(static_cast<int>(std::floor(column)), 0, samples.width() - 2);
}

double measured_radial_k(const PolarSamples& samples, int column) {
  const double spacing = angle_deg(ray(samples, column, 5), ray(samples, column + 1, 5));
  // Of an interval of a logarithmic map the density is that of its geometric middle.
  return std::sqrt((theta_deg(samples, column) + 1) * (theta_deg(samples, column + 1) + 1)) / spacing;
}

double measured_angular_k(const PolarSamples& samples, int column) {
  const double spacing = angle_deg(ray(samples, column, 5), ray(samples, column, 6));
  return (theta_deg(samples, column) + 1) / spacing;
}

// Rays are floats: sin(theta) is off by 2^-24 of itself, at 45 degrees by 4e-8 of a spacing of 0.2 degrees =
// 4e-3, and a chord differs from its arc by (pi / H)^2 / 6 < 3e-6. Between samples the map is logarithmic:
// 1 / (24 k^2) < 1e-5.
constexpr double kSame = 5e-5;

TEST(ReachedAcuityTest, KIsOneOverTheAngleBetweenNeighbouringRays) {
  // The paper's sizes, and what the acuity asks for; gaze at the centre and at a corner of xr1.
  for (const double theta_max : {54.7356, 72.1, 109.471}) {
    for (const auto& [width, height] :
         {std::pair{788, 768}, {1024, 1024}, {acuity_width(theta_max), kAcuityHeight}}) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << " up to " << theta_max);
      PolarSamples samples(width, height);
      samples.update(PolarMap::up_to(theta_max), width, height);
      const ReachedAcuity reached = reached_acuity(theta_max, width, height);
      for (const double place : kPlaces_deg) {
        const int column = column_at(samples, place);
        EXPECT_NEAR(measured_radial_k(samples, column) / reached.k_radial, 1, kSame) << place;
        EXPECT_NEAR(measured_angular_k(samples, column) / k_angular_at(theta_deg(samples, column), height), 1,
                    kSame)
            << place;
      }
      double least = 1e300, at = 0;
      for (int column = 0; column < width; ++column) {
        const double k = measured_angular_k(samples, column);
        if (k < least) least = k, at = theta_deg(samples, column);
      }
      EXPECT_NEAR(least / reached.k_angular, 1, kSame);
      // Around its least the function is flat: k differs by 5e-5 within half a degree.
      EXPECT_NEAR(at, reached.k_angular_at_deg, 0.5);
    }
  }
}

// By hand: 788 / ln(55.7356) = 196.0, 788 / ln(73.1) = 183.6; 768 * 11 / (360 sin 10 deg) = 135.1, that
// is 12.3 samples per degree where 200 / 11 = 18.2 are asked for.
TEST(ReachedAcuityTest, TheDefaultReachesWhatTheReadmeSays) {
  EXPECT_NEAR(reached_acuity(54.7356, 788, 768).k_radial, 196.0, 0.05);
  EXPECT_NEAR(reached_acuity(72.1, 788, 768).k_radial, 183.6, 0.05);
  EXPECT_NEAR(k_angular_at(10, 768) / 11, 12.3, 0.05);
  EXPECT_NEAR(acuity_per_degree(10), 18.2, 0.05);
}

TEST(ReachedAcuityTest, SizesAreTheFewestThatReachItEverywhere) {
  for (const double theta_max : {1e-3, 0.5, 2.0, 10.0, 15.0, 20.9, 21.2, 45.0, 90.0, 135.0, 180.0}) {
    SCOPED_TRACE(theta_max);
    double rows = 0;
    for (int i = 1; i <= 100'000; ++i) {
      const double theta = theta_max * i / 100'000;
      rows = std::max(rows, 200.0 / (theta + 1) * 360 * std::sin(theta / kDegreesPerRadian));
    }
    const int height = acuity_height(theta_max), width = acuity_width(theta_max);
    EXPECT_EQ(height % 2, 0);
    EXPECT_GE(height, rows);
    EXPECT_LT(height - 2, rows);
    EXPECT_GE(width, 200 * std::log(theta_max + 1) * (1 - 1e-12));
    EXPECT_LT(width - 1, 200 * std::log(theta_max + 1));
    EXPECT_LE(height, kAcuityHeight);
    EXPECT_LE(width, kMostAcuityWidth);
  }
  EXPECT_EQ(acuity_height(180), kAcuityHeight);
  EXPECT_EQ(acuity_width(180), kMostAcuityWidth);
}

RenderSettings acuity_settings() {
  RenderSettings settings = test::small_settings();
  settings.polar_acuity = true;
  return settings;
}

Scene floor_scene() {
  Scene scene;
  test::add(scene, test::floor_quad(20, -1.5f), test::matte(glm::vec3{0.3f}));
  scene.lights.push_back(test::light_at({1, 3, 0}, glm::vec3{20.0f}));
  return scene;
}

// Directions over all of a viewport, its borders and corners among them.
std::vector<glm::dvec3> directions_of(const Viewport& v) {
  constexpr int kSteps = 160;
  std::vector<glm::dvec3> all;
  for (int y = 0; y <= kSteps; ++y) {
    for (int x = 0; x <= kSteps; ++x) {
      all.push_back({v.tan_left + (v.tan_right - v.tan_left) * x / kSteps,
                     v.tan_down + (v.tan_up - v.tan_down) * y / kSteps, -1});
    }
  }
  return all;
}

// Samples on both sides of a direction: they are nowhere farther apart than 1 / f, but for 1 %, half of which
// a direction at one end of its interval is off: exp(1 / 200).
TEST(ReachedAcuityTest, PolarAcuityReachesItInEveryDirectionOfTheDisplay) {
  const Scene scene = floor_scene();
  const DisplayProfile profile = test::small_profile();
  Renderer renderer(scene, profile, acuity_settings(), false);
  RenderedFrame frame;
  for (const glm::dvec3& gaze :
       {glm::dvec3{0, 0, -1}, test::gaze_deg(15, 0), glm::dvec3{1, 1, -1}, test::gaze_deg(-40, 20)}) {
    test::render_with(renderer, scene, test::sample_from({0, 0, 0}, gaze), frame);
    for (const Eye eye : kEyes) {
      const auto e = static_cast<std::size_t>(eye);
      const PolarSamples& samples = *renderer.internals().samples[e];
      EXPECT_EQ(samples.width(), acuity_width(frame.theta_max_deg[e]));
      double least_radial = 1e300, least_angular = 1e300;
      for (const Viewport& viewport : profile.viewports) {
        if (viewport.eye != eye) continue;
        for (const glm::dvec3& direction : directions_of(viewport)) {
          const double theta = angle_deg(direction, gaze);
          const int column = column_at(samples, theta);
          least_radial = std::min(
              least_radial, (theta + 1) / angle_deg(ray(samples, column, 0), ray(samples, column + 1, 0)));
          // Of both circles around it the one that is longer.
          const double around = std::max(angle_deg(ray(samples, column, 0), ray(samples, column, 1)),
                                         angle_deg(ray(samples, column + 1, 0), ray(samples, column + 1, 1)));
          least_angular = std::min(least_angular, (theta + 1) / around);
        }
      }
      EXPECT_GE(least_radial, 198) << "gaze " << gaze.x << " " << gaze.y;
      EXPECT_GE(least_angular, 198) << "gaze " << gaze.x << " " << gaze.y;
      EXPECT_LE(least_angular, 201) << "more rows than needed";
      const ReachedAcuity told =
          reached_acuity(frame.theta_max_deg[e], frame.polar_width[e], frame.polar_height);
      EXPECT_GE(told.k_radial, 200);
      EXPECT_GE(told.k_angular, 200);
      EXPECT_LE(told.k_radial, 200.3) << "one column of some 800 at most";
    }
  }
}

TEST(ReachedAcuityTest, PolarAcuityGivesTheBytesOfThatSize) {
  const Scene scene = floor_scene();
  const DisplayProfile profile = test::small_profile();
  RenderSettings acuity = acuity_settings();
  for (const glm::dvec3& gaze : {glm::dvec3{0, 0, -1}, test::gaze_deg(15, 10)}) {
    const FrameSample sample = test::sample_from({0, 0, 0}, gaze);
    const RenderedFrame frame = test::render(scene, profile, acuity, sample);
    RenderSettings sized = test::small_settings();
    sized.polar_width = acuity_width(frame.theta_max_deg[0]);
    sized.polar_height = kAcuityHeight;
    EXPECT_EQ(frame.quality.polar_width, sized.polar_width);
    test::expect_same_bits(frame, test::render(scene, profile, sized, sample));
  }
}

// Each eye has its own number of columns; a narrower frame keeps the same share of each.
TEST(ReachedAcuityTest, EyesThatLookApartHaveWidthsOfTheirOwn) {
  const Scene scene = floor_scene();
  Renderer renderer(scene, test::small_profile(), acuity_settings(), false);
  FrameSample sample = test::sample_from({0, 0, 0});
  sample.gaze.head_direction = {test::gaze_deg(0, 0), test::gaze_deg(30, 20)};
  SceneState state;
  scene_state_at(scene, 0, state);
  RenderedFrame frame;
  renderer.render_frame(sample, state, frame);
  const std::array<int, 2> full{acuity_width(frame.theta_max_deg[0]), acuity_width(frame.theta_max_deg[1])};
  EXPECT_LT(full[0], full[1]);
  EXPECT_EQ(frame.polar_width, full);
  EXPECT_EQ(renderer.full_quality(sample).polar_width, full[1]);
  EXPECT_EQ(renderer.full_quality().polar_width, kMostAcuityWidth);
  renderer.render_frame(sample, state, {1, full[1] / 2, 0}, frame);
  EXPECT_EQ(frame.quality.polar_width, full[1] / 2);
  EXPECT_EQ(frame.polar_width[1], full[1] / 2);
  EXPECT_NEAR(frame.polar_width[0], full[0] * (full[1] / 2.0) / full[1], 1);
  renderer.render_frame(sample, state, {1, kMostAcuityWidth, 0}, frame);
  EXPECT_EQ(frame.quality.polar_width, full[1]) << "more than it can use";
  EXPECT_EQ(frame.polar_width, full);
}

TEST(ReachedAcuityTest, EveryPixelHasDataAndNothingMovesInMemory) {
  const Scene scene = floor_scene();
  Renderer renderer(scene, test::small_profile(), acuity_settings(), false);
  Renderer::Impl& inside = renderer.internals();
  const auto places = [&] {
    return std::array<const void*, 6>{inside.buffers[0].texels(),     inside.buffers[1].texels(),
                                      inside.samples[0]->sin_theta(), inside.samples[1]->sin_theta(),
                                      inside.samples[0]->spread(),    inside.samples[1]->margin()};
  };
  const auto before = places();
  RenderedFrame frame;
  for (const glm::dvec3& gaze : {glm::dvec3{0, 0, -1}, glm::dvec3{1, 1, -1}, glm::dvec3{0, 0, 1},
                                 test::gaze_deg(135, 0), test::gaze_deg(3, 1)}) {
    for (RadianceBuffer& buffer : inside.buffers)
      std::fill_n(buffer.texels(), 4 * buffer.texel_count(), std::uint16_t{0x7e00});  // NaN
    test::render_with(renderer, scene, test::sample_from({0, 0, 0}, gaze), frame);
    test::expect_finite(frame);
    EXPECT_EQ(places(), before);
  }
}

}  // namespace
}  // namespace herr
