// When mirrors and glass show the camera feed, and when something else: catchers, ends of paths, the border
// of the camera's view, no camera.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/lighting/clear_glass.h"
#include "tests/renderer/lighting/feed_chart.h"
#include "tests/renderer/rendered_frames.h"

namespace herr {
namespace {

// Red grows with x and green with y, by 1/64 a pixel.
test::ChartTexel rising(int x, int y) {
  return {test::to_half(x / 64.0), test::to_half(y / 64.0), test::to_half(0.5), 0x3c00};
}

Material whole_mirror() {
  Material m = test::matte(glm::vec3{1.0f});
  m.metallic = 1;
  m.roughness = 0;
  m.mirror = 1;
  return m;
}

// As thin as air: it bends nothing and reflects nothing.
Material air() {
  Material m = test::clear_glass();
  m.mirror = 0;
  m.refractive_index = 1;
  return m;
}

FrameSample at_origin(const test::ChartCamera& camera) {
  FrameSample sample = test::sample_from({0, 0, 0});
  camera.taken.attach_to(sample);
  for (auto& eye : sample.cameras) eye->world_from_camera = camera.eye_from_camera;
  return sample;
}

RenderSettings planar(const test::ChartCamera& camera) {
  RenderSettings settings = test::planar_settings();
  settings.feed_distance_m = camera.distance_m;
  return settings;
}

// The composite places the feed within 1/32 pixel where cells interpolate it; a ray through panes of air is
// off by what its start off each of them rounds, far below that. Both are stored as halfs, as is the texel.
void expect_same_feed(const RenderedFrame& shown, const RenderedFrame& expected) {
  test::for_each_pixel(shown.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const test::Pixel behind = test::pixel_at(expected.viewports[0], x, y);
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_NEAR(pixel[c], behind[c], (1.0 / 32 + 0.01) / 64 + 4 * test::half_rounding(behind[c]) + 1e-6)
          << x << ", " << y;
    }
  });
}

TEST(MirroredFeedRulesTest, APaneOfAirShowsTheFeedWhereItLies) {
  for (const CameraModelKind lens : {CameraModelKind::pinhole, CameraModelKind::kb4}) {
    for (const bool catcher : {false, true}) {
      for (const double ev : {0.0, 3.0}) {
        SCOPED_TRACE(testing::Message() << catcher << ", " << ev << " EV");
        const test::ChartCamera camera = test::chart_camera(lens, rising);
        Scene behind;
        behind.ambient = glm::vec3{0.3f};
        behind.environment = glm::vec3{7.0f};
        if (catcher) {
          test::add(behind, test::quad({-4, -0.4f, -1}, {8, 0, 0}, {0, 1, -1}), test::matte({0.9f, 0, 0}),
                    true);
        }
        Scene pane = behind;
        test::add(pane, test::quad({-4, -4, -0.5f}, {8, 0, 0}, {0, 8, 0}), air());
        RenderSettings settings = planar(camera);
        settings.exposure_ev = ev;
        const DisplayProfile profile = test::single_view(90, 70, 25, 20);  // within the camera's view
        const FrameSample sample = at_origin(camera);
        const RenderedFrame frame = test::render(pane, profile, settings, sample);
        EXPECT_EQ(frame.counters.rays[RayKind::refraction], 90 * 70);
        expect_same_feed(frame, test::render(behind, profile, settings, sample));
      }
    }
  }
}

TEST(MirroredFeedRulesTest, PathsThatEndShowTheFeed) {
  // Twenty panes of air: after twelve a path ends, and brings what its direction leads to.
  const test::ChartCamera camera = test::chart_camera(CameraModelKind::pinhole, rising);
  Scene panes;
  panes.environment = glm::vec3{7.0f};
  for (int i = 0; i < 20; ++i) {
    const float z = -0.5f - 0.05f * static_cast<float>(i);
    test::add(panes, test::quad({-4, -4, z}, {8, 0, 0}, {0, 8, 0}), air());
  }
  const DisplayProfile profile = test::single_view(64, 48, 25, 20);
  const FrameSample sample = at_origin(camera);
  const RenderedFrame frame = test::render(panes, profile, planar(camera), sample);
  EXPECT_EQ(frame.counters.cut_paths, 64 * 48);
  expect_same_feed(frame, test::render(Scene{}, profile, planar(camera), sample));
}

