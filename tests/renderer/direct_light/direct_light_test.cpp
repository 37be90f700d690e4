// Direct light against the formulae in double, shadows against geometry, lights in awkward places.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numeric>

#include "renderer/direct_light/light_records.h"
#include "tests/renderer/direct_light/scalar_light.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kEyeHeight_m = 2.0;

// The floor (y = 0) as pixel (x, y) sees it from `kEyeHeight_m` above, looking straight down.
test::SurfacePoint floor_point(const Viewport& view, int x, int y) {
  const glm::dvec3 d = test::direction_of_pixel(view, x, y);  // head: -Z ahead; down in the world
  const glm::dvec3 world{d.x, d.z, -d.y};
  const double t = kEyeHeight_m / -world.y;
  return {glm::dvec3{0, kEyeHeight_m, 0} + t * world, {0, 1, 0}, -world};
}

Scene floor_scene(const Material& material, const std::vector<AreaLight>& lights) {
  Scene scene;
  test::add(scene, test::floor_quad(10), material);
  scene.lights = lights;
  return scene;
}

RenderedFrame render_floor(const Scene& scene, const DisplayProfile& profile, int light_samples = 1) {
  RenderSettings settings = test::planar_settings();
  settings.light_samples = light_samples;
  return test::render(scene, profile, settings, test::looking_down({0, kEyeHeight_m, 0}));
}

// A pixel's position carries float errors of a few 2^-23 of metres; the smoothest lobe used here
// (alpha = 0.09) changes by at most 4 / alpha per radian, relative: 45 * 1e-6 = 4e-5. Then the
// half that it is stored in.
constexpr double kArithmetic = 1e-4;
double tolerance_of(double value) {
  return value * kArithmetic + test::half_rounding(value) + 0x1p-25;
}

TEST(DirectLightTest, APointLightOverAFloorFollowsTheFormulae) {
  Material dull = test::matte({0.2f, 0.5f, 0.9f});
  Material glossy = test::matte({0.9f, 0.6f, 0.1f});
  glossy.roughness = 0.3f;
  Material metal = glossy;
  metal.metallic = 1;
  metal.roughness = 0.5f;
  Material between = metal;
  between.metallic = 0.4f;
  const AreaLight light = test::light_at({0.5, 1.5, -0.3}, {3, 2, 1});
  const DisplayProfile profile = test::single_view(64, 64, 45, 45);
  for (const Material& material : {dull, glossy, metal, between}) {
    const Scene scene = floor_scene(material, {light});
    const RenderedFrame frame = render_floor(scene, profile);
    test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
      const glm::dvec3 expected = test::radiance_from(material, floor_point(profile.viewports[0], x, y),
                                                      light.centre, glm::dvec3(light.intensity_w_sr), 1e-6);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(pixel[static_cast<std::size_t>(c)], expected[c], tolerance_of(expected[c]))
            << x << ", " << y;
      }
    });
  }
}

TEST(DirectLightTest, StraightBelowALightADullFloorShowsAlbedoOverPi) {
  // albedo / pi * I / d^2 = 0.5 / pi * 4 / 2.25 = 0.28294; the dielectric lobe at roughness 1 adds, at normal
  // incidence and 0 degrees, D V F = (1 / pi) * 0.25 * 0.04 = 1 / (100 pi) per I / d^2: 0.0031831 * 1.7778.
  Scene scene = floor_scene(test::matte(glm::vec3{0.5f}), {test::light_at({0, 1.5, 0}, glm::vec3{4.0f})});
  // Light and eye on one axis; the light cannot be seen. 3 x 3 pixels of a hundredth of a degree.
  const RenderedFrame frame = render_floor(scene, test::single_view(3, 3, 0.01, 0.01));
  const double expected = (0.5 / glm::pi<double>() + 0.01 / glm::pi<double>()) * 4.0 / 2.25;
  EXPECT_NEAR(test::pixel_at(frame.viewports[0], 1, 1)[0], expected, tolerance_of(expected));
}

