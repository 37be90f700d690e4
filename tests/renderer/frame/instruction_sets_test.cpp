// Every instruction set of this CPU renders the same scene, within what rounding explains.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

Scene scene_of_everything() {
  Scene scene;
  TextureImage texture;
  texture.width_px = texture.height_px = 16;
  for (int i = 0; i < 256; ++i) {
    texture.rgba.insert(texture.rgba.end(),
                        {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), 128, 255});
  }
  scene.textures.push_back(texture);
  Material textured = test::matte(glm::vec3{1.0f});
  textured.base_colour_texture = 0;
  Material mirror = test::matte({0.9f, 0.8f, 0.7f});
  mirror.metallic = 1;
  mirror.roughness = 0.3f;
  mirror.mirror = 0.6f;
  test::add(scene, test::floor_quad(5, -1), textured);
  test::add(scene, test::sphere({0.6f, 0, -3}, 0.8f), mirror);
  test::add(scene, test::box({-1.5f, -1, -3}, {-0.5f, 0.3f, -2}), test::matte({0.3f, 0.5f, 0.2f}));
  test::add(scene, test::quad({-5, -1, -6}, {10, 0, 0}, {0, 6, 0}), test::matte(glm::vec3{0.5f}), true);
  scene.lights = {test::light_at({1, 3, -1}, {20, 15, 10}, {0.4f, 0.1f, 0.4f})};
  scene.ambient = glm::vec3{0.1f};
  scene.environment = glm::vec3{0.3f};
  return scene;
}

RenderedFrame render_with_isa(Isa isa, int samples = 8, int first_samples = 0) {
  RenderSettings settings = test::small_settings();
  settings.polar_width = settings.polar_height = 128;
  settings.light_samples = samples;
  settings.adaptive_min_samples = first_samples;
  settings.isa = isa;
  return test::render(scene_of_everything(), test::small_profile(128, 160, 96), settings,
                      test::sample_from({0.05, 0.1, 0.2}, test::gaze_deg(4, -6)));
}

double relative_difference(const test::Pixel& a, const test::Pixel& b) {
  double worst = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    worst = std::max(worst, std::abs(a[c] - b[c]) / std::max({std::abs(a[c]), std::abs(b[c]), 0.01}));
  }
  return worst;
}

// Whole blocks decide, whatever the width of vectors. A ray that grazes an edge may turn the decision of a
// block, 16 hits of 28 rays at most: of 300,000 rays one in a thousand.
TEST(InstructionSetsTest, DecideAlikeWhereLightSamplesAreAdaptive) {
  const std::vector<Isa> isas = test::offered_isas();
  const RenderedFrame first = render_with_isa(isas.front(), 64, 4);
  const auto rays = static_cast<double>(first.counters.rays[RayKind::shadow]);
  for (const Isa isa : isas) {
    SCOPED_TRACE(name_of(isa));
    const RenderedFrame frame = render_with_isa(isa, 64, 4);
    EXPECT_NEAR(static_cast<double>(frame.counters.rays[RayKind::shadow]), rays, 1e-3 * rays);
    int pixels = 0, other = 0;
    for (std::size_t v = 0; v < frame.viewports.size(); ++v) {
      test::for_each_pixel(first.viewports[v], [&](int x, int y, const test::Pixel& pixel) {
        ++pixels;
        other += relative_difference(pixel, test::pixel_at(frame.viewports[v], x, y)) > 0.01 ? 1 : 0;
      });
    }
    EXPECT_LE(other, pixels / 200);
  }
}

TEST(InstructionSetsTest, RenderTheSamePictureWithinRounding) {
  const std::vector<Isa> isas = test::offered_isas();
  const RenderedFrame first = render_with_isa(isas.front());
  for (const Isa isa : isas) {
    SCOPED_TRACE(name_of(isa));
    const RenderedFrame frame = render_with_isa(isa);
    EXPECT_EQ(frame.counters.invalid_rays, 0);
    test::expect_finite(frame);
    // Rays that graze an edge may hit on one side or the other: a ray count may change by its share of rays
    // that pass within float rounding (1e-6 of the view) of an edge: far below 1e-4, or a single ray or two.
    const auto alike = [](std::int64_t a, std::int64_t b) {
      return std::abs(static_cast<double>(a - b)) <= std::max(2.0, 1e-4 * static_cast<double>(a));
    };
    EXPECT_TRUE(alike(first.counters.rays[RayKind::primary], frame.counters.rays[RayKind::primary]));
    EXPECT_TRUE(alike(first.counters.rays[RayKind::mirror], frame.counters.rays[RayKind::mirror]));
    EXPECT_TRUE(alike(first.counters.rays[RayKind::shadow], frame.counters.rays[RayKind::shadow]));
    EXPECT_TRUE(
        alike(first.counters.rays[RayKind::mirror_shadow], frame.counters.rays[RayKind::mirror_shadow]));
    EXPECT_TRUE(
        alike(first.counters.rays[RayKind::catcher_shadow], frame.counters.rays[RayKind::catcher_shadow]));

    std::vector<double> differences;
    for (std::size_t i = 0; i < frame.viewports.size(); ++i) {
      test::for_each_pixel(frame.viewports[i], [&](int x, int y, const test::Pixel& pixel) {
        differences.push_back(relative_difference(pixel, test::pixel_at(first.viewports[i], x, y)));
      });
    }
    std::sort(differences.begin(), differences.end());
    const double p95 = differences[differences.size() * 95 / 100],
                 p999 = differences[differences.size() * 999 / 1000];
    std::cout << name_of(isa) << ": relative difference p95 " << p95 << ", p99.9 " << p999 << ", max "
              << differences.back() << "\n";
    // A texel's half is rounded once (2^-11) and the result once more; float differences before that are far
    // smaller. Two half steps in 95 % of pixels; edges and highlights may differ by a sample.
    EXPECT_LE(p95, 2 * 0x1p-10);
    EXPECT_LE(p999, 0.05);
  }
}

TEST(InstructionSetsTest, AreNamedAndResolved) {
  EXPECT_STREQ(name_of(Isa::sse4), "sse4");
  EXPECT_STREQ(name_of(Isa::avx2), "avx2");
  EXPECT_STREQ(name_of(Isa::avx512), "avx512");
  const Isa best = resolve_isa(Isa::best);
  EXPECT_NE(best, Isa::best);
  EXPECT_EQ(best, test::offered_isas().back());
  EXPECT_EQ(resolve_isa(Isa::sse4), Isa::sse4);
  Scene scene;
  RenderSettings settings = test::small_settings();
  EXPECT_EQ(Renderer(scene, test::small_profile(), settings, false).settings().isa, best);
}

}  // namespace
}  // namespace herr
