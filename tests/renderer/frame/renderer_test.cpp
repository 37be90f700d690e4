// The renderer as its callers see it: counters, options, cameras that one eye lacks, its pool.
#include "renderer/renderer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>

#include "renderer/frame/renderer_impl.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

Scene grey_floor() {
  Scene scene;
  test::add(scene, test::floor_quad(20, -1), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({1, 3, -1}, glm::vec3{20.0f})};
  scene.ambient = glm::vec3{0.25f};
  return scene;
}

TEST(RendererTest, CountsPixelsAndRays) {
  const Scene scene = grey_floor();
  RenderSettings settings = test::planar_settings();
  const RenderedFrame frame =
      test::render(scene, test::small_profile(), settings, test::sample_from({0, 0, 0}));
  const std::int64_t pixels = 2 * (64 * 64 + 80 * 48);
  EXPECT_EQ(frame.counters.viewport_pixels, pixels);
  // Without foveation there is one ray per pixel, and one shadow ray per ray that meets
  // the floor: the lower half.
  EXPECT_EQ(frame.counters.rays[RayKind::primary], pixels);
  EXPECT_EQ(frame.counters.polar_samples, pixels);
  EXPECT_GT(frame.counters.rays[RayKind::shadow], pixels * 2 / 5);
  EXPECT_LE(frame.counters.rays[RayKind::shadow], pixels / 2);
  EXPECT_EQ(frame.counters.rays[RayKind::mirror], 0);
}

TEST(RendererTest, SurfacesThatFaceAwayFromTheLightSendNoShadowRay) {
  Scene scene = grey_floor();
  scene.lights[0].centre = {1, -3, -1};  // under the floor
  const RenderedFrame frame =
      test::render(scene, test::small_profile(), test::small_settings(), test::sample_from({0, 0, 0}));
  EXPECT_EQ(frame.counters.rays[RayKind::shadow], 0);
}

TEST(RendererTest, ReportsHowFarEachEyesViewportsReach) {
  const RenderedFrame frame =
      test::render(grey_floor(), test::small_profile(), test::small_settings(), test::sample_from({0, 0, 0}));
  // From straight ahead to a corner of +-45 x +-45 degrees.
  EXPECT_NEAR(frame.theta_max_deg[0], 54.735610317245346, 1e-9);
  EXPECT_NEAR(frame.theta_max_deg[1], 54.735610317245346, 1e-9);
}

TEST(RendererTest, AnEyeThatNoViewportBelongsToCostsNothing) {
  const RenderedFrame frame = test::render(grey_floor(), test::single_view(64, 64, 45, 45),
                                           test::small_settings(), test::sample_from({0, 0, 0}));
  EXPECT_EQ(frame.theta_max_deg[1], 0.0);
  EXPECT_LE(frame.counters.rays[RayKind::primary], 64 * 48);
  test::expect_finite(frame);
}

TEST(RendererTest, EachEyeSeesFromItsOwnPlace) {
  // A thin post 1 m ahead: eyes 20 cm apart see it 0.1 m to the side of their middle, at tan = 0.1.
  Scene scene;
  test::add(scene, test::box({-0.01f, -2, -1.01f}, {0.01f, 2, -0.99f}), test::glowing(glm::vec3{1.0f}));
  FrameSample sample = test::sample_from({0, 0, 0});
  sample.head_from_eye[0].position.x = -0.1;
  sample.head_from_eye[1].position.x = 0.1;
  DisplayProfile profile;
  for (const Eye eye : kEyes) profile.viewports.push_back(test::viewport_deg(eye, 401, 3, -45, 45, -1, 1));
  const RenderedFrame frame = test::render(scene, profile, test::planar_settings(), sample);
  // Column of tan t: 200.5 + 200.5 t - 0.5.
  EXPECT_EQ(test::pixel_at(frame.viewports[0], 220, 1)[0], 1.0);
  EXPECT_EQ(test::pixel_at(frame.viewports[0], 180, 1)[0], 0.0);
  EXPECT_EQ(test::pixel_at(frame.viewports[1], 180, 1)[0], 1.0);
  EXPECT_EQ(test::pixel_at(frame.viewports[1], 220, 1)[0], 0.0);
}

TEST(RendererTest, TheGazeMarkerIsDrawnWhereAskedFor) {
  RenderSettings settings = test::small_settings();
  const FrameSample sample = test::sample_from({0, 0, 0}, test::gaze_deg(5, 5));
  const RenderedFrame without = test::render(grey_floor(), test::small_profile(), settings, sample);
  settings.gaze_marker = true;
  const RenderedFrame with = test::render(grey_floor(), test::small_profile(), settings, sample);
  for (std::size_t i = 0; i < with.viewports.size(); ++i)
    EXPECT_FALSE(test::same_bits(without.viewports[i], with.viewports[i])) << i;
}

