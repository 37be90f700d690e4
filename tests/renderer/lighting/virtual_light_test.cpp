// Lamps of the virtual world over a real table: by what factor the camera feed under them brightens, their
// shadows, colours, and what the feed cannot carry.
#include <gtest/gtest.h>

#include <functional>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr double kPi_d = 3.14159265358979, kAmbient = 0.1, kFeed = 0.25, kColour = 0.5;
const DisplayProfile kView = test::single_view(96, 96, 40, 40);

AreaLight virtual_lamp(const glm::dvec3& centre, const glm::vec3& intensity,
                       const glm::vec3& size = {0, 0, 0}) {
  AreaLight lamp = test::light_at(centre, intensity, size);
  lamp.is_virtual = true;
  return lamp;
}

// A real table at y = 0 of colour 0.5 under `lights`.
Scene table(std::vector<AreaLight> lights, double ambient = kAmbient) {
  Scene scene;
  test::add(scene, test::floor_quad(10), test::matte(glm::vec3{static_cast<float>(kColour)}), true);
  scene.lights = std::move(lights);
  scene.ambient = glm::vec3{static_cast<float>(ambient)};
  return scene;
}

RenderSettings direct_settings(int samples = 1) {
  RenderSettings settings = test::planar_settings();
  settings.probes.on = false;
  settings.occlusion_rays = 0;
  settings.light_samples = samples;
  return settings;
}

// An even grey feed of the table, from 2 m above it.
struct Seen {
  RenderedFrame frame;
  FramePlan plan;
};
Seen look_at(const Scene& scene, const RenderSettings& settings) {
  const test::TestCamera camera = test::TestCamera::pinhole(8, 8, 60, [](int, int) {
    const std::uint16_t half = test::to_half(kFeed);
    return std::array<std::uint16_t, 4>{half, half, half, 0x3c00};
  });
  FrameSample sample = test::looking_down({0, 2, 0});
  camera.attach_to(sample);
  Seen seen;
  Renderer renderer(scene, kView, settings, true);
  test::render_with(renderer, scene, sample, seen.frame);
  seen.plan = renderer.plan();
  return seen;
}

// Calls check(pixel, the table's point there) for every pixel.
void for_each_place(const RenderedFrame& frame,
                    const std::function<void(const test::Pixel&, const glm::dvec3&)>& check) {
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(kView.viewports[0], x, y);
    check(pixel, {2 * d.x / -d.z, 0, -2 * d.y / -d.z});
  });
}

// Irradiance of the table at `p`: of a point I h / d^3 (cosine h / d), of a flat box the mean over it.
double irradiance(const AreaLight& lamp, const glm::dvec3& p, std::size_t channel = 0) {
  constexpr int kAlong = 16;
  double sum = 0;
  for (int i = 0; i < kAlong; ++i) {
    for (int j = 0; j < kAlong; ++j) {
      const glm::dvec3 place = lamp.centre + glm::dvec3(lamp.size) * glm::dvec3((i + 0.5) / kAlong - 0.5, 0,
                                                                                (j + 0.5) / kAlong - 0.5);
      const double d = glm::distance(p, place);
      sum += place.y / (d * d * d);
    }
  }
  return lamp.intensity_w_sr[static_cast<int>(channel)] * sum / (kAlong * kAlong);
}

