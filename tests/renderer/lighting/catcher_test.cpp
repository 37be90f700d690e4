// Catchers: real surfaces that are not seen, and what virtual objects do to the camera feed on them.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

using Texel = std::array<std::uint16_t, 4>;

const Material kReal = test::matte(glm::vec3{0.5f});

// Eye at 2 m above a catcher floor, looking down at it, with a camera in the same place.
FrameSample above_floor(const test::TestCamera& camera) {
  FrameSample sample = test::looking_down({0, 2, 0});
  camera.attach_to(sample);
  return sample;
}

// A feed with detail: no two neighbouring pixels alike, nothing dark.
test::TestCamera detailed_feed() {
  return test::TestCamera::pinhole(64, 64, 50, [](int x, int y) {
    return Texel{test::to_half(0.25 + 0.01 * x), test::to_half(0.25 + 0.01 * y),
                 test::to_half(0.25 + 0.1 * ((x * 7 + y * 3) % 5)), 0x3c00};
  });
}
test::TestCamera even_feed(double r, double g, double b) {
  return test::TestCamera::pinhole(8, 8, 60, [=](int, int) {
    return Texel{test::to_half(r), test::to_half(g), test::to_half(b), 0x3c00};
  });
}

Scene catcher_floor(const std::vector<AreaLight>& lights) {
  Scene scene;
  test::add(scene, test::floor_quad(10), kReal, true);
  scene.lights = lights;
  scene.ambient = glm::vec3{0.1f};
  return scene;
}

TEST(CatcherTest, WhereNothingChangesTheFeedStaysBitForBit) {
  const test::TestCamera camera = detailed_feed();
  const FrameSample sample = above_floor(camera);
  const Scene nothing;  // no instance at all: the feed alone, re-projected
  for (const int samples : {1, 16}) {
    for (const Isa isa : test::offered_isas()) {
      for (const Foveation foveation : {Foveation::log_polar, Foveation::off}) {
        SCOPED_TRACE(testing::Message() << samples << " samples, " << name_of(isa));
        RenderSettings settings = test::small_settings();
        settings.light_samples = samples;
        settings.isa = isa;
        settings.foveation = foveation;
        const Scene floor = catcher_floor({test::light_at({0.3, 1.5, 0.2}, {7, 6, 5}, {0.4f, 0.1f, 0.4f})});
        const RenderedFrame with_floor = test::render(floor, test::small_profile(), settings, sample);
        test::expect_same_bits(test::render(nothing, test::small_profile(), settings, sample), with_floor);
        EXPECT_GT(with_floor.counters.rays[RayKind::shadow], 0);
      }
    }
  }
}

// A lid of side 1 at height 1 between the eye (x = 0) and a point light at (2, 2, 0).
Scene shadowed_floor(std::vector<AreaLight> lights) {
  Scene scene = catcher_floor(std::move(lights));
  test::add(scene, test::box({-0.5f, 0.99f, -0.5f}, {0.5f, 1.0f, 0.5f}), kReal);
  return scene;
}

// The floor's point under pixel (x, y).
glm::dvec3 floor_point(const Viewport& view, int x, int y) {
  const glm::dvec3 d = test::direction_of_pixel(view, x, y);
  return {2 * d.x / -d.z, 0, -2 * d.y / -d.z};
}

