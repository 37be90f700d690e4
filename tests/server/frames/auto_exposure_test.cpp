#include "server/frames/auto_exposure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/model/scene.h"
#include "server/output/srgb_table.h"

namespace herr {
namespace {

struct Patch {
  int pixels;
  float grey, coverage;
};

// One row of pixels, premultiplied as the renderer leaves them.
ViewportImage row_of(const std::vector<Patch>& patches) {
  ViewportImage image;
  image.height_px = 1;
  for (const Patch& patch : patches) {
    for (int i = 0; i < patch.pixels; ++i) {
      for (int c = 0; c < 3; ++c) image.rgba_half.push_back(half_from_float(patch.grey * patch.coverage));
      image.rgba_half.push_back(half_from_float(patch.coverage));
    }
    image.width_px += patch.pixels;
  }
  image.row_stride = static_cast<std::size_t>(image.width_px);
  return image;
}

DisplayProfile profile_of(const std::vector<bool>& focus) {
  DisplayProfile profile;
  for (const bool each : focus) {
    Viewport viewport;
    viewport.focus = each;
    profile.viewports.push_back(viewport);
  }
  return profile;
}

std::optional<double> ev_of(const std::vector<Patch>& patches) {
  return metered_ev({row_of(patches)}, profile_of({false}));
}

TEST(AutoExposure, BringsTheBrightEndToFourFifths) {
  // 95 of 100 pixels are grey 0.05, five are 500 times brighter: the value below which 95 % lie is 0.05, and
  // 2^ev = 0.8 / 0.05 = 16. The bins are 1/100 of a stop and 0.05 in half is 0.04999.
  EXPECT_NEAR(*ev_of({{95, 0.05f, 1}, {5, 25.0f, 1}}), 4.0, 0.015);
  // Six bright pixels are more than 5 %: 2^ev = 0.8 / 25.
  EXPECT_NEAR(*ev_of({{94, 0.05f, 1}, {6, 25.0f, 1}}), std::log2(0.8 / 25), 0.015);
}

TEST(AutoExposure, FollowsTheLightStopByStop) {
  // A thousand times the light: 10 stops (9.9658) less.
  const double dim = *ev_of({{60, 0.2f, 1}, {40, 0.6f, 1}}),
               bright = *ev_of({{60, 200.0f, 1}, {40, 600.0f, 1}});
  EXPECT_NEAR(dim - bright, std::log2(1000.0), 0.03);
}

TEST(AutoExposure, TakesColoursWithoutTheirCoverageAndNothingWhereNothingIs) {
  // A thin veil of grey 0.4 covers a tenth of each pixel; the feed's share says nothing about the scene.
  EXPECT_NEAR(*ev_of({{50, 0.4f, 0.1f}, {50, 0, 0}}), 1.0, 0.015);
  EXPECT_FALSE(ev_of({{50, 0, 0}}).has_value());
  EXPECT_FALSE(ev_of({{50, 0, 1}}).has_value());
}

TEST(AutoExposure, StaysWithinWhatHalfFloatsCarry) {
  // log2(0.8 / 60000) = -16.2 and log2(0.8 / 6e-8) = 23.7 lie outside.
  EXPECT_EQ(*ev_of({{50, 60000.0f, 1}}), -kMostExposure_ev);
  EXPECT_EQ(*ev_of({{50, 6e-8f, 1}}), kMostExposure_ev);
}

TEST(AutoExposure, ContextViewportsDecideWhereThereAreAny) {
  const std::vector<ViewportImage> pictures{row_of({{10, 0.4f, 1}}), row_of({{10, 0.1f, 1}})};
  EXPECT_NEAR(*metered_ev(pictures, profile_of({false, true})), 1.0, 0.015);
  EXPECT_NEAR(*metered_ev(pictures, profile_of({true, false})), 3.0, 0.015);
  // Both are focus viewports: the bright end of all is 0.4.
  EXPECT_NEAR(*metered_ev(pictures, profile_of({true, true})), 1.0, 0.015);
}

}  // namespace
}  // namespace herr
