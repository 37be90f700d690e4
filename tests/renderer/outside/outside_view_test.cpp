// The picture of a camera outside: where things stand in it, what is painted for the real world, and that the
// headset's own pictures know nothing of it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/busy_scene.h"
#include "tests/renderer/outside/outside_frames.h"
#include "tests/renderer/rendered_frames.h"

namespace herr {
namespace {

double brightness(const test::Pixel& pixel) {
  return pixel[0] + pixel[1] + pixel[2];
}

// A glowing ball of 5 cm before black.
Scene ball_at(const glm::vec3& place) {
  Scene scene;
  test::add(scene, test::sphere(place, 0.05f), test::glowing(glm::vec3{1.0f}));
  return scene;
}

struct Middle {
  double x = 0, y = 0;
};
Middle middle_of_light(const ViewportImage& picture) {
  Middle sum;
  double weight = 0;
  test::for_each_pixel(picture, [&](int x, int y, const test::Pixel& pixel) {
    sum.x += brightness(pixel) * (x + 0.5);
    sum.y += brightness(pixel) * (y + 0.5);
    weight += brightness(pixel);
  });
  return {sum.x / weight, sum.y / weight};
}

TEST(OutsideViewTest, APointStandsWhereThePinholePutsIt) {
  // 2 m ahead of the camera, 1 m to the right, 0.5 m up: tangents 0.5 of 2 and 0.25 of 1, so 3/4 of 400 px
  // from the left and 3/8 of 200 px from above. The head is somewhere else. A ball 0.05 / 2 m wide covers 5
  // px in diameter: its middle of mass is known to a fraction of a pixel; perspective draws it out by less
  // than that.
  const OutsideView view = test::outside_from({3, 1, 7}, 200);
  const ViewportImage picture =
      test::outside_picture(ball_at({4, 1.5f, 5}), test::settings_with(view), test::sample_from({0, 9, 0}));
  ASSERT_EQ(picture.width_px, 400);
  const Middle middle = middle_of_light(picture);
  EXPECT_NEAR(middle.x, 250, 0.25);
  EXPECT_NEAR(middle.y, 75, 0.25);
  EXPECT_EQ(test::pixel_at(picture, 0, 0)[3], 1.0) << "opaque";
}

TEST(OutsideViewTest, ItStandsInTheSceneOrWhereTheSessionDoes) {
  Scene scene = ball_at({4, 1.5f, 5});
  // The session's origin stands at x = 10, turned by half a turn: what lies 1 m to the right and 2 m ahead of
  // its camera at (-3, 1, 3) lies, in the scene, at 10 - (-3 + 1), 1 + 0.5, -(3 - 2) = (12, 1.5, -1).
  scene.world_from_session.position = {10, 0, 0};
  scene.world_from_session.orientation = glm::angleAxis(glm::pi<double>(), glm::dvec3{0, 1, 0});
  test::add(scene, test::sphere({12, 1.5f, -1}, 0.05f), test::glowing(glm::vec3{1.0f}));
  for (const OutsideSpace space : {OutsideSpace::scene, OutsideSpace::session}) {
    OutsideView view =
        test::outside_from(space == OutsideSpace::scene ? glm::dvec3{3, 1, 7} : glm::dvec3{-3, 1, 3}, 100);
    view.space = space;
    const Middle middle = middle_of_light(
        test::outside_picture(scene, test::settings_with(view), test::sample_from({0, 9, 0})));
    EXPECT_NEAR(middle.x, 125, 0.3);
    EXPECT_NEAR(middle.y, 37.5, 0.3);
  }
}

TEST(OutsideViewTest, APixelIsTheMeanOfItsRays) {
  const Scene scene = test::busy_scene();
  const FrameSample sample = test::sample_from({0, 0, 0});
  OutsideView view = test::outside_from({0, 0, 1}, 12);
  view.samples = 4;
  const ViewportImage averaged = test::outside_picture(scene, test::settings_with(view), sample);
  // The same rays, each a pixel of its own.
  view.width_px *= 4, view.height_px *= 4, view.samples = 1;
  const ViewportImage rays = test::outside_picture(scene, test::settings_with(view), sample);
  test::for_each_pixel(averaged, [&](int x, int y, const test::Pixel& pixel) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (int i = 0; i < 16; ++i) sum += test::pixel_at(rays, 4 * x + i % 4, 4 * y + i / 4)[c];
      // One rounding to half, and float sums.
      EXPECT_NEAR(pixel[c], sum / 16, 1.01 * test::half_rounding(std::max(sum / 16, 1e-4)));
    }
  });
}