TEST(MirroredFeedRulesTest, CatchersInAMirrorShowTheFeedTimesTheirRatio) {
  // A table at y = -0.5 beside a mirror in the plane x = 0.5; a lamp at (0, 1, -1.2), and under it a square
  // that shadows half a metre of the table around (0, -0.5, -1.2): 0.1 * 1.5 / 0.3 from its middle. There the
  // ratio is pi a / (pi a + I cos / d^2), elsewhere 1.
  const test::ChartCamera camera = test::chart_camera(CameraModelKind::kb4, rising);
  constexpr double kAmbient = 0.1, kIntensity = 2;
  Scene scene;
  scene.ambient = glm::vec3{static_cast<float>(kAmbient)};
  scene.environment = glm::vec3{7.0f};
  const glm::dvec3 lamp{0, 1, -1.2};
  scene.lights = {test::light_at(lamp, glm::vec3{static_cast<float>(kIntensity)})};
  test::add(scene, test::floor_quad(9, -0.5f), test::matte({0.9f, 0, 0}), true);
  test::add(scene, test::quad({0.5f, -0.5f, -0.6f}, {0, 0, -1.6f}, {0, 1, 0}), whole_mirror());
  test::add(scene, test::quad({-0.1f, 0.7f, -1.1f}, {0.2f, 0, 0}, {0, 0, -0.2f}), test::matte({0, 0, 0}));
  const DisplayProfile profile = test::single_view(240, 160, 40, 30);
  RenderSettings settings = planar(camera);
  settings.ray_width = 0;  // the lamp's glint on the mirror stays where it is
  const RenderedFrame frame = test::render(scene, profile, settings, at_origin(camera));
  int lit = 0, shadowed = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 direction = test::direction_of_pixel(profile.viewports[0], x, y);
    const auto off = test::off_plane({{0, 0, 0}, direction, 1}, {0.5, 0, 0}, {-1, 0, 0});
    if (!off || off->origin.z > -0.61 || off->origin.z < -2.19 || off->origin.y < -0.49) return;
    const auto met = test::off_plane(*off, {0, -0.5, 0}, {0, 1, 0});
    if (!met || off->origin.y > 0.49 || !camera.sees(met->origin, 1)) return;
    if (met->origin.z < -8.9) return;  // beyond the table
    const glm::dvec3 at = met->origin, from_middle = glm::abs(at - glm::dvec3{0, -0.5, -1.2});
    const double outside = std::max(from_middle.x, from_middle.z) - 0.5;
    if (std::abs(outside) < 0.01) return;  // the edge of the shadow
    const glm::dvec3 to_lamp = lamp - at;
    const double d = glm::length(to_lamp), e = kIntensity * (to_lamp.y / d) / (d * d),
                 around = glm::pi<double>() * kAmbient;
    const double ratio = outside > 0 ? 1 : around / (around + e);
    (outside > 0 ? lit : shadowed) += 1;
    const glm::dvec3 expected = ratio * camera.colour(at);
    for (int c = 0; c < 2; ++c) {
      // Floats on the way: 1e-5 of a pixel's coordinates and of the ratio.
      ASSERT_NEAR(pixel[static_cast<std::size_t>(c)], expected[c],
                  0.02 / 64 + 1e-5 * expected[c] + 2 * test::half_rounding(expected[c]))
          << x << ", " << y;
    }
  });
  EXPECT_GT(lit, 300);
  EXPECT_GT(shadowed, 300);
}