TEST(CatcherTest, InHardShadowTheFeedKeepsTheShareOfAmbientLight) {
  // The light at (2, 2, 0) casts the lid, x in +-0.5 at height 1, onto x in 2 * +-0.5 - 2 = -3 ... -1, z in
  // +-1. The eye sees the lid before the floor's x, z within +-1.
  const AreaLight light = test::light_at({2, 2, 0}, glm::vec3{4.0f});
  const Scene scene = shadowed_floor({light});
  const test::TestCamera camera = even_feed(0.75, 0.5, 0.25);
  const DisplayProfile profile = test::single_view(128, 128, 60, 60);
  const RenderedFrame frame = test::render(scene, profile, test::planar_settings(), above_floor(camera));
  int in_shadow = 0, lit = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 p = floor_point(profile.viewports[0], x, y);
    const bool hidden = std::abs(p.x) < 1.03 && std::abs(p.z) < 1.03;
    const bool shadow = p.x > -2.96 && p.x < -1.04 && std::abs(p.z) < 0.96;
    const bool outside = p.x < -3.04 || p.x > -0.96 || std::abs(p.z) > 1.04;
    // E = I cos / d^2 = I h / d^3, cosine = h / d at the floor.
    const double d = glm::distance(p, light.centre), irradiance = 4.0 * light.centre.y / (d * d * d);
    const double ambient = glm::pi<double>() * 0.1;
    if (!hidden && shadow) {
      ++in_shadow;
      const double ratio = ambient / (ambient + irradiance);
      // The ratio is stored as a half and so is the product.
      for (std::size_t c = 0; c < 3; ++c) {
        const double expected = (c == 0 ? 0.75 : c == 1 ? 0.5 : 0.25) * ratio;
        ASSERT_NEAR(pixel[c], expected, expected * 1e-5 + 2 * test::half_rounding(expected))
            << x << ", " << y;
      }
    } else if (!hidden && outside) {
      ++lit;
      ASSERT_EQ(pixel[0], 0.75) << x << ", " << y;
      ASSERT_EQ(pixel[1], 0.5);
    }
    ASSERT_EQ(pixel[3], 1.0);
  });
  EXPECT_GT(in_shadow, 300);
  EXPECT_GT(lit, 5000);
}

// A bulb that touches a ceiling lights that point without bound; the shadows on the floor must stay.
TEST(CatcherTest, ALightThatTouchesACatcherLeavesTheOtherShadowsAlone) {
  const AreaLight light = test::light_at({2, 2, 0}, glm::vec3{4.0f});
  const Scene open = shadowed_floor({light});
  Scene roofed = open;
  // Behind the eye and above the light: it blocks no light and is not in view.
  test::add(roofed, test::box({-9, 2, -9}, {9, 2.5f, 9}), kReal, true);
  const test::TestCamera camera = even_feed(0.75, 0.5, 0.25);
  FrameSample sample = test::looking_down({0, 1.99, 0});
  camera.attach_to(sample);
  const DisplayProfile profile = test::single_view(64, 64, 60, 60);
  test::expect_same_bits(test::render(open, profile, test::planar_settings(), sample),
                         test::render(roofed, profile, test::planar_settings(), sample));
}

TEST(CatcherTest, ColouredLightsLeaveColouredShadows) {
  // Red and blue lights of equal strength from both sides, ambient grey. In the red light's shadow only red
  // is missing: the feed keeps its blue bit for bit, and its green, which neither light has.
  const AreaLight red = test::light_at({2, 2, 0}, {4, 0, 0}), blue = test::light_at({-2, 2, 0}, {0, 0, 4});
  const Scene scene = shadowed_floor({red, blue});
  const test::TestCamera camera = even_feed(0.5, 0.5, 0.5);
  const DisplayProfile profile = test::single_view(128, 128, 60, 60);
  RenderSettings settings = test::planar_settings();
  const FrameSample sample = above_floor(camera);
  Renderer renderer(scene, profile, settings, true);
  EXPECT_TRUE(renderer.plan().coloured_ratio);
  RenderedFrame frame;
  test::render_with(renderer, scene, sample, frame);
  int in_red_shadow = 0, in_blue_shadow = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 p = floor_point(profile.viewports[0], x, y);
    const bool away = std::abs(p.z) < 0.96 && std::abs(p.x) > 1.04 && std::abs(p.x) < 2.96;
    if (!away) return;
    const glm::dvec3 light = p.x < 0 ? red.centre : blue.centre;
    const double d = glm::distance(p, light), ambient = glm::pi<double>() * 0.1;
    const double kept = 0.5 * ambient / (ambient + 4.0 * 2.0 / (d * d * d));
    const std::size_t dark = p.x < 0 ? 0 : 2;
    ASSERT_NEAR(pixel[dark], kept, kept * 1e-5 + 2 * test::half_rounding(kept)) << x << ", " << y;
    ASSERT_EQ(pixel[2 - dark], 0.5);
    ASSERT_EQ(pixel[1], 0.5);
    (p.x < 0 ? in_red_shadow : in_blue_shadow) += 1;
  });
  EXPECT_GT(in_red_shadow, 300);
  EXPECT_GT(in_blue_shadow, 300);
}