TEST(DirectLightTest, SeveralLightsAddUp) {
  const AreaLight a = test::light_at({1, 2, 0}, {3, 0, 1}), b = test::light_at({-1, 1, 1}, {0, 5, 1});
  const Material material = test::matte(glm::vec3{0.7f});
  const DisplayProfile profile = test::single_view(16, 16, 40, 40);
  const RenderedFrame both = render_floor(floor_scene(material, {a, b}), profile);
  test::for_each_pixel(both.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const test::SurfacePoint at = floor_point(profile.viewports[0], x, y);
    const glm::dvec3 expected =
        test::radiance_from(material, at, a.centre, glm::dvec3(a.intensity_w_sr), 1e-6) +
        test::radiance_from(material, at, b.centre, glm::dvec3(b.intensity_w_sr), 1e-6);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(pixel[static_cast<std::size_t>(c)], expected[c], tolerance_of(expected[c]));
  });
}

TEST(DirectLightTest, AmbientLightAloneGivesAlbedoPlusReflectanceTimesAmbient) {
  // (diffuse + F0) * ambient = (0.3 + 0.04) * 0.5.
  Scene scene = floor_scene(test::matte(glm::vec3{0.3f}), {});
  scene.ambient = glm::vec3{0.5f};
  const RenderedFrame frame = render_floor(scene, test::single_view(8, 8, 40, 40));
  test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
    ASSERT_NEAR(pixel[0], 0.17, test::half_rounding(0.17) + 1e-6);
    ASSERT_EQ(pixel[3], 1.0);
  });
  EXPECT_EQ(frame.counters.rays[RayKind::shadow], 0);
}

struct Spread {
  double mean = 0, deviation = 0;
};

// Rendered over exact radiance, over all pixels: a box light of 0.8 x 0.3 x 0.5 m half a metre to the side.
Spread ratio_to_exact(int samples) {
  const AreaLight light = test::light_at({0.3, 1.2, 0.2}, glm::vec3{2.0f}, {0.8f, 0.3f, 0.5f});
  const Material material = test::matte(glm::vec3{0.6f});
  const DisplayProfile profile = test::single_view(64, 64, 45, 45);
  const RenderedFrame frame = render_floor(floor_scene(material, {light}), profile, samples);
  std::vector<double> ratios;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const test::SurfacePoint at = floor_point(profile.viewports[0], x, y);
    ratios.push_back(pixel[0] / test::radiance_from_box(material, at, light).x);
  });
  const double n = static_cast<double>(ratios.size());
  Spread spread;
  spread.mean = std::accumulate(ratios.begin(), ratios.end(), 0.0) / n;
  for (const double r : ratios) spread.deviation += (r - spread.mean) * (r - spread.mean);
  spread.deviation = std::sqrt(spread.deviation / n);
  return spread;
}

TEST(DirectLightTest, StratifiedSamplesOfABoxLightAreUnbiased) {
  double previous = 1.0;
  for (const int samples : {16, 64, 256}) {
    const Spread spread = ratio_to_exact(samples);
    std::cout << samples << " samples: mean " << spread.mean << ", deviation " << spread.deviation << "\n";
    // The mean of 4096 independent ratios: four standard errors, plus the reference's own 1e-4.
    EXPECT_NEAR(spread.mean, 1.0, 4 * spread.deviation / 64 + 1e-4) << samples;
    // Four times the strata must at least halve the deviation (that is what unstratified samples do).
    EXPECT_LT(spread.deviation, 0.55 * previous) << samples;
    previous = spread.deviation;
  }
}

TEST(DirectLightTest, OneSampleIsTheCentreOfTheBox) {
  const AreaLight box = test::light_at({0.3, 1.2, 0.2}, glm::vec3{2.0f}, {0.8f, 0.3f, 0.5f});
  AreaLight point = box;
  point.size = glm::vec3{0.0f};
  const DisplayProfile profile = test::single_view(32, 32, 45, 45);
  const Material material = test::matte(glm::vec3{0.6f});
  // Nowhere nearer than 0.4 m, the falloff's floor: both are the same light.
  test::expect_same_bits(render_floor(floor_scene(material, {box}), profile),
                         render_floor(floor_scene(material, {point}), profile));
}