TEST(MirroredFeedRulesTest, OutsideTheCamerasViewAMirrorShowsWhatItDoesWithoutACamera) {
  // Behind the eye, where the camera does not look: a catcher that covers half of what the mirror shows. The
  // mirror fills the view, so no pixel shows the feed itself.
  test::ChartCamera camera = test::chart_camera(CameraModelKind::kb4, rising);
  camera.distance_m = 20;  // all that the mirror shows lies behind the eye
  Scene scene;
  test::add(scene, test::quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), whole_mirror());
  test::add(scene, test::quad({99, 0, 1}, {-198, 0, 0}, {0, 198, 0}), test::matte({0.2f, 0.4f, 0.8f}), true);
  scene.ambient = glm::vec3{0.5f};
  scene.environment = {0.1f, 0.2f, 0.3f};
  const DisplayProfile profile = test::single_view(32, 32, 30, 30);
  RenderSettings settings = planar(camera);
  const RenderedFrame with = test::render(scene, profile, settings, at_origin(camera));
  test::expect_same_bits(with, test::render(scene, profile, settings, test::sample_from({0, 0, 0})));
  // Base colour + 0.04, times the ambient light.
  EXPECT_NEAR(test::pixel_at(with.viewports[0], 16, 4)[2], 0.42, test::half_rounding(0.42) + 1e-6);
  EXPECT_NEAR(test::pixel_at(with.viewports[0], 16, 28)[2], 0.3, test::half_rounding(0.3) + 1e-6);
}

TEST(MirroredFeedRulesTest, ASideThatTheEyeDoesNotSeeKeepsItsStatedColour) {
  // A real board in the plane x = -0.3, of which the eye at x = 0 sees one side and the mirror at x = -0.8
  // shows the other: the ray along (-0.8, 0, -2) comes off it at (-0.8, 0, -2) and meets the board at
  // (-0.3, 0, -3.25), in the middle of the camera's view.
  const test::ChartCamera camera = test::chart_camera(CameraModelKind::kb4, rising);
  Scene scene;
  test::add(scene, test::quad({-0.8f, -1, -1.6f}, {0, 0, -0.8f}, {0, 2, 0}), whole_mirror());
  test::add(scene, test::quad({-0.3f, -1, -2.8f}, {0, 0, -1.2f}, {0, 2, 0}), test::matte({0.2f, 0.4f, 0.8f}),
            true);
  scene.ambient = glm::vec3{0.5f};
  DisplayProfile profile = test::single_view(3, 3, 1, 1);
  Viewport& view = profile.viewports[0];
  view.tan_left += -0.4, view.tan_right += -0.4;
  const RenderedFrame frame = test::render(scene, profile, planar(camera), at_origin(camera));
  EXPECT_NEAR(test::pixel_at(frame.viewports[0], 1, 1)[0], 0.12, test::half_rounding(0.12) + 1e-6);
  EXPECT_NEAR(test::pixel_at(frame.viewports[0], 1, 1)[2], 0.42, test::half_rounding(0.42) + 1e-6);
}

TEST(MirroredFeedRulesTest, ARealMirrorShowsVirtualThingsAlone) {
  // Its reflection of the room is in the feed already.
  const test::ChartCamera camera = test::chart_camera(CameraModelKind::kb4, rising);
  const auto table = [&](float mirror) {
    Scene scene;
    Material top = test::matte(glm::vec3{0.5f});
    top.mirror = mirror;
    test::add(scene, test::floor_quad(9, -0.5f), top, true);
    test::add(scene, test::quad({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}), whole_mirror());  // behind the eye
    scene.ambient = glm::vec3{0.5f};
    const RenderedFrame frame = test::render(scene, test::small_profile(), planar(camera), at_origin(camera));
    EXPECT_EQ(frame.counters.rays[RayKind::mirror] > 0, mirror > 0);
    return frame;
  };
  test::expect_same_bits(table(0.5f), table(0));
}

// A mirror that shows what is ahead, and a glass ball.
Scene mirror_and_ball() {
  Scene scene;
  test::add(scene, test::quad({-0.7f, -0.35f, -0.7f}, {1.4f, 0, 0}, {0, 0, -1}), whole_mirror());
  test::add_ball(scene, {-0.3, 0.05, -1}, 0.2, test::clear_glass(), glm::dmat4x3{1.0});
  scene.environment = {0.1f, 0.2f, 0.3f};
  return scene;
}