TEST(CatcherTest, AShadowThatARealSurfaceCastsOnAnotherIsAlreadyInTheFeed) {
  // The lid of the test above, real this time: nothing virtual is there, nothing changes.
  Scene scene = catcher_floor({test::light_at({2, 2, 0}, glm::vec3{4.0f})});
  test::add(scene, test::box({-0.5f, 0.99f, -0.5f}, {0.5f, 1.0f, 0.5f}), kReal, true);
  const test::TestCamera camera = detailed_feed();
  const FrameSample sample = above_floor(camera);
  const DisplayProfile profile = test::single_view(128, 128, 60, 60);
  const RenderedFrame frame = test::render(scene, profile, test::planar_settings(), sample);
  test::expect_same_bits(test::render(Scene{}, profile, test::planar_settings(), sample), frame);
  EXPECT_GT(frame.counters.rays[RayKind::catcher_shadow], 0);
}

TEST(CatcherTest, AVirtualShadowInARealOneChangesNothing) {
  // Above the real lid hangs a virtual one that shadows only what the real one shadows already.
  Scene scene = catcher_floor({test::light_at({2, 2, 0}, glm::vec3{4.0f})});
  test::add(scene, test::box({-0.5f, 0.89f, -0.5f}, {0.5f, 0.9f, 0.5f}), kReal, true);
  // On the way from the light to the real lid's middle, a quarter of the way up; far from the
  // eye's view of the floor.
  test::add(scene, test::box({0.45f, 1.15f, -0.05f}, {0.55f, 1.2f, 0.05f}), kReal);
  const test::TestCamera camera = even_feed(0.5, 0.5, 0.5);
  const DisplayProfile profile = test::single_view(128, 128, 60, 60);
  const RenderedFrame frame = test::render(scene, profile, test::planar_settings(), above_floor(camera));
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 p = floor_point(profile.viewports[0], x, y);
    if (p.x < -1.2) {
      ASSERT_EQ(pixel[0], 0.5) << "floor at " << p.x << ", " << p.z << " (" << x << ", " << y << ")";
    }
  });
}

TEST(CatcherTest, WithoutAFeedTheOverlayIsTransparentOverCatchers) {
  const Scene scene = shadowed_floor({test::light_at({2, 2, 0}, glm::vec3{4.0f})});
  FrameSample sample = test::looking_down({0, 2, 0});
  RenderSettings settings = test::planar_settings();
  settings.camera = false;
  const DisplayProfile profile = test::single_view(64, 64, 60, 60);
  Renderer renderer(scene, profile, settings, true);
  RenderedFrame frame;
  test::render_with(renderer, scene, sample, frame);
  int covered = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 p = floor_point(profile.viewports[0], x, y);
    // The eye is at height 2, the lid's top at 1: it covers +-1 of the floor. Shadows darken: coverage 1 - r.
    const bool lid = std::abs(p.x) < 0.96 && std::abs(p.z) < 0.96;
    if (lid) {
      ASSERT_EQ(pixel[3], 1.0);
    }
    if (p.x > 1.1) {
      ASSERT_EQ(pixel[3], 0.0);
    }
    if (p.x < -1.1 && p.x > -2.9 && std::abs(p.z) < 0.9) {
      ASSERT_GT(pixel[3], 0.0);
      ASSERT_LT(pixel[3], 1.0);
      ASSERT_EQ(pixel[0], 0.0);
    }
    covered += lid;
  });
  EXPECT_GT(covered, 100);
}

