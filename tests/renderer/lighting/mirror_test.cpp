// One mirror bounce: where mirrored things appear, how strongly, and when no ray is sent.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/renderer/direct_light/scalar_light.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// A perfect mirror: F0 = 1, so the mirror ray's weight is 1 at every angle.
Material perfect_mirror() {
  Material m;
  m.base_colour = glm::vec3{1.0f};
  m.metallic = 1;
  m.roughness = 0;
  m.mirror = 1;
  return m;
}

TEST(MirrorTest, AMirroredSphereAppearsWhereGeometrySays) {
  // Mirror in the plane z = -2, eye at the origin, a glowing sphere of radius 0.4 at (0.5, 0.2, 1) behind the
  // eye's back. Its image stands at (0.5, 0.2, -5): a disc seen through the plane, a pixel is in it when its
  // direction's distance from the image's centre line is below the radius.
  Scene scene;
  test::add(scene, test::quad({-4, -4, -2}, {8, 0, 0}, {0, 8, 0}), perfect_mirror());
  constexpr float kRadius_m = 0.4f;
  test::add(scene, test::sphere({0.5f, 0.2f, 1}, kRadius_m, 256, 512), test::glowing({2, 1, 0.5f}));
  constexpr int kSide = 801;
  const DisplayProfile profile = test::single_view(kSide, kSide, 15, 15);
  const RenderedFrame frame =
      test::render(scene, profile, test::planar_settings(), test::sample_from({0, 0, 0}));
  const glm::dvec3 image{0.5, 0.2, -5};
  const double pixel_rad = 2 * std::tan(15 / kDegreesPerRadian) / kSide;
  const double radius_rad = std::asin(kRadius_m / glm::length(image));
  // 256 rings and 512 sectors each cut the outline by at most 1 - cos(pi / 512) = 2e-5 of the radius.
  const double facets_rad = radius_rad * 4e-5, slack_rad = 1e-3 * pixel_rad + facets_rad;
  int seen = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    const double off = eccentricity_deg(image, d) / kDegreesPerRadian;
    if (off < radius_rad - slack_rad) {
      ASSERT_EQ(pixel[0], 2.0) << x << ", " << y << " off by " << (off - radius_rad) / pixel_rad;
    }
    if (off > radius_rad + slack_rad) {
      ASSERT_EQ(pixel[0], 0.0) << x << ", " << y << " off by " << (off - radius_rad) / pixel_rad;
    }
    seen += pixel[0] > 0;
  });
  // pi (radius / pixel)^2 = pi (0.0795 / 0.000669)^2, about 44,000.
  EXPECT_GT(seen, 40000);
  EXPECT_EQ(frame.counters.rays[RayKind::mirror], kSide * kSide);
}

TEST(MirrorTest, WithoutAMirrorNoRayIsSent) {
  Scene scene;
  Material metal = perfect_mirror();
  metal.mirror = 0;
  test::add(scene, test::quad({-4, -4, -2}, {8, 0, 0}, {0, 8, 0}), metal);
  scene.ambient = glm::vec3{0.3f};
  Renderer renderer(scene, test::small_profile(), test::small_settings(), false);
  EXPECT_FALSE(renderer.plan().mirror_rays);
  RenderedFrame frame;
  test::render_with(renderer, scene, test::sample_from({0, 0, 0}), frame);
  EXPECT_EQ(frame.counters.rays[RayKind::mirror], 0);
  EXPECT_EQ(frame.counters.rays[RayKind::mirror_shadow], 0);
  EXPECT_EQ(frame.times[Stage::second_hits], 0.0);
}

TEST(MirrorTest, ReflectionsCanBeSwitchedOff) {
  Scene scene;
  test::add(scene, test::quad({-4, -4, -2}, {8, 0, 0}, {0, 8, 0}), perfect_mirror());
  RenderSettings settings = test::small_settings();
  settings.reflections = false;
  EXPECT_EQ(test::render(scene, test::small_profile(), settings, test::sample_from({0, 0, 0}))
                .counters.rays[RayKind::mirror],
            0);
}

// Without its ray a mirror scatters ambient light like the same metal without a mirror's share.
TEST(MirrorTest, WithoutReflectionsAMirrorKeepsItsAmbientLight) {
  const auto wall = [](float mirror) {
    Scene scene;
    Material metal = perfect_mirror();
    metal.mirror = mirror;
    test::add(scene, test::quad({-4, -4, -2}, {8, 0, 0}, {0, 8, 0}), metal);
    scene.ambient = glm::vec3{0.5f};
    RenderSettings settings = test::small_settings();
    settings.reflections = false;
    return test::render(scene, test::small_profile(), settings, test::sample_from({0, 0, 0}));
  };
  test::expect_same_bits(wall(0.9f), wall(0.0f));
}