TEST(DirectLightTest, AHardShadowEndsWhereGeometrySays) {
  // A thin lid of side 1 at y = 0.5, a point light at (1, 2, 0). The floor's point behind the lid's point (x,
  // z) is ((4 x - 1) / 3, 4 z / 3): the shadow spans x from -1 to 1/3 and z within 2/3. The eye above the
  // origin sees the lid itself before the floor's x, z within 2/3.
  Scene scene = floor_scene(test::matte(glm::vec3{0.5f}), {test::light_at({1, 2, 0}, glm::vec3{10.0f})});
  test::add(scene, test::box({-0.5f, 0.499f, -0.5f}, {0.5f, 0.5f, 0.5f}), test::matte(glm::vec3{0.5f}));
  const DisplayProfile profile = test::single_view(401, 401, 45, 45);
  const RenderedFrame frame = render_floor(scene, profile);
  int in_shadow = 0, lit = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 p = floor_point(profile.viewports[0], x, y).position;
    constexpr double kHidden = 2.0 / 3 + 0.01;
    if (std::abs(p.x) < kHidden && std::abs(p.z) < kHidden) return;  // the lid itself
    // From the light at (1, 2, 0) through the lid at height 0.5 (0.499 moves edges by
    // 0.001): 4/3 (edge) - 1/3 x.
    constexpr double kEdge = 0.003;
    const double left = (4 * -0.5 - 1) / 3, right = (4 * 0.5 - 1) / 3, depth = 2.0 / 3;
    const bool inside = p.x > left + kEdge && p.x < right - kEdge && std::abs(p.z) < depth - kEdge;
    const bool outside = p.x < left - kEdge || p.x > right + kEdge || std::abs(p.z) > depth + kEdge;
    if (inside) {
      ASSERT_EQ(pixel[0], 0.0) << x << ", " << y << ": " << p.x << ", " << p.z;
    }
    if (outside) {
      ASSERT_GT(pixel[0], 0.0) << x << ", " << y << ": " << p.x << ", " << p.z;
    }
    in_shadow += inside;
    lit += outside;
  });
  EXPECT_GT(in_shadow, 1000);
  EXPECT_GT(lit, 100000);
}

TEST(DirectLightTest, AFloorDoesNotShadowItself) {
  // Grazing light over a large floor far from the anchor's origin: any self-hit would show as black.
  Scene scene = floor_scene(test::matte(glm::vec3{0.5f}), {test::light_at({9, 0.05, 0}, glm::vec3{10.0f})});
  const RenderedFrame frame = render_floor(scene, test::single_view(128, 128, 60, 60));
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    ASSERT_GT(pixel[0], 0.0) << x << ", " << y;
  });
}

TEST(DirectLightTest, ALightThatTouchesOrEnclosesASurfaceStaysFinite) {
  const DisplayProfile profile = test::single_view(32, 32, 45, 45);
  Material smooth = test::matte(glm::vec3{1.0f});
  smooth.roughness = 0;
  for (const int samples : {1, 16, 64}) {
    for (const auto& [centre, size] :
         {std::pair<glm::dvec3, glm::vec3>{{0, 0, 0}, {0, 0, 0}},  // on the floor
          {{0, 0, 0}, {1, 0, 1}},                                  // coplanar
          {{0, 0, 0}, {1, 1, 1}},                                  // cut in halves
          {{0, 0.5, 0}, {1, 1, 1}},                                // touching
          {{0, 1e-6, 0}, {0, 0, 0}},                               // just above
          {{0, -1, 0}, {1, 1, 1}},                                 // below
          {{0, 2, 0}, {20, 20, 20}}}) {                            // all around
      for (const Material& material : {smooth, test::matte(glm::vec3{1.0f})}) {
        SCOPED_TRACE(testing::Message()
                     << samples << " samples, light at y = " << centre.y << " of " << size.x);
        const RenderedFrame frame = render_floor(
            floor_scene(material, {test::light_at(centre, glm::vec3{1.0f}, size)}), profile, samples);
        test::expect_finite(frame);
        EXPECT_EQ(frame.counters.invalid_rays, 0);
      }
    }
  }
}

TEST(DirectLightTest, TheFalloffIsCappedAtHalfTheLongestEdge) {
  // A flat light of 2 x 0 x 2 m, 0.1 m above the floor: its centre is nearer than r =
  // 1 m, so E = I cos / r^2.
  const AreaLight light = test::light_at({0, 0.1, 0}, glm::vec3{1.0f}, {2, 0, 2});
  const Material material = test::matte(glm::vec3{0.5f});
  const RenderedFrame frame =
      render_floor(floor_scene(material, {light}), test::single_view(3, 3, 0.01, 0.01));
  const double expected = (0.5 + 0.01) / glm::pi<double>() * 1.0;
  EXPECT_NEAR(test::pixel_at(frame.viewports[0], 1, 1)[0], expected, tolerance_of(expected));
}

