// --see-through-colour in the headset's own viewports: the feed's place in one colour, darkened by shadows.
#include <gtest/gtest.h>

#include "tests/renderer/busy_scene.h"
#include "tests/renderer/rendered_frames.h"

namespace herr {
namespace {

constexpr ShownColour kOrange{0xff, 0x80, 0x00};

// Eye 1 m above a floor that stands for a real one, a plate over part of it; the light straight above all.
Scene plate_over_floor() {
  Scene scene;
  test::add(scene, test::floor_quad(20, -1), test::matte(glm::vec3{0.5f}), true);
  test::add(scene, test::box({-0.2f, 1.9f, -0.2f}, {0.2f, 2.0f, 0.2f}), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({0, 4, 0}, glm::vec3{10})};
  scene.ambient = glm::vec3{0.2f};
  scene.environment = {0.1f, 0.2f, 0.4f};
  return scene;
}

RenderSettings painted(Foveation foveation) {
  RenderSettings settings = test::small_settings();
  settings.foveation = foveation;
  settings.see_through_colour = kOrange;
  return settings;
}

TEST(SeeThroughTest, TheFeedsPlaceHasTheColourTimesTheCatchersRatio) {
  const Scene scene = plate_over_floor();
  const glm::vec3 colour = radiance_of(kOrange, 1);
  // Straight below the plate no light arrives: r = pi 0.2 / (pi 0.2 + 10 / 5^2). At the border of 45 degrees
  // the floor is lit; the plate's shadow ends 0.2 * 5 / 2 = 0.5 m from the middle, at 27 degrees.
  const double ambient = glm::pi<double>() * 0.2, direct = 10.0 / 25;
  for (const Foveation foveation : {Foveation::log_polar, Foveation::off}) {
    for (const bool camera : {false, true}) {
      SCOPED_TRACE(testing::Message() << (camera ? "camera" : "no camera"));
      FrameSample sample = test::looking_down({0, 0, 0});
      const test::TestCamera feed = test::gradient_camera();
      if (camera) feed.attach_to(sample);
      const RenderedFrame frame = test::render(scene, test::small_profile(), painted(foveation), sample);
      const test::Pixel middle = test::pixel_at(frame.viewports[0], 32, 32),
                        corner = test::pixel_at(frame.viewports[0], 1, 1);
      for (std::size_t c = 0; c < 3; ++c) {
        const double of_colour = double{colour[static_cast<int>(c)]};
        EXPECT_NEAR(middle[c], of_colour * ambient / (ambient + direct), 0.005);
        EXPECT_NEAR(corner[c], of_colour, 2 * test::half_rounding(1));
      }
      EXPECT_EQ(middle[3], 1.0) << "opaque";
    }
  }
}

TEST(SeeThroughTest, MissesArePaintedAsWell) {
  const RenderedFrame frame = test::render(plate_over_floor(), test::small_profile(),
                                           painted(Foveation::log_polar), test::sample_from({0, 5, 0}));
  const test::Pixel sky = test::pixel_at(frame.viewports[0], 32, 2);
  EXPECT_NEAR(sky[0], 1, 2 * test::half_rounding(1));
  EXPECT_EQ(sky[2], 0);
}

TEST(SeeThroughTest, ItIsShownAsItIsUnderAnyExposure) {
  RenderSettings settings = painted(Foveation::log_polar);
  settings.exposure_ev = 2;
  const RenderedFrame frame =
      test::render(plate_over_floor(), test::small_profile(), settings, test::sample_from({0, 5, 0}));
  // Two stops brighter when shown: white is a radiance of 1/4.
  EXPECT_NEAR(test::pixel_at(frame.viewports[0], 32, 2)[0], 0.25, test::half_rounding(0.25));
}

TEST(SeeThroughTest, ThePlanSaysWhatBecameOfTheFeed) {
  const Scene scene = plate_over_floor();
  RenderSettings settings = test::small_settings();
  EXPECT_TRUE(plan_frame(scene, settings, true).camera);
  settings.see_through_colour = kOrange;
  EXPECT_FALSE(plan_frame(scene, settings, true).camera);
}

}  // namespace
}  // namespace herr