// Show: out = feed (E_real + E_virtual) / E_real, within 1 %; nothing is clamped.
TEST(VirtualLightTest, TheFeedUnderAVirtualLampBrightensByTheLightItAdds) {
  const AreaLight real = test::light_at({1.5, 2, 0.5}, glm::vec3{4.0f});
  for (const glm::vec3& size : {glm::vec3{0}, glm::vec3{0.2f, 0, 0.2f}}) {
    const AreaLight lamp = virtual_lamp({-0.5, 1.4, 0.2}, glm::vec3{1.5f}, size);
    for (const int samples : {1, 64}) {
      SCOPED_TRACE(testing::Message() << samples << " samples, lamp of " << size.x << " m");
      const Seen seen = look_at(table({real, lamp}), direct_settings(samples));
      double worst = 0, brightest = 1;
      for_each_place(seen.frame, [&](const test::Pixel& pixel, const glm::dvec3& p) {
        const double without = irradiance(real, p) + kPi_d * kAmbient;
        const double ratio = (without + irradiance(lamp, p)) / without;
        worst = std::max(worst, std::abs(pixel[0] / kFeed / ratio - 1));
        brightest = std::max(brightest, ratio);
        EXPECT_EQ(pixel[0], pixel[1]);
        EXPECT_EQ(pixel[3], 1.0);
      });
      EXPECT_LT(worst, 0.01);
      EXPECT_GT(brightest, 1.5);
      EXPECT_EQ(seen.frame.counters.light_beyond_feed, 0);
      RecordProperty("worst", std::to_string(worst));
    }
  }
}

TEST(VirtualLightTest, TheSameLampAsAPartOfTheRoomLeavesTheFeedBitForBit) {
  AreaLight lamp = virtual_lamp({-0.5, 1.4, 0.2}, glm::vec3{1.5f});
  lamp.is_virtual = false;
  const Scene scene = table({test::light_at({1.5, 2, 0.5}, glm::vec3{4.0f}), lamp});
  for_each_place(look_at(scene, direct_settings()).frame, [&](const test::Pixel& pixel, const glm::dvec3&) {
    ASSERT_EQ(pixel, (test::Pixel{kFeed, kFeed, kFeed, 1.0}));
  });
}

// A virtual plate of side 0.4 at y = 0.7 under a virtual lamp at (0.8, 1.4, 0): its shadow is twice as wide
// and lies about x = -0.8. The real lamp is where the eye is: its shadow hides behind the plate, which covers
// 0.2 * 2 / 1.3 = 0.31 m of the table to each side.
Scene shadowing(const glm::vec3& lamp_size) {
  Scene scene = table(
      {test::light_at({0, 2, 0}, glm::vec3{4.0f}), virtual_lamp({0.8, 1.4, 0}, glm::vec3{1.5f}, lamp_size)});
  test::add(scene, test::box({-0.2f, 0.695f, -0.2f}, {0.2f, 0.705f, 0.2f}), test::matte(glm::vec3{0.5f}));
  return scene;
}

TEST(VirtualLightTest, TheShadowOfAVirtualLampIsTheUnlitFeedAndNothingIsDarker) {
  for (const int first_samples : {0, 8}) {
    for (const int samples : {1, 64}) {
      SCOPED_TRACE(testing::Message() << samples << " samples, " << first_samples << " first");
      RenderSettings settings = direct_settings(samples);
      settings.adaptive_min_samples = first_samples;
      // Hits take the rays of those beside them, 15 mm away.
      const double umbra = first_samples == 0 ? 0.33 : 0.315;
      const Scene scene = shadowing(samples == 1 ? glm::vec3{0} : glm::vec3{0.1f, 0, 0.1f});
      int in_shadow = 0, lit = 0;
      for_each_place(look_at(scene, settings).frame, [&](const test::Pixel& pixel, const glm::dvec3& p) {
        if (std::abs(p.x) < 0.34 && std::abs(p.z) < 0.34) return;  // the plate
        ASSERT_GE(pixel[0], kFeed);
        // The lamp's extent of 0.1 blurs the shadow's edge by 0.05 to either side.
        if (std::abs(p.x + 0.8) < umbra && std::abs(p.z) < umbra) {
          ++in_shadow;
          ASSERT_EQ(pixel[0], kFeed) << p.x << ", " << p.z;
        } else if (std::abs(p.x + 0.8) > 0.47 || std::abs(p.z) > 0.47) {
          ++lit;
          ASSERT_GT(pixel[0], 1.02 * kFeed) << p.x << ", " << p.z;
        }
      });
      EXPECT_GT(in_shadow, 200);
      EXPECT_GT(lit, 5000);
    }
  }
}