TEST(StrataTest, MultiplyToTheNumberOfSamples) {
  for (const glm::vec3& size :
       {glm::vec3{0, 0, 0}, {1, 1, 1}, {1, 0, 0}, {0, 1, 2}, {0.4f, 0.1f, 0.4f}, {3, 1, 1e-3f}}) {
    for (const int samples : {1, 2, 3, 7, 16, 64, 97, 100, 256, 4096}) {
      const auto strata = strata_for(size, samples);
      EXPECT_EQ(strata[0] * strata[1] * strata[2], samples) << size.x << " " << size.y << " " << size.z;
      // None on an axis of no thickness - unless the light is a point: then the axis does not matter.
      for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] == 0 && size != glm::vec3{0.0f}) {
          EXPECT_EQ(strata[static_cast<std::size_t>(axis)], 1) << samples;
        }
      }
    }
  }
}

TEST(StrataTest, FollowTheShapeOfTheBox) {
  using Strata = std::array<int, 3>;
  EXPECT_EQ(strata_for({1, 1, 1}, 64), (Strata{4, 4, 4}));
  EXPECT_EQ(strata_for({1, 0, 1}, 64), (Strata{8, 1, 8}));
  EXPECT_EQ(strata_for({0, 2, 0}, 16), (Strata{1, 16, 1}));
  EXPECT_EQ(strata_for({4, 1, 1}, 4), (Strata{4, 1, 1}));
  EXPECT_EQ(strata_for({2, 1, 0}, 2), (Strata{2, 1, 1}));
}

TEST(LightRecordsTest, LightsThatDoNotShineAreLeftOut) {
  std::vector<LightRecord> records;
  const std::vector<AreaLight> lights{test::light_at({0, 1, 0}, glm::vec3{0.0f}),
                                      test::light_at({17, 1, 0}, {1, 0, 0}, {2, 0, 4})};
  light_records(lights, {16, 0, 0}, {16, 16}, {10.0, 0.0}, records);
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].centre[0], 1.0f);
  EXPECT_EQ(records[0].lower[2], -2.0f);
  EXPECT_EQ(records[0].min_distance2, 4.0f);
}

TEST(LightRecordsTest, WhatLiesFarAwayDoesNotDimAPointOfLight) {
  // Places near a light 1 m from the anchor, met by rays from 3 m, are rounded by 2^-24 of 2 x 4 m; in a
  // scene of 0.5 m, by no more than 2^-24 of that.
  const std::vector<AreaLight> lights{test::light_at({17, 0, 0}, {1, 1, 1})};
  std::vector<LightRecord> records;
  for (const auto& [beyond_m, nearest_m] : {std::pair{1e9, 8.0}, {100.0, 8.0}, {0.5, 0.5}}) {
    light_records(lights, {16, 0, 0}, {1, 1}, {beyond_m, 3.0}, records);
    EXPECT_FLOAT_EQ(std::sqrt(records[0].min_distance2), static_cast<float>(0x1p-24 * nearest_m)) << beyond_m;
  }
}

TEST(LightRecordsTest, TheFarthestIrradianceIsThatOfTheBoxesFarthestPoint) {
  std::vector<AreaLight> lights{test::light_at({0, 3, 0}, {9, 18, 0}),
                                test::light_at({5, 0, 0}, {4, 0, 8}, {2, 2, 2}),
                                test::light_at({1, 1, 1}, glm::vec3{1000.0f})};
  lights.back().is_virtual = true;  // no light of the room
  const std::vector<Bounds> boxes{{{-1, 0, -1}, {1, 0, 1}}, {{-9, -9, -9}, {-8, -8, -8}}};
  // Both lights are farthest from the corner (-9, -9, -9): 81 + 144 + 81 = 306 and 196 + 81 + 81 = 358.
  const glm::vec3 scale = farthest_irradiance(lights, boxes);
  EXPECT_FLOAT_EQ(scale.x, 9.0f / 306 + 4.0f / 358);
  EXPECT_FLOAT_EQ(scale.y, 18.0f / 306);
  EXPECT_FLOAT_EQ(scale.z, 8.0f / 358);
}

}  // namespace
}  // namespace herr
