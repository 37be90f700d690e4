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

TEST(AutoExposure, BringsTheBrightEndToNineTenths) {
  // The pixel at 0.99 of the way from the darkest to the brightest of 200 is the 198th (of 0 ... 199:
  // 197.01): two of 200 may be brighter. 2^ev = 0.9 / 0.05; 0.05 in half is 0.04999, a ten-thousandth of a
  // stop off.
  EXPECT_NEAR(*ev_of({{198, 0.05f, 1}, {2, 25.0f, 1}}), std::log2(0.9 / 0.05), 0.006);
  EXPECT_NEAR(*ev_of({{190, 0.05f, 1}, {10, 25.0f, 1}}), std::log2(0.9 / 25), 0.006);
}

TEST(AutoExposure, FollowsTheLightStopByStop) {
  // A thousand times the light: log2(1000) stops less, rounded to 1/100 twice.
  const double dim = *ev_of({{60, 0.2f, 1}, {40, 0.6f, 1}}),
               bright = *ev_of({{60, 200.0f, 1}, {40, 600.0f, 1}});
  EXPECT_NEAR(dim - bright, std::log2(1000.0), 0.011);
}

TEST(AutoExposure, TakesColoursWithoutTheirCoverageAndNothingWhereNothingIs) {
  // A thin veil of grey 0.45 covers a tenth of each pixel; the feed's share says nothing about the scene.
  EXPECT_NEAR(*ev_of({{50, 0.45f, 0.1f}, {50, 0, 0}}), 1.0, 0.011);
  EXPECT_FALSE(ev_of({{50, 0, 0}}).has_value());
  EXPECT_FALSE(ev_of({{50, 0, 1}}).has_value());
}

TEST(AutoExposure, StaysWithinWhatHalfFloatsCarry) {
  // log2(0.9 / 60000) = -16.02 and log2(0.9 / 6e-8) = 23.8 lie outside.
  EXPECT_EQ(*ev_of({{50, 60000.0f, 1}}), -kMostExposure_ev);
  EXPECT_EQ(*ev_of({{50, 6e-8f, 1}}), kMostExposure_ev);
}

TEST(AutoExposure, ContextViewportsDecideWhereThereAreAny) {
  const std::vector<ViewportImage> pictures{row_of({{10, 0.45f, 1}}), row_of({{10, 0.1125f, 1}})};
  EXPECT_NEAR(*metered_ev(pictures, profile_of({false, true})), 1.0, 0.006);
  EXPECT_NEAR(*metered_ev(pictures, profile_of({true, false})), 3.0, 0.006);
  // Both are focus viewports: the bright end of all is 0.45.
  EXPECT_NEAR(*metered_ev(pictures, profile_of({true, true})), 1.0, 0.006);
}

}  // namespace
}  // namespace herr