TEST(MirrorTest, AMirrorRayThatLeavesShowsTheEnvironment) {
  Scene scene;
  test::add(scene, test::quad({-4, -4, -2}, {8, 0, 0}, {0, 8, 0}), perfect_mirror());
  scene.environment = {0.25f, 0.5f, 1.5f};
  const RenderedFrame frame =
      test::render(scene, test::small_profile(), test::small_settings(), test::sample_from({0, 0, 0}));
  test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
    ASSERT_EQ(pixel, (test::Pixel{0.25, 0.5, 1.5, 1.0}));
  });
}

TEST(MirrorTest, TheShareFollowsSchlick) {
  // A dielectric mirror of share 0.5 under an environment of 1, no other light: 0.5
  // (0.04 + 0.96 (1 - cos)^5).
  Scene scene;
  Material glass = test::matte(glm::vec3{0.0f});
  glass.mirror = 0.5f;
  test::add(scene, test::floor_quad(100), glass);
  scene.environment = glm::vec3{1.0f};
  const DisplayProfile profile = test::single_view(64, 64, 80, 80);
  const RenderedFrame frame =
      test::render(scene, profile, test::planar_settings(), test::looking_down({0, 1, 0}));
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const double cosine = -test::direction_of_pixel(profile.viewports[0], x, y).z;
    const double expected = 0.5 * (0.04 + 0.96 * std::pow(1 - cosine, 5));
    ASSERT_NEAR(pixel[0], expected, expected * 1e-5 + test::half_rounding(expected)) << x << ", " << y;
  });
}

TEST(MirrorTest, AMirroredSurfaceIsLitAsIfSeenDirectly) {
  // The mirror at z = -2 shows the wall at z = 1 behind the eye, lit by a point light at z = 0: the wall's
  // radiance towards the mirror plus the mirror's own highlight.
  Scene scene;
  const Material mirror = perfect_mirror(), wall = test::matte(glm::vec3{0.8f});
  test::add(scene, test::quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), mirror);
  test::add(scene, test::quad({9, -9, 1}, {-18, 0, 0}, {0, 18, 0}), wall);
  scene.lights = {test::light_at({0, 3, 0}, glm::vec3{6.0f})};
  const DisplayProfile profile = test::single_view(65, 65, 40, 40);
  // Rays of no width leave the highlight as narrow as the material says; 65 pixels across would widen it.
  RenderSettings settings = test::planar_settings();
  settings.ray_width = 0;
  const RenderedFrame frame = test::render(scene, profile, settings, test::sample_from({0, 0, 0}));
  EXPECT_EQ(frame.counters.rays[RayKind::mirror_shadow], 65 * 65);
  int compared = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    // Within 20 degrees of the light's image the highlight of a lobe of alpha = 1e-3 is too sharp to compare.
    if (eccentricity_deg({0, 3, -4}, d) < 20) return;
    const glm::dvec3 m = d * (2 / -d.z), p = m + glm::dvec3{d.x, d.y, -d.z} * (3 / -d.z);
    const glm::dvec3 light = scene.lights[0].centre, intensity{6.0};
    const double expected =
        test::radiance_from(wall, {p, {0, 0, -1}, {-d.x, -d.y, d.z}}, light, intensity, 1e-6).x +
        test::radiance_from(mirror, {m, {0, 0, 1}, -d}, light, intensity, 1e-6).x;
    // Float rounding of positions (a few 1e-7 of metres) and the offset of the mirror ray's origin (2^-16 of
    // 9 m at most, against 3 m): below 1e-4 of the radiance.
    ASSERT_NEAR(pixel[0], expected, 2e-4 * expected + test::half_rounding(expected)) << x << ", " << y;
    ++compared;
  });
  EXPECT_GT(compared, 1500);
}

TEST(MirrorTest, AMirrorSeesARealSurfaceByItsStatedColour) {
  // A catcher behind the eye, in ambient light 0.5: base colour (0.2, 0.4, 0.8) + 0.04, times 0.5.
  Scene scene;
  test::add(scene, test::quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), perfect_mirror());
  test::add(scene, test::quad({99, -99, 1}, {-198, 0, 0}, {0, 198, 0}), test::matte({0.2f, 0.4f, 0.8f}),
            true);
  scene.ambient = glm::vec3{0.5f};
  const RenderedFrame frame = test::render(scene, test::single_view(16, 16, 40, 40), test::planar_settings(),
                                           test::sample_from({0, 0, 0}));
  test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
    ASSERT_NEAR(pixel[0], 0.12, test::half_rounding(0.12) + 1e-6);
    ASSERT_NEAR(pixel[2], 0.42, test::half_rounding(0.42) + 1e-6);
  });
}

}  // namespace
}  // namespace herr