TEST(VirtualLightTest, ARealObjectShadowsAVirtualLampToo) {
  Scene scene = shadowing(glm::vec3{0});
  scene.instances.back().catcher = true;
  const Seen seen = look_at(scene, direct_settings());
  for_each_place(seen.frame, [&](const test::Pixel& pixel, const glm::dvec3& p) {
    if (std::abs(p.x + 0.8) < 0.36 && std::abs(p.z) < 0.36 && p.x < -0.5) {
      ASSERT_EQ(pixel[0], kFeed);
    }
    if (p.x > 0.5) {
      ASSERT_GT(pixel[0], 1.02 * kFeed);
    }
  });
}

TEST(VirtualLightTest, AGreenVirtualLampGreensTheFeedAndCastsNoRedShadow) {
  Scene scene = shadowing(glm::vec3{0});
  scene.lights[1].intensity_w_sr = {0, 1.5f, 0};
  const Seen seen = look_at(scene, direct_settings());
  EXPECT_TRUE(seen.plan.coloured_ratio);
  for_each_place(seen.frame, [&](const test::Pixel& pixel, const glm::dvec3& p) {
    if (std::abs(p.x) < 0.34 && std::abs(p.z) < 0.34) return;  // the plate
    ASSERT_EQ(pixel[0], kFeed);
    ASSERT_EQ(pixel[2], kFeed);
    if (std::abs(p.x + 0.8) < 0.36 && std::abs(p.z) < 0.36) {
      ASSERT_EQ(pixel[1], kFeed);
    }
    if (p.x > 0.5) {
      ASSERT_GT(pixel[1], 1.02 * kFeed);
    }
  });
}

TEST(VirtualLightTest, AGreyVirtualLampOverAColouredRoomBrightensEachChannelByItsOwnShare) {
  const AreaLight real = test::light_at({1.5, 2, 0.5}, {4, 2, 1});
  const AreaLight lamp = virtual_lamp({-0.5, 1.4, 0.2}, glm::vec3{0.5f});
  const Seen seen = look_at(table({real, lamp}), direct_settings());
  EXPECT_TRUE(seen.plan.coloured_ratio);
  for_each_place(seen.frame, [&](const test::Pixel& pixel, const glm::dvec3& p) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double without = irradiance(real, p, c) + kPi_d * kAmbient;
      const double expected = kFeed * (without + irradiance(lamp, p, c)) / without;
      ASSERT_NEAR(pixel[c], expected, 0.01 * expected);
    }
  });
}

// No light of the room is known: the feed gives no scale, and what the lamp adds comes by the table's colour,
// feed + colour / pi E_virtual.
TEST(VirtualLightTest, InARoomWithoutLightTheTableShowsTheLampByItsStatedColour) {
  const AreaLight lamp = virtual_lamp({-0.5, 1.4, 0.2}, {1.5f, 0.75f, 0});
  const Seen seen = look_at(table({lamp}, 0), direct_settings());
  for_each_place(seen.frame, [&](const test::Pixel& pixel, const glm::dvec3& p) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = kFeed + kColour / kPi_d * irradiance(lamp, p, c);
      ASSERT_NEAR(pixel[c], expected, 0.01 * expected);
    }
  });
  EXPECT_EQ(seen.frame.counters.light_beyond_feed, 96 * 96);
}