// Rays off the plate rise and go on ahead, and those through the ball go where Snell's law leads them: the
// camera looks down and back, where none of them meets the feed, and no pixel on plate or ball can tell it
// from no camera.
TEST(MirroredFeedRulesTest, WhereTheCameraSeesNothingOfWhatTheyShowPicturesAreAsWithoutTheFeature) {
  test::ChartCamera camera = test::chart_camera(CameraModelKind::pinhole, rising);
  Scene scene = mirror_and_ball();
  scene.materials[scene.instances[1].material].mirror = 0;  // what it reflects lies everywhere
  const DisplayProfile profile = test::single_view(160, 120, 40, 32);
  const auto render = [&](bool feature, const FrameSample& sample) {
    RenderSettings settings = planar(camera);
    settings.camera = feature;
    Renderer renderer(scene, profile, settings, true);
    EXPECT_EQ(renderer.plan().mirrored_feed, feature);
    RenderedFrame frame;
    test::render_with(renderer, scene, sample, frame);
    return frame;
  };
  const RenderedFrame ahead = render(true, at_origin(camera));
  camera.eye_from_camera = {{0, 0, 0}, glm::angleAxis(-glm::radians(135.0), glm::dvec3{1, 0, 0})};
  const RenderedFrame away = render(true, at_origin(camera)), without = render(false, at_origin(camera));
  int in_ball = 0, on_plate = 0, shows_feed = 0;
  test::for_each_pixel(away.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const test::TracedRay ray{{0, 0, 0}, test::direction_of_pixel(profile.viewports[0], x, y), 1};
    const bool ball = test::through_ball(ray, {-0.3, 0.05, -1}, 0.199, test::kGlassIndex).has_value();
    const auto off = test::off_plane(ray, {0, -0.35, 0}, {0, 1, 0});
    const bool plate =
        off && std::abs(off->origin.x) < 0.69 && off->origin.z < -0.71 && off->origin.z > -1.69;
    if (!ball && !plate) return;
    ASSERT_FALSE(ball && plate) << "the ball hides no part of the plate";
    (ball ? in_ball : on_plate) += 1;
    ASSERT_EQ(pixel, test::pixel_at(without.viewports[0], x, y)) << x << ", " << y;
    shows_feed += pixel != test::pixel_at(ahead.viewports[0], x, y);
  });
  EXPECT_GT(in_ball, 300);
  EXPECT_GT(on_plate, 300);
  EXPECT_GT(shows_feed, 0.5 * (in_ball + on_plate));
}

TEST(MirroredFeedRulesTest, ItRunsWhereThereIsAFeedAndSomethingToShowItIn) {
  const Scene shows = mirror_and_ball();
  Scene catcher;
  Material top = test::matte(glm::vec3{0.5f});
  top.mirror = 1;
  test::add(catcher, test::floor_quad(9, -0.5f), top, true);
  RenderSettings settings = test::small_settings();
  EXPECT_TRUE(plan_frame(shows, settings, true).mirrored_feed);
  EXPECT_FALSE(plan_frame(shows, settings, false).mirrored_feed);
  EXPECT_FALSE(plan_frame(catcher, settings, true).mirrored_feed);
  settings.refraction = false;
  EXPECT_TRUE(plan_frame(shows, settings, true).mirrored_feed) << "the plate mirrors";
  settings.reflections = false;
  EXPECT_FALSE(plan_frame(shows, settings, true).mirrored_feed);
}

TEST(MirroredFeedRulesTest, AFrameBeforeTheFirstImageShowsTheEnvironment) {
  const Scene scene = mirror_and_ball();
  Renderer renderer(scene, test::small_profile(), test::small_settings(), true);
  const test::ChartCamera camera = test::chart_camera(CameraModelKind::kb4, rising);
  RenderedFrame before, between, after;
  test::render_with(renderer, scene, test::sample_from({0, 0, 0}), before);
  test::render_with(renderer, scene, at_origin(camera), between);
  test::render_with(renderer, scene, test::sample_from({0, 0, 0}), after);
  test::expect_same_bits(before, after);
  EXPECT_GT(test::mean_difference(before, between), 0.1);
}