TEST(CatcherTest, WithoutACameraInTheSessionTheBackgroundIsTheEnvironment) {
  Scene scene = catcher_floor({});
  scene.environment = {0.25f, 0.5f, 0.75f};
  const RenderedFrame frame =
      test::render(scene, test::small_profile(), test::small_settings(), test::sample_from({0, 2, 0}));
  test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
    ASSERT_EQ(pixel, (test::Pixel{0.25, 0.5, 0.75, 1.0}));
  });
}

TEST(CatcherTest, InTheDarkTheFeedIsLeftAlone) {
  // No ambient light, and a lamp below the floor: E_without is 0, a ratio would be 0 / 0.
  Scene scene = shadowed_floor({test::light_at({0, -1, 0}, glm::vec3{4.0f})});
  scene.ambient = glm::vec3{0.0f};
  const test::TestCamera camera = even_feed(0.5, 0.5, 0.5);
  const DisplayProfile profile = test::single_view(32, 32, 60, 60);
  const RenderedFrame frame = test::render(scene, profile, test::planar_settings(), above_floor(camera));
  test::expect_finite(frame);
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 p = floor_point(profile.viewports[0], x, y);
    if (std::abs(p.x) > 1.1 || std::abs(p.z) > 1.1) {
      ASSERT_EQ(pixel[0], 0.5);
    }
  });
}

TEST(CatcherTest, AMirrorCatcherAddsVirtualHitsOnly) {
  // A polished real floor (a perfect mirror), a real ceiling at 4 m and a glowing virtual ball of
  // radius 0.3 at (1, 1, 0), off to the side of the eye. The feed shows the ceiling's reflection
  // already: only where the ball is mirrored does its radiance of 2 come on top of the feed; r is 1
  // everywhere, since no light shines.
  Material polished = kReal;
  polished.base_colour = glm::vec3{1.0f};
  polished.metallic = 1;
  polished.roughness = 0;
  polished.mirror = 1;
  Scene scene;
  test::add(scene, test::floor_quad(10), polished, true);
  test::add(scene, test::quad({-10, 4, -10}, {20, 0, 0}, {0, 0, 20}), test::glowing(glm::vec3{5.0f}), true);
  constexpr float kRadius_m = 0.3f;
  const glm::dvec3 ball{1, 1, 0};
  test::add(scene, test::sphere(glm::vec3(ball), kRadius_m, 128, 256), test::glowing({2, 1, 0.5f}));
  scene.environment = glm::vec3{7.0f};

  const test::TestCamera camera = detailed_feed();
  const FrameSample sample = above_floor(camera);
  const DisplayProfile profile = test::single_view(256, 256, 40, 40);
  const RenderedFrame frame = test::render(scene, profile, test::planar_settings(), sample);
  const RenderedFrame feed = test::render(Scene(), profile, test::planar_settings(), sample);
  const glm::dvec3 eye{0, 2, 0}, mirrored_ball{1, -1, 0};
  int mirrored = 0, untouched = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    const glm::dvec3 world{d.x, d.z, -d.y};
    const auto off = [&](const glm::dvec3& centre) {
      return std::sin(eccentricity_deg(centre - eye, world) / kDegreesPerRadian) * glm::length(centre - eye);
    };
    const double direct = off(ball) - kRadius_m, image = off(mirrored_ball) - kRadius_m;
    if (direct < 1e-3) return;  // the ball itself
    const test::Pixel& before = test::pixel_at(feed.viewports[0], x, y);
    if (image > 1e-3) {
      ++untouched;
      ASSERT_EQ(pixel, before) << x << ", " << y;
    } else if (image < -1e-3) {
      ++mirrored;
      for (std::size_t c = 0; c < 3; ++c) {
        const double expected = before[c] + 2.0 / (1 << c);
        ASSERT_NEAR(pixel[c], expected, test::half_rounding(expected) * 2) << x << ", " << y;
      }
    }
  });
  EXPECT_GT(mirrored, 300);
  EXPECT_GT(untouched, 10000);
}

}  // namespace
}  // namespace herr