// Where the lamp is more than the ratio's limit of 4 carries, the feed is multiplied by 4 and the rest of the
// light is added: no step where one passes into the other.
TEST(VirtualLightTest, BeyondFourTimesTheFeedTheRestIsAdded) {
  const AreaLight lamp = virtual_lamp({-0.5, 0.5, 0.2}, glm::vec3{1.5f});
  const Seen seen = look_at(table({lamp}), direct_settings());
  int below = 0, beyond = 0;
  for_each_place(seen.frame, [&](const test::Pixel& pixel, const glm::dvec3& p) {
    const double without = kPi_d * kAmbient, with = without + irradiance(lamp, p);
    const double carried = std::min(with, 4 * without);
    const double expected = kFeed * carried / without + kColour / kPi_d * (with - carried);
    ASSERT_NEAR(pixel[0], expected, 0.01 * expected) << p.x << ", " << p.z;
    (with > 4 * without ? beyond : below) += 1;
  });
  EXPECT_GT(below, 1000);
  EXPECT_GT(beyond, 300);
  EXPECT_NEAR(static_cast<double>(seen.frame.counters.light_beyond_feed), beyond, 0.01 * beyond);
}

// Without a feed there is nothing to multiply: E_virtual comes by the table's colour, transparent as before.
TEST(VirtualLightTest, AnOverlayWithoutAFeedCarriesTheAddedLightItself) {
  const AreaLight real = test::light_at({1.5, 2, 0.5}, glm::vec3{4.0f});
  const AreaLight lamp = virtual_lamp({-0.5, 1.4, 0.2}, glm::vec3{1.5f});
  RenderSettings settings = direct_settings();
  settings.camera = false;
  const Seen seen = look_at(table({real, lamp}), settings);
  for_each_place(seen.frame, [&](const test::Pixel& pixel, const glm::dvec3& p) {
    const double expected = kColour / kPi_d * irradiance(lamp, p);
    ASSERT_NEAR(pixel[0], expected, 0.01 * expected);
    ASSERT_EQ(pixel[3], 0.0);
  });
}

TEST(VirtualLightTest, VirtualThingsAreLitAsByAnyLamp) {
  Scene scene = shadowing({0.1f, 0, 0.1f});
  scene.instances.front().catcher = false;
  Scene real = scene;
  real.lights[1].is_virtual = false;
  test::expect_same_bits(look_at(real, direct_settings(16)).frame, look_at(scene, direct_settings(16)).frame);
}

TEST(VirtualLightTest, OnlyRealLampsAskWhatCatchersAloneBlock) {
  Scene scene = shadowing(glm::vec3{0});
  test::add(scene, test::box({-0.6f, 0.01f, -0.6f}, {-0.5f, 0.2f, 0.6f}), test::matte(glm::vec3{0.5f}), true);
  const auto rays = [&](RayKind kind) { return look_at(scene, direct_settings()).frame.counters.rays[kind]; };
  const std::int64_t of_both = rays(RayKind::catcher_shadow), shadows = rays(RayKind::shadow);
  scene.lights[0].is_virtual = true;
  EXPECT_EQ(rays(RayKind::catcher_shadow), 0);
  EXPECT_EQ(rays(RayKind::shadow), shadows);
  scene.lights[0].is_virtual = scene.lights[1].is_virtual = false;
  EXPECT_GT(rays(RayKind::catcher_shadow), of_both);
}

TEST(VirtualLightTest, ThePlanSaysHowManyLightsAreVirtual) {
  const auto entry = [](const Scene& scene) {
    for (const PlanEntry& one : plan_frame(scene, direct_settings(), true).entries) {
      if (one.name == "virtual lights on the feed") return one;
    }
    return PlanEntry{};
  };
  Scene scene = shadowing(glm::vec3{0});
  EXPECT_TRUE(entry(scene).runs);
  EXPECT_EQ(entry(scene).reason, "1 of 2 lights is virtual");
  scene.instances.front().catcher = false;
  EXPECT_FALSE(entry(scene).runs);
  scene = table({test::light_at({0, 2, 0}, glm::vec3{4.0f})});
  EXPECT_FALSE(entry(scene).runs);
  EXPECT_EQ(entry(scene).reason, "no light is virtual");
}

}  // namespace
}  // namespace herr