// A floor that stands for a real one, 1 m below the origin; a box floats over its middle.
Scene shadowed_floor() {
  Scene scene;
  test::add(scene, test::floor_quad(5, -1), test::matte(glm::vec3{0.5f}), true);
  test::add(scene, test::box({-0.5f, 0.9f, -3.5f}, {0.5f, 1.0f, -2.5f}), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({0, 4, -3}, glm::vec3{10})};
  scene.ambient = glm::vec3{0.2f};
  scene.environment = {0.1f, 0.2f, 0.4f};
  return scene;
}

TEST(OutsideViewTest, RealSurfacesArePaintedAndShadowsDarkenThem) {
  // Camera at the origin, 45 degrees down: row 25 of 50 is the horizon, the last one looks at 45 degrees.
  OutsideView view = test::outside_from({0, 0, 0}, 64);
  view.see_through = ShownColour{0xff, 0x80, 0x40};
  const glm::vec3 painted = radiance_of(*view.see_through, 1);
  const ViewportImage picture =
      test::outside_picture(shadowed_floor(), test::settings_with(view), test::sample_from({0, 0, 5}));
  // Straight below the box, 3 m ahead and 1 m down: tangent 1/3, row 32 + 32/3. There the light is hidden:
  // r = ambient / (ambient + direct), irradiances pi * 0.2 and 10 / 5^2 (the light is 5 m above).
  const double ambient = glm::pi<double>() * 0.2, direct = 10.0 / 25;
  const test::Pixel shadow = test::pixel_at(picture, 64, 42);
  // Row 62.5 is tangent 30.5/32: 1.05 m ahead, off the shadow, which the box casts within 2 m of z = -3.
  const test::Pixel lit = test::pixel_at(picture, 64, 62);
  const test::Pixel above = test::pixel_at(picture, 2, 10);
  const Scene scene = shadowed_floor();
  for (std::size_t c = 0; c < 3; ++c) {
    const double colour = double{painted[static_cast<int>(c)]};
    EXPECT_NEAR(lit[c], colour, 2 * test::half_rounding(1));
    // Across the pixel the distance to the light changes by half a percent, the shadowed share follows.
    EXPECT_NEAR(shadow[c], colour * ambient / (ambient + direct), 0.01 * colour);
    EXPECT_NEAR(above[c], double{scene.environment[static_cast<int>(c)]}, 2 * test::half_rounding(1));
  }
}

TEST(OutsideViewTest, RealSurfacesArePinkUnlessSomebodySaysOtherwise) {
  const auto lit_pixel = [](std::optional<ShownColour> of_view, std::optional<ShownColour> of_run) {
    OutsideView view = test::outside_from({0, 0, 0}, 64);
    view.see_through = of_view;
    RenderSettings settings = test::settings_with(view);
    settings.see_through_colour = of_run;
    return test::pixel_at(test::outside_picture(shadowed_floor(), settings, test::sample_from({0, 0, 5})), 64,
                          62);
  };
  const ShownColour green{0, 0xff, 0}, blue{0, 0, 0xff};
  const auto expect_shown = [](const test::Pixel& pixel, const ShownColour& colour) {
    const glm::vec3 radiance = radiance_of(colour, 1);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(pixel[c], double{radiance[static_cast<int>(c)]}, 2 * test::half_rounding(1));
    }
  };
  expect_shown(lit_pixel({}, {}), kPink);
  expect_shown(lit_pixel({}, green), green);
  expect_shown(lit_pixel(blue, green), blue);
}

// A lamp that circles, probes that remember, occlusion, several light samples.
RenderSettings full_settings(int threads) {
  RenderSettings settings = test::small_settings();
  settings.threads = threads;
  settings.probes.on = true;
  settings.probes.rays = 16;
  settings.occlusion_rays = 2;
  settings.light_samples = 4;
  return settings;
}

// `frames` of a head that moves, at the quality that a policy would choose.
std::vector<RenderedFrame> walk(Renderer& renderer, const Scene& scene, int frames) {
  std::vector<RenderedFrame> all(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    FrameSample sample = test::sample_from({0.1 * i, 0, 0.2 * i});
    sample.t_ns += 16'666'667 * TimeNs{i};
    SceneState state;
    scene_state_at(scene, 0.05 * i, state);
    const FrameQuality quality{i % 2 == 0 ? 4 : 2, i % 3 == 0 ? 64 : 40, 0};
    EXPECT_TRUE(renderer.render_frame(sample, state, quality, all[static_cast<std::size_t>(i)]));
  }
  return all;
}

