// What pixels are to the eye, against angles worked out by hand.
#include "server/study/error/viewport_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "tests/server/study/error/error_pictures.h"

namespace herr {
namespace {

TEST(ViewportMapTest, APixelsAnglesAreThoseOfItsMiddleAndItsEdges) {
  // Two by two pixels over +-45 degrees: middles at tangents of +-1/2.
  const ViewportMap map = viewport_map(test::plain_profile(2, 2, 45, 45), 0, test::gaze_at(0));
  for (std::size_t i = 0; i < 4; ++i) {
    // atan(sqrt(1/4 + 1/4)); a pixel of area 1 at cosine (1 + 1/2)^(-1/2). Floats: 1e-5 of the value.
    EXPECT_NEAR(map.eccentricity_deg[i], 35.26439, 35e-5);
    EXPECT_NEAR(map.solid_angle_sr[i], 0.5443311, 5e-6);
    // From (0, 1/2, -1) to (1, 1/2, -1): cosine 1.25 / (sqrt(1.25) * 1.5) = 0.745356.
    EXPECT_NEAR(map.degrees_per_column[i], 41.81031, 42e-5);
    EXPECT_NEAR(map.degrees_per_row[i], 41.81031, 42e-5);
  }
  EXPECT_DOUBLE_EQ(map.pixels_per_degree, 2.0 / 90);
}

TEST(ViewportMapTest, SmallPixelsTakeTheDerivativeOfTheAngle) {
  // d(angle) / d(tan) = 1 / (1 + tan^2) on the axis; 901 columns so that one middle lies on it. A step of
  // h = 2 / 901 has an angle that is smaller by h^2 / 12 = 4e-7 at most: floats decide, 1e-6.
  const ViewportMap map = viewport_map(test::plain_profile(901, 901, 45, 45), 0, test::gaze_at(0));
  const double step_deg = 2.0 / 901 * 180 / std::numbers::pi;
  for (const std::size_t x : {0u, 200u, 450u, 900u}) {
    const double tan = (static_cast<double>(x) - 450) * 2 / 901;
    const std::size_t i = 450 * 901 + x;
    EXPECT_NEAR(map.degrees_per_column[i] / (step_deg / (1 + tan * tan)), 1, 1e-6) << x;
    // Across the way from the middle: divided by the distance sqrt(1 + tan^2).
    EXPECT_NEAR(map.degrees_per_row[i] / (step_deg / std::sqrt(1 + tan * tan)), 1, 1e-6) << x;
  }
}

TEST(ViewportMapTest, RowsBeginAtTheTopAndColumnsAtTheLeft) {
  const DisplayProfile profile = test::plain_profile(3, 3, 45, 45);
  const auto nearest = [&](const glm::dvec3& gaze) {
    const ViewportMap map = viewport_map(profile, 0, gaze);
    return std::min_element(map.eccentricity_deg.begin(), map.eccentricity_deg.end()) -
           map.eccentricity_deg.begin();
  };
  EXPECT_EQ(nearest(test::gaze_at(0, 30)), 1);
  EXPECT_EQ(nearest(test::gaze_at(0, -30)), 7);
  EXPECT_EQ(nearest(test::gaze_at(-30, 0)), 3);
  EXPECT_EQ(nearest(test::gaze_at(30, 0)), 5);
}

TEST(ViewportMapTest, BandsBeginWhereTheySay) {
  // A single pixel straight ahead: its eccentricity is the gaze's angle.
  const DisplayProfile profile = test::plain_profile(1, 1, 1, 1);
  const auto band_at_gaze = [&](double deg) { return viewport_map(profile, 0, test::gaze_at(deg)).band[0]; };
  const double borders[] = {5, 15, 30, 45};
  for (std::uint8_t b = 0; b < 4; ++b) {
    EXPECT_EQ(band_at_gaze(borders[b] - 0.001), b);
    EXPECT_EQ(band_at_gaze(borders[b] + 0.001), b + 1);
    EXPECT_EQ(bands()[b].to_deg, borders[b]);
    EXPECT_EQ(bands()[b + 1u].from_deg, borders[b]);
  }
  EXPECT_EQ(band_at_gaze(0), 0);
  EXPECT_EQ(band_at_gaze(180), 4);
  EXPECT_STREQ(bands()[kAllPixels].name, "all");
}

double solid_angle(const ViewportMap& map) {
  return std::accumulate(map.solid_angle_sr.begin(), map.solid_angle_sr.end(), 0.0);
}

TEST(ViewportMapTest, SolidAnglesAddUpToThatOfTheRectangle) {
  // 4 atan(a b / sqrt(1 + a^2 + b^2)) for half sides a, b at distance 1. The midpoint rule errs by
  // h^2 / 24 * 3 * area along each axis at most, as 3 is the largest second derivative of cos^3: 2e-6 of the
  // context's 2.1 sr with h = 2 / 990, less for the focus.
  const DisplayProfile profile = xr1_half_profile();
  EXPECT_NEAR(solid_angle(viewport_map(profile, 0, test::gaze_at(0))), 4 * std::atan(1 / std::sqrt(3.0)),
              4e-6);
  const double a = profile.viewports[1].tan_right, b = profile.viewports[1].tan_up;
  EXPECT_NEAR(solid_angle(viewport_map(profile, 1, test::gaze_at(0))),
              4 * std::atan(a * b / std::sqrt(1 + a * a + b * b)), 1e-6);
}

TEST(ViewportMapTest, WhatTheFocusHidesIsNotSeen) {
  const DisplayProfile profile = xr1_half_profile();
  // Hidden: |tan x| below tan 19 degrees = 0.34433, 170.4 of 495 columns; middles lie at 1/2: 170 to each
  // side. |tan y| below tan 10.57 degrees = 0.18660, 92.4 rows: 92.
  for (const std::size_t context : {0u, 2u}) {
    const ViewportMap map = viewport_map(profile, context, test::gaze_at(20));
    EXPECT_EQ(std::count(map.band.begin(), map.band.end(), kNotSeen), 340 * 184);
    EXPECT_EQ(map.band[495 * 990 + 495], kNotSeen);
    EXPECT_EQ(viewport_map(profile, context + 1, test::gaze_at(20)).pixels_per_degree, 30);
    EXPECT_NEAR(map.pixels_per_degree, 11, 1e-12);
  }
  const ViewportMap focus = viewport_map(profile, 1, test::gaze_at(0));
  EXPECT_EQ(std::count(focus.band.begin(), focus.band.end(), kNotSeen), 0);
}

}  // namespace
}  // namespace herr
