// Ways of light through glass and off it: mirrors among glass, threads, limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/renderer/lighting/clear_glass.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

Material perfect_mirror() {
  Material m = test::matte(glm::vec3{1.0f});
  m.metallic = 1;
  m.roughness = 0;
  m.mirror = 1;
  return m;
}

// The middle of a view along -Z from the origin.
test::Pixel seen_ahead(const Scene& scene, bool reflections) {
  RenderSettings settings = test::planar_settings();
  settings.reflections = reflections;
  const RenderedFrame frame =
      test::render(scene, test::single_view(3, 3, 0.1, 0.1), settings, test::sample_from({0, 0, 0}));
  test::expect_finite(frame);
  return test::pixel_at(frame.viewports[0], 1, 1);
}

TEST(GlassPathsTest, AMirrorShowsWhatIsBehindGlass) {
  // Behind the eye a pane, behind that a wall that glows with 2. Of the mirrored light the pane passes
  // (1 - R), R = 2 F / (1 + F) being what its two faces send back in all; that comes from the mirror again,
  // which a mirrored ray does not follow.
  Scene scene;
  test::add(scene, test::quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), perfect_mirror());
  test::add(scene, test::box({-9, -9, 1}, {9, 9, 1.5f}), test::clear_glass());
  test::add(scene, test::quad({9, -9, 3}, {-18, 0, 0}, {0, 18, 0}), test::glowing({2, 2, 2}));
  const double returns = 2 * test::kGlassHeadOn / (1 + test::kGlassHeadOn);
  EXPECT_NEAR(seen_ahead(scene, true)[0], 2 * (1 - returns), 2.0 / 512 + 1e-3);
}

TEST(GlassPathsTest, GlassShowsAMirrorBehindIt) {
  // The pane between eye and mirror, the glowing wall behind the eye: R comes off the pane, (1 - R)^2 passes
  // it on the way to the mirror and back.
  Scene scene;
  test::add(scene, test::quad({-9, -9, -3}, {18, 0, 0}, {0, 18, 0}), perfect_mirror());
  test::add(scene, test::box({-9, -9, -2}, {9, 9, -1.5f}), test::clear_glass());
  test::add(scene, test::quad({9, -9, 1}, {-18, 0, 0}, {0, 18, 0}), test::glowing({2, 2, 2}));
  const double returns = 2 * test::kGlassHeadOn / (1 + test::kGlassHeadOn), passes = 1 - returns;
  EXPECT_NEAR(seen_ahead(scene, true)[0], 2 * (returns + passes * passes), 4.0 / 512 + 1e-3);
}

TEST(GlassPathsTest, SeveralPanesLoseNoLight) {
  // Three panes, slanting, six interfaces and many ways: 1 from everywhere is 1.
  Scene scene;
  for (const float z : {-2.0f, -3.0f, -4.0f}) {
    const glm::dmat4x3 place(
        glm::rotate(glm::translate(glm::dmat4{1.0}, {0, 0, z}), 0.2 * z, glm::dvec3{0, 1, 0}));
    test::add(scene, test::box({-9, -9, -0.1f}, {9, 9, 0.1f}), test::clear_glass(), false, place);
  }
  scene.environment = glm::vec3{1.0f};
  const RenderedFrame frame = test::render(scene, test::single_view(48, 48, 40, 40), test::planar_settings(),
                                           test::sample_from({0, 0, 0}));
  test::for_each_pixel(frame.viewports[0], [](int x, int y, const test::Pixel& pixel) {
    ASSERT_NEAR(pixel[0], 1.0, 1e-3) << x << ", " << y;
  });
}

TEST(GlassPathsTest, FromWithinABodyNoLightIsLost) {
  // The eye in a block of glass: what its faces reflect, totally beyond 41.8 degrees, meets other faces.
  Scene scene;
  test::add(scene, test::box({-1, -1, -1}, {1, 1, 1}), test::clear_glass());
  scene.environment = glm::vec3{1.0f};
  const RenderedFrame frame = test::render(scene, test::single_view(48, 48, 60, 60), test::planar_settings(),
                                           test::sample_from({0.1, 0.2, 0.3}));
  EXPECT_GT(frame.counters.cut_paths, 100) << "light in a corner never leaves: only the limit ends it";
  test::for_each_pixel(frame.viewports[0], [](int x, int y, const test::Pixel& pixel) {
    ASSERT_NEAR(pixel[0], 1.0, 1e-3) << x << ", " << y;
  });
}

