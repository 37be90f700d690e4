// Adaptive samples split a lamp's light from what hides it: which samples are whose point's, and light that
// nothing hides against a quadrature in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <vector>

#include "renderer/direct_light/light_records.h"
#include "renderer/direct_light/shading_points.h"
#include "tests/renderer/direct_light/scalar_light.h"
#include "tests/renderer/penumbra_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

LightRecord lamp_of(const glm::vec3& size, int samples, int first) {
  const std::vector<AreaLight> lamps{test::light_at({0, 2, 0}, glm::vec3{1.0f}, size)};
  std::vector<LightRecord> records;
  light_records(lamps, glm::dvec3{0.0}, {samples, first, true}, {}, records);
  return records.at(0);
}

// Of strata and of points, places have the mean 0; squared, those of points have the mean 1, those of the
// middles of n strata 1 - 1 / n^2.
TEST(ShadingPointsTest, PlacesOfPointsVaryAsTheLampsLight) {
  for (const glm::vec3& size : {glm::vec3{0.4f, 0.1f, 0.4f}, glm::vec3{1, 0, 1}, glm::vec3{0, 2, 0}}) {
    for (const int samples : {12, 64, 250}) {
      const LightRecord light = lamp_of(size, samples, 4);
      std::vector<ShadingPoints> points;
      shading_points(std::vector<LightRecord>{light}, points);
      const LightRecord& few = points.at(0).light;
      EXPECT_LE(few.samples, kMostShadingPoints);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto moments = [](const auto& places, int count) {
          std::array<double, 2> sums{};
          for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            sums[0] += double{places[i]} / count, sums[1] += double{places[i]} * places[i] / count;
          return sums;
        };
        const auto of_points = moments(points[0].point_at[axis], few.samples);
        const auto of_strata = moments(points[0].stratum_at[axis], samples);
        const double n = light.strata[axis];
        EXPECT_NEAR(of_points[0], 0, 1e-5);
        EXPECT_NEAR(of_points[1], few.strata[axis] > 1 ? 1 : 0, 1e-5);
        EXPECT_NEAR(of_strata[0], 0, 1e-5);
        EXPECT_NEAR(of_strata[1], 1 - 1 / (n * n), 1e-5);
      }
    }
  }
}

// Two points along an axis are Gauss's, at 1 / sqrt(3) of the half edge: 0.2 / sqrt(3) = 0.11547 of 0.4 m.
TEST(ShadingPointsTest, TwoAlongAnAxisAreGausssPoints) {
  std::vector<ShadingPoints> points;
  shading_points(std::vector<LightRecord>{lamp_of({0.4f, 0.4f, 0.4f}, 64, 4)}, points);
  const LightRecord& few = points.at(0).light;
  ASSERT_EQ(few.samples, 8);
  for (int axis = 0; axis < 3; ++axis) {
    ASSERT_EQ(few.strata[axis], 2);
    EXPECT_NEAR(few.lower[axis] + 0.25f * few.size[axis], few.centre[axis] - 0.11547f, 1e-5);
  }
}