// Opaque blue and yellow lie on the picture without it, which is otherwise the same, bit for bit. Every
// viewport has a yellow line: 1 per degree around the gaze's axis at asin(48 / 360) = 7.7 degrees off it;
// without foveation at acos(0.873) = 29.2 degrees in a context of 100 pixels over 2 tan 45, and 2 per degree
// at acos(1.918 / 2) = 16.5 degrees in a focus of 80 over 2 tan 20.
TEST(RendererTest, TheDensityOverlayChangesItsLinesAlone) {
  const DisplayProfile profile = test::small_profile(100);
  const FrameSample sample = test::sample_from({0, 0, 0}, test::gaze_deg(5, 5));
  for (const Foveation foveation : {Foveation::log_polar, Foveation::off}) {
    RenderSettings settings = test::small_settings();
    settings.foveation = foveation;
    const RenderedFrame without = test::render(grey_floor(), profile, settings, sample);
    settings.density_overlay = true;
    const RenderedFrame with = test::render(grey_floor(), profile, settings, sample);
    EXPECT_GT(with.times[Stage::overlays], 0);
    for (std::size_t i = 0; i < with.viewports.size(); ++i) {
      int blue = 0, yellow = 0, same = 0;
      test::for_each_pixel(with.viewports[i], [&](int x, int y, const test::Pixel& pixel) {
        if (pixel == test::pixel_at(without.viewports[i], x, y)) {
          ++same;
          return;
        }
        ASSERT_EQ(pixel[3], 1.0) << x << ", " << y;
        blue += pixel[2] == 1.0 ? 1 : 0;
        yellow += pixel[0] == 1.0 ? 1 : 0;
      });
      EXPECT_GT(blue, 0) << i;
      EXPECT_GT(yellow, 0) << i;
      EXPECT_GT(same, blue + yellow) << i;
    }
  }
}

TEST(RendererTest, DebugTilesAreConstantWithinATileAndDifferFromTheirNeighbours) {
  RenderSettings settings = test::small_settings();
  settings.debug_tiles = true;
  settings.polar_width = settings.polar_height = 384;
  const DisplayProfile profile = test::single_view(300, 300, 45, 45);
  const RenderedFrame frame = test::render(Scene{}, profile, settings, test::sample_from({0, 0, 0}));
  std::map<std::pair<int, int>, test::Pixel> tiles;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    const glm::dvec3 d = test::direction_of_pixel(profile.viewports[0], x, y);
    const double theta = eccentricity_deg({0, 0, -1}, d);
    const double phi = 360 * v_from_phi(std::atan2(d.y, d.x));
    // A sample is at most 56 ln(56) / 384 = 0.6 degrees long and 360 / 384 degrees of
    // phi wide: 1.5 keeps clear.
    const auto inside = [](double angle) { return std::abs(std::remainder(angle, 15.0)) > 1.5; };
    if (!inside(theta) || !inside(phi)) return;
    const auto [tile, is_new] =
        tiles.emplace(std::pair{static_cast<int>(theta / 15), static_cast<int>(phi / 15)}, pixel);
    ASSERT_EQ(tile->second, pixel) << x << ", " << y;
    ASSERT_EQ(pixel[3], 1.0);
  });
  EXPECT_GE(tiles.size(), 3 * 24u);
  for (const auto& [place, pixel] : tiles) {
    const auto right = tiles.find({place.first, (place.second + 1) % 24}),
               outer = tiles.find({place.first + 1, place.second});
    if (right != tiles.end()) {
      EXPECT_NE(pixel, right->second);
    }
    if (outer != tiles.end()) {
      EXPECT_NE(pixel, outer->second);
    }
  }
}

TEST(RendererTest, AFrameWithoutACameraImageYetIsATransparentOverlay) {
  // The session has a camera, but its first image is still to come.
  FrameSample sample = test::sample_from({0, 0, 0});
  const Scene scene = grey_floor();
  Renderer renderer(scene, test::small_profile(), test::small_settings(), true);
  RenderedFrame frame;
  test::render_with(renderer, scene, sample, frame);
  test::expect_finite(frame);
  EXPECT_EQ(test::pixel_at(frame.viewports[0], 32, 5)[3], 0.0);   // sky
  EXPECT_EQ(test::pixel_at(frame.viewports[0], 32, 60)[3], 1.0);  // floor
}

TEST(RendererTest, ItsPoolRunsEveryJobOnceAndPassesExceptionsOn) {
  const Scene scene;
  RenderSettings settings = test::small_settings();
  settings.threads = 3;
  Renderer renderer(scene, test::small_profile(), settings, false);
  EXPECT_EQ(renderer.threads(), 3);
  std::vector<std::atomic<int>> runs(1000);
  renderer.parallel_for(1000, [&](int i) { ++runs[static_cast<std::size_t>(i)]; });
  for (const auto& count : runs) EXPECT_EQ(count.load(), 1);
  EXPECT_THROW(renderer.parallel_for(10,
                                     [](int i) {
                                       if (i == 7) throw std::runtime_error("seven");
                                     }),
               std::runtime_error);
  renderer.parallel_for(0, [](int) { FAIL(); });
}

TEST(RendererTest, StagesHaveNames) {
  for (std::size_t i = 0; i < kStageCount; ++i) EXPECT_STRNE(name_of(static_cast<Stage>(i)), "unknown");
}

}  // namespace
}  // namespace herr