// A mirror ball, two glass balls and a floor under a lamp.
Scene balls() {
  Scene scene;
  test::add(scene, test::floor_quad(9, -1), test::matte({0.6f, 0.5f, 0.3f}));
  test::add(scene, test::sphere({-0.7f, 0, -4}, 0.6f), perfect_mirror());
  test::add(scene, test::sphere({0.6f, 0, -3.5f}, 0.6f), test::clear_glass());
  test::add(scene, test::sphere({0.1f, 0.3f, -2}, 0.2f), test::clear_glass());
  scene.lights = {test::light_at({1, 3, -2}, glm::vec3{9.0f}, {0.5f, 0.1f, 0.5f})};
  scene.environment = {0.3f, 0.5f, 0.8f};
  scene.ambient = glm::vec3{0.2f};
  return scene;
}

TEST(GlassPathsTest, ThreadsDoNotChangeThem) {
  const Scene scene = balls();
  const auto render = [&](int threads) {
    RenderSettings settings = test::planar_settings();
    settings.threads = threads;
    settings.light_samples = 4;
    return test::render(scene, test::single_view(160, 160, 25, 25), settings, test::sample_from({0, 0, 0}));
  };
  const RenderedFrame one = render(1), three = render(3);
  test::expect_same_bits(one, three);
  EXPECT_EQ(one.counters.rays[RayKind::refraction], three.counters.rays[RayKind::refraction]);
  EXPECT_EQ(one.counters.cut_paths, three.counters.cut_paths);
}

TEST(GlassPathsTest, WiderVectorsFollowTheSameRays) {
  // AVX2 has vectors of 8 and AVX-512 of 16; both round alike. Which rays part, wait and end, and in which
  // order their light adds up, must not depend on how many are looked at together. Embree's own code for
  // either may round otherwise and turn a path at an edge: a pixel in a hundred may differ.
  const std::vector<Isa> isas = test::offered_isas();
  const auto offered = [&](Isa isa) { return std::find(isas.begin(), isas.end(), isa) != isas.end(); };
  if (!offered(Isa::avx2) || !offered(Isa::avx512)) GTEST_SKIP() << "this CPU has only one of them";
  const Scene scene = balls();
  const auto render = [&](Isa isa) {
    RenderSettings settings = test::planar_settings();
    settings.isa = isa;
    return test::render(scene, test::single_view(160, 160, 25, 25), settings, test::sample_from({0, 0, 0}));
  };
  const RenderedFrame narrow = render(Isa::avx2), wide = render(Isa::avx512);
  int different = 0;
  test::for_each_pixel(narrow.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    different += pixel != test::pixel_at(wide.viewports[0], x, y);
  });
  EXPECT_LE(different, 160 * 160 / 100);
  const auto rays = static_cast<double>(narrow.counters.rays[RayKind::refraction]);
  EXPECT_GT(rays, 10000);
  EXPECT_NEAR(static_cast<double>(wide.counters.rays[RayKind::refraction]), rays, 0.001 * rays);
}

TEST(GlassPathsTest, GlassElsewhereDoesNotChangeAMirror) {
  // The same mirror bounce, whether or not the frame knows how to follow light through glass.
  Scene scene;
  test::add(scene, test::floor_quad(9, -1), test::matte({0.6f, 0.5f, 0.3f}));
  test::add(scene, test::sphere({-0.7f, 0, -4}, 0.6f), perfect_mirror());
  test::add(scene, test::sphere({0.7f, 0, -4}, 0.6f), perfect_mirror());
  scene.lights = {test::light_at({1, 3, -2}, glm::vec3{9.0f}, {0.5f, 0.1f, 0.5f})};
  scene.environment = {0.3f, 0.5f, 0.8f};
  scene.ambient = glm::vec3{0.2f};
  Scene with_glass = scene;
  test::add(with_glass, test::sphere({0, -50, 0}, 0.2f), test::clear_glass());  // under the floor
  const auto render = [](const Scene& of) {
    return test::render(of, test::single_view(96, 96, 25, 25), test::planar_settings(),
                        test::sample_from({0, 0, 0}));
  };
  const RenderedFrame without = render(scene), with = render(with_glass);
  EXPECT_GT(without.counters.rays[RayKind::mirror], 500);
  EXPECT_EQ(with.counters.rays[RayKind::refraction], 0);
  test::expect_same_bits(without, with);
}

}  // namespace
}  // namespace herr