// Unlike samples, points have no noise. Of 0.4 m and less for each at 2 m their error is about 0.2^4, 0.0016
// of the light; halves round to 0.0005.
TEST(SplitLightTest, LightThatNothingHidesIsThatOfTheWholeLamp) {
  const DisplayProfile profile = test::penumbra_view(48, 12);
  RenderSettings settings = test::planar_settings();
  settings.light_samples = 64;
  settings.adaptive_min_samples = 8;
  for (const glm::vec3& size :
       {glm::vec3{0.5f, 0.4f, 0.5f}, glm::vec3{0.8f, 0.1f, 0.8f}, glm::vec3{1, 0, 0}}) {
    for (const float roughness : {1.0f, 0.6f}) {
      Scene scene;
      Material material = test::matte(glm::vec3{0.8f});
      material.roughness = roughness;
      test::add(scene, test::floor_quad(50), material);
      scene.lights = {test::light_at({0.3, test::kLightHeight_m, 0.2}, glm::vec3{10.0f}, size)};
      const RenderedFrame frame = test::render(scene, profile, settings, test::penumbra_sample());
      const glm::dvec3 eye{0, test::kEyeHeight_m, 0};
      double worst = 0;
      test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
        const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
        const glm::dvec3 at{test::kEyeHeight_m * d.x / -d.z, 0, -test::kEyeHeight_m * d.y / -d.z};
        const test::SurfacePoint point{at, {0, 1, 0}, glm::normalize(eye - at)};
        const double exact = test::radiance_from_box(material, point, scene.lights[0]).x;
        worst = std::max(worst, std::abs(pixel[0] / exact - 1));
      });
      std::cout << size.x << " x " << size.y << " x " << size.z << ", roughness " << roughness << ": "
                << worst << "\n";
      EXPECT_LE(worst, 0.002);
    }
  }
}

// 36 = 6 x 6 strata: six points, 2 x 3, and none along which a single one stands for all.
TEST(ShadingPointsTest, SpreadAlongAllAxesThatTheirNumberAllows) {
  std::vector<ShadingPoints> points;
  shading_points(std::vector<LightRecord>{lamp_of({1, 0, 1}, 36, 4)}, points);
  const LightRecord& few = points.at(0).light;
  EXPECT_EQ(few.samples, 6);
  EXPECT_EQ(std::max(few.strata[0], few.strata[2]), 3);
  EXPECT_EQ(few.strata[1], 1);
}

// What all samples give, and adaptive ones with nothing in the way.
std::array<RenderedFrame, 2> all_and_adaptive(const Scene& scene) {
  RenderSettings settings = test::planar_settings();
  settings.light_samples = 64;
  const DisplayProfile profile = test::penumbra_view(96, 24);
  std::array<RenderedFrame, 2> frames;
  frames[0] = test::render(scene, profile, settings, test::penumbra_sample());
  settings.adaptive_min_samples = 8;
  frames[1] = test::render(scene, profile, settings, test::penumbra_sample());
  return frames;
}

// A tube of 1.2 m, 3 cm above the floor: eight points of 0.15 m each would miss what is between them and the
// cosine at its ends. All of the view (0.6 m to both sides) is nearer than 4 x 0.15 m.
TEST(SplitLightTest, NearALampEachSampleIsShaded) {
  Scene scene;
  test::add(scene, test::floor_quad(50), test::matte(glm::vec3{0.8f}));
  scene.lights = {test::light_at({0, 0.03, 0}, glm::vec3{0.1f}, {1.2f, 0, 0})};
  const auto frames = all_and_adaptive(scene);
  test::expect_same_bits(frames[0], frames[1]);
}

// Glossy plastic under a tube: its reflection is as narrow and as bright as with all samples, though no
// direction can be drawn towards a tube.
TEST(SplitLightTest, TheReflectionOfATubeStaysAsItIs) {
  Scene scene;
  Material plastic = test::matte(glm::vec3{0.05f});
  plastic.roughness = 0.142f;
  test::add(scene, test::floor_quad(50), plastic);
  scene.lights = {test::light_at({0, test::kLightHeight_m, 0}, glm::vec3{10.0f}, {0, 0, 1.2f})};
  const auto frames = all_and_adaptive(scene);
  double brightest = 0, worst = 0;
  test::for_each_pixel(frames[0].viewports[0], [&](int x, int y, const test::Pixel& all) {
    brightest = std::max(brightest, all[0]);
    worst = std::max(worst, std::abs(all[0] - test::pixel_at(frames[1].viewports[0], x, y)[0]));
  });
  std::cout << "differs by " << worst << " of " << brightest << "\n";
  EXPECT_LE(worst, 0.01 * brightest);
}

}  // namespace
}  // namespace herr