TEST(OutsideViewTest, TheHeadsetsPicturesProbesAndCountersAreAsWithoutIt) {
  Scene scene = test::busy_scene();
  scene.lights[0].path_radius_m = 1;
  scene.lights[0].path_period_s = 1;
  scene.probes.counts = {4, 3, 4};
  RenderSettings settings = full_settings(2);
  Renderer without(scene, test::small_profile(24, 30, 20), settings, false);
  OutsideView view = test::outside_from({0, 1, 3}, 16);
  view.overlay = true;
  settings.outside = view;
  Renderer with(scene, test::small_profile(24, 30, 20), settings, false);
  const std::vector<RenderedFrame> expected = walk(without, scene, 9), frames = walk(with, scene, 9);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    SCOPED_TRACE(i);
    test::expect_same_bits(frames[i], expected[i]);
    EXPECT_EQ(frames[i].counters.rays.of_kind, expected[i].counters.rays.of_kind);
    EXPECT_EQ(frames[i].counters.polar_samples, expected[i].counters.polar_samples);
    EXPECT_EQ(frames[i].counters.viewport_pixels, expected[i].counters.viewport_pixels);
  }
  EXPECT_EQ(with.state().probes, without.state().probes);
  EXPECT_EQ(with.state().details, without.state().details);
}

TEST(OutsideViewTest, ItsPictureIsTheSameOnAnyNumberOfThreads) {
  Scene scene = test::busy_scene();
  scene.probes.counts = {4, 3, 4};
  const auto picture = [&](int threads) {
    RenderSettings settings = full_settings(threads);
    OutsideView view = test::outside_from({0, 1, 3}, 40);
    view.overlay = true;
    settings.outside = view;
    return test::outside_picture(scene, settings, test::sample_from({0, 0, 1}));
  };
  const ViewportImage one = picture(1);
  EXPECT_TRUE(test::same_bits(one, picture(2)));
  EXPECT_TRUE(test::same_bits(one, picture(3)));
}

TEST(OutsideViewTest, ItsNoiseIsNotThatOfAnEye) {
  // Were a pixel's key that of an eye, light samples of both would err alike.
  EXPECT_NE(outside_key(1'000'000, 0), frame_key(1'000'000, 0, 0));
  EXPECT_NE(outside_key(1'000'000, 0), frame_key(1'000'000, 1, 0));
  EXPECT_NE(outside_key(1'000'000, 0), outside_key(1'000'001, 0));
  EXPECT_NE(outside_key(1'000'000, 0), outside_key(1'000'000, 1));
}

bool is_reddish(const test::Pixel& pixel) {
  return pixel[0] > 0.5 && pixel[1] < 0.2 && pixel[2] < 0.2;
}

TEST(OutsideViewTest, TheGazeIsDrawnWhereItLeadsAndHiddenBehindWhatStandsBeforeIt) {
  // The head looks along +X past the camera, which looks along -Z from 4 m away: the gaze runs in the
  // picture's middle row (y = 0) from the middle to the right, 5 m long for there is nothing to meet. At x =
  // 2, tangent 0.5 of 2, it lies in column 100 + 25.
  FrameSample sample = test::sample_from({0, 0, 0});
  sample.head.world_from_head.orientation = glm::angleAxis(-glm::half_pi<double>(), glm::dvec3{0, 1, 0});
  OutsideView view = test::outside_from({0, 0, 4}, 100);
  view.overlay = true;
  view.frusta_m = 0.05;
  Scene scene;
  test::add(scene, test::box({-90, -90, -90}, {-89, -89, -89}), test::matte(glm::vec3{0.5f}));
  const auto reddish_at = [&](int x) {
    const ViewportImage picture = test::outside_picture(scene, test::settings_with(view), sample);
    return is_reddish(test::pixel_at(picture, x, 49)) || is_reddish(test::pixel_at(picture, x, 50));
  };
  EXPECT_TRUE(reddish_at(125));
  EXPECT_TRUE(reddish_at(140));
  EXPECT_FALSE(reddish_at(170)) << "5 m lie in column 162";
  EXPECT_FALSE(reddish_at(60)) << "nobody looks there";
  // A plate before x = 2, half-way to the camera; the gaze still shows beside it.
  test::add(scene, test::box({0.8f, -0.3f, 1.9f}, {1.2f, 0.3f, 2.1f}), test::matte(glm::vec3{0.5f}));
  EXPECT_FALSE(reddish_at(125));
  EXPECT_TRUE(reddish_at(110));
  EXPECT_TRUE(reddish_at(140));
  // A wall at x = 1 ends it: tangent 0.25 of 2, column 112.
  test::add(scene, test::box({1, -1, -0.2f}, {1.1f, 1, 0.2f}), test::matte(glm::vec3{0.5f}));
  EXPECT_TRUE(reddish_at(108));
  EXPECT_FALSE(reddish_at(140));
}

}  // namespace
}  // namespace herr