TEST(MirroredFeedRulesTest, EachEyeSeesItsOwnFeed) {
  const auto plain = [](double red, double green) {
    return test::chart_camera(CameraModelKind::kb4, [=](int, int) {
      return test::ChartTexel{test::to_half(red), test::to_half(green), 0, 0x3c00};
    });
  };
  const test::ChartCamera left = plain(0.75, 0), right = plain(0, 0.5);
  FrameSample sample = at_origin(left);
  sample.cameras[1] = at_origin(right).cameras[1];
  Scene scene;
  test::add(scene, test::floor_quad(9, -0.2f), whole_mirror());
  for (const Foveation foveation : {Foveation::log_polar, Foveation::off}) {
    RenderSettings settings = test::small_settings();
    settings.foveation = foveation;
    const RenderedFrame frame = test::render(scene, test::small_profile(64), settings, sample);
    // 16 rows below the horizon of 45 degrees: 27 degrees down, and mirrored as far up.
    EXPECT_EQ(test::pixel_at(frame.viewports[0], 32, 48), (test::Pixel{0.75, 0, 0, 1}));
    EXPECT_EQ(test::pixel_at(frame.viewports[2], 32, 48), (test::Pixel{0, 0.5, 0, 1}));
  }
}

TEST(MirroredFeedRulesTest, BlendedSurfacesCoverTheirShareOfIt) {
  // Black, of alpha 0.5, between the eye and the mirror.
  const test::ChartCamera camera = test::chart_camera(CameraModelKind::kb4, [](int, int) {
    return test::ChartTexel{test::to_half(0.75), test::to_half(0.5), 0, 0x3c00};
  });
  Scene scene;
  test::add(scene, test::floor_quad(9, -0.2f), whole_mirror());
  Material veil = test::matte(glm::vec3{0.0f});
  veil.alpha_mode = AlphaMode::blend;
  veil.alpha = 0.5f;
  test::add(scene, test::quad({-4, -4, -0.1f}, {8, 0, 0}, {0, 8, 0}), veil);
  const RenderedFrame frame = test::render(scene, test::small_profile(64), planar(camera), at_origin(camera));
  const test::Pixel pixel = test::pixel_at(frame.viewports[0], 32, 48);
  EXPECT_NEAR(pixel[0], 0.375, test::half_rounding(0.375) + 1e-6);
  EXPECT_NEAR(pixel[1], 0.25, test::half_rounding(0.25) + 1e-6);
}

TEST(MirroredFeedRulesTest, NeitherThreadsNorVectorsChangeIt) {
  const test::ChartCamera camera = test::chart_camera(CameraModelKind::kb4, rising);
  Scene scene = mirror_and_ball();
  test::add(scene, test::floor_quad(9, -0.5f), test::matte({0.9f, 0, 0}), true);
  scene.lights = {test::light_at({0, 2, -1}, glm::vec3{5.0f}, {0.3f, 0.1f, 0.3f})};
  const auto render = [&](int threads, Isa isa, bool probes = false) {
    RenderSettings settings = test::small_settings();
    settings.probes.on = probes;
    settings.threads = threads;
    settings.isa = isa;
    settings.light_samples = 4;
    return test::render(scene, test::small_profile(), settings, at_origin(camera));
  };
  const RenderedFrame one = render(1, Isa::best);
  test::expect_same_bits(one, render(3, Isa::best));
  test::expect_same_bits(render(1, Isa::best, true), render(3, Isa::best, true));
  for (const Isa isa : test::offered_isas()) {
    // Pixels are around 2; rays differ by rounding, which flips a shadow here and there.
    EXPECT_LT(test::mean_difference(one, render(1, isa)), 2e-3) << name_of(isa);
  }
}

}  // namespace
}  // namespace herr
