// Context pixels that a focus viewport covers, left out: nothing that is seen changes, and rays are saved.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sessions/format/covered_by_focus.h"
#include "tests/renderer/busy_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

Viewport focus_deg(double left_deg, double right_deg, double blend_deg) {
  Viewport v = test::viewport_deg(Eye::left, 40, 40, left_deg, right_deg, -30, 30);
  v.focus = true;
  v.edge_blend_deg = blend_deg;
  return v;
}

DisplayProfile view_of(const std::vector<Viewport>& focus) {
  DisplayProfile profile = test::single_view(192, 192, 45, 45);
  profile.viewports.insert(profile.viewports.end(), focus.begin(), focus.end());
  return profile;
}

// Renders with and without covered pixels: all pixels that no focus viewport covers must be the same bits.
// Returns the primary rays that were saved.
std::int64_t expect_seen_pixels_same(const DisplayProfile& profile, RenderSettings settings) {
  const Scene scene = test::busy_scene();
  const FrameSample sample = test::sample_from({0, 0, 0});
  settings.covered_pixels = true;
  const RenderedFrame all = test::render(scene, profile, settings, sample);
  settings.covered_pixels = false;
  const RenderedFrame fewer = test::render(scene, profile, settings, sample);
  for (std::size_t i = 0; i < profile.viewports.size(); ++i) {
    const Viewport& v = profile.viewports[i];
    int wrong = 0;
    for (int y = 0; y < v.height_px; ++y) {
      for (int x = 0; x < v.width_px; ++x) {
        const double tan_x = v.tan_left + (x + 0.5) * (v.tan_right - v.tan_left) / v.width_px,
                     tan_y = v.tan_up - (y + 0.5) * (v.tan_up - v.tan_down) / v.height_px;
        if (covered_by_focus(profile, i, tan_x, tan_y)) continue;
        const std::uint16_t* a = all.viewports[i].row(y) + 4 * x;
        wrong += !std::equal(a, a + 4, fewer.viewports[i].row(y) + 4 * x);
      }
    }
    EXPECT_EQ(wrong, 0) << "viewport " << i;
  }
  return all.counters.rays[RayKind::primary] - fewer.counters.rays[RayKind::primary];
}

// Focus +-30 degrees less a blend of 1 degree is +-0.554 of tangents +-1. At scale 1 these are rays 43 ...
// 149 of 192, which hold the tiles of rays 64 ... 127 with two rays around them, 2 x 2 tiles; at 3/4 rays 33
// ... 111 of 144, which hold 64 ... 95 alone; at 1/2 rays 22 ... 74 of 96: 32 ... 63.
TEST(CoveredPixelsTest, WhatIsSeenStaysAndWholeTilesOfRaysAreSaved) {
  const DisplayProfile profile = view_of({focus_deg(-30, 30, 1)});
  RenderSettings settings = test::planar_settings();
  for (const ResampleFilter filter :
       {ResampleFilter::nearest, ResampleFilter::bilinear, ResampleFilter::bicubic}) {
    settings.filter = filter;
    for (const auto& [scale, tiles] : {std::pair{1.0, 4}, {0.75, 1}, {0.5, 1}}) {
      SCOPED_TRACE(scale);
      settings.scale = scale;
      EXPECT_EQ(expect_seen_pixels_same(profile, settings), tiles * 32 * 32);
    }
  }
}

TEST(CoveredPixelsTest, WhatIsLeftOutIsBlack) {
  RenderSettings settings = test::planar_settings();
  settings.covered_pixels = false;
  const RenderedFrame frame = test::render(test::busy_scene(), view_of({focus_deg(-30, 30, 1)}), settings,
                                           test::sample_from({0, 0, 0}));
  for (int y = 64; y < 128; ++y) {
    for (int x = 64; x < 128; ++x) {
      EXPECT_EQ(test::pixel_at(frame.viewports[0], x, y), (test::Pixel{0, 0, 0, 1}));
    }
  }
}

// Two focus viewports with a gap between them: corners of a tile lie in both, its middle in neither. Of rays
// 62 ... 98 (tangents -0.354 ... 0.021) the gap takes -0.2 ... -0.14.
TEST(CoveredPixelsTest, AGapBetweenTwoFocusViewportsIsSeen) {
  const auto degrees = [](double tangent) { return std::atan(tangent) * kDegreesPerRadian; };
  const DisplayProfile profile =
      view_of({focus_deg(degrees(-0.9), degrees(-0.2), 0.1), focus_deg(degrees(-0.14), degrees(0.6), 0.1)});
  // Left of it tiles of rays 32 ... 63 lie within the one (tangents -0.9 ... -0.2 are rays 9.6 ... 76.8),
  // right of it those of rays 96 ... 127 within the other (82.6 ... 153.6), by two rows.
  EXPECT_EQ(expect_seen_pixels_same(profile, test::planar_settings()), 4 * 32 * 32);
}

TEST(CoveredPixelsTest, ThatOfTheOtherEyeCoversNothing) {
  Viewport focus = focus_deg(-30, 30, 1);
  focus.eye = Eye::right;
  EXPECT_EQ(expect_seen_pixels_same(view_of({focus}), test::planar_settings()), 0);
}

TEST(CoveredPixelsTest, WithFoveationTheyChangeNothing) {
  const DisplayProfile profile = view_of({focus_deg(-30, 30, 1)});
  RenderSettings settings = test::small_settings();
  const RenderedFrame all = test::render(test::busy_scene(), profile, settings, test::sample_from({0, 0, 0}));
  settings.covered_pixels = false;
  const RenderedFrame fewer =
      test::render(test::busy_scene(), profile, settings, test::sample_from({0, 0, 0}));
  test::expect_same_bits(all, fewer);
  EXPECT_EQ(all.counters.rays[RayKind::primary], fewer.counters.rays[RayKind::primary]);
}

}  // namespace
}  // namespace herr
