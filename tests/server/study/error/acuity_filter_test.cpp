// What the low-pass at the eye's limit leaves of patterns, against the transform of a Gaussian.
#include "server/study/error/acuity_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numbers>

#include "tests/server/study/error/error_pictures.h"

namespace herr {
namespace {

TEST(AcuityFilterTest, TheLimitIsThatOfGeislerAndPerry) {
  // 2.3 * ln 64 / (0.106 * (e + 2.3)): 9.565431 / 0.2438 and / 4.4838.
  EXPECT_NEAR(finest_visible_cycles_per_deg(0), 39.23475, 1e-4);
  EXPECT_NEAR(finest_visible_cycles_per_deg(40), 2.133331, 1e-5);
  // One square degree, 78.4695^2 samples.
  EXPECT_NEAR(acuity_weight(0, std::numbers::pi * std::numbers::pi / 32400), 6157.46, 0.05);
}

// The pixel in a picture that lies nearest to (right_deg, up_deg) on the axes, by tangents.
std::size_t pixel_at(const Viewport& v, double right_deg, double up_deg = 0) {
  const double x =
      (std::tan(right_deg * std::numbers::pi / 180) - v.tan_left) / (v.tan_right - v.tan_left) * v.width_px;
  const double y =
      (v.tan_up - std::tan(up_deg * std::numbers::pi / 180)) / (v.tan_up - v.tan_down) * v.height_px;
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(v.width_px) + static_cast<std::size_t>(x);
}

TEST(AcuityFilterTest, ACheckerboardFadesAtFortyDegreesAndNotAtTheGaze) {
  // At the gaze a pixel of the focus viewport (0.033 degrees and more) is larger than what the Gaussian sees.
  // At 40 degrees columns of the context take 0.116 cos^2 = 0.068 degrees, sigma is 0.0878 degrees or 1.29
  // columns, and half a cycle per pixel has exp(-2 (pi 0.5 sigma)^2) = 3e-4 along rows alone.
  const DisplayProfile profile = xr1_half_profile();
  std::array<double, 2> squares{};
  for (const std::size_t viewport : {0u, 1u}) {
    const ViewportMap map = viewport_map(profile, viewport, test::gaze_at(0));
    LinearPicture picture = test::picture_of(map, 0);
    for (auto& plane : picture.plane) {
      for (std::size_t i = 0; i < plane.size(); ++i) {
        const std::size_t x = i % static_cast<std::size_t>(map.width_px);
        plane[i] = (x + i / static_cast<std::size_t>(map.width_px)) % 2 == 0 ? 0.1f : -0.1f;
      }
    }
    low_pass_at_acuity(map, picture, test::on_threads(2));
    const auto left = static_cast<double>(
        picture.plane[1][pixel_at(profile.viewports[viewport], viewport == 0 ? 40 : 0.02)]);
    squares[viewport] = left * left;
  }
  EXPECT_LT(squares[0], 0.01 * squares[1]);
  EXPECT_GT(squares[1], 0.9 * 0.01);  // sigma below 0.145 pixels: narrower than the narrowest Gaussian
}

// What is left of the amplitude of a grating of `share` of the eye's limit at 40 degrees, along rows or
// columns. The viewport looks straight ahead, 0.025 degrees per pixel; the gaze lies 40 degrees across the
// grating.
double amplitude_left(double share, bool along_rows) {
  constexpr int kSize = 401;  // a pixel in the middle
  const DisplayProfile profile = test::plain_profile(kSize, kSize, 5, 5);
  const ViewportMap map = viewport_map(profile, 0, along_rows ? test::gaze_at(0, 40) : test::gaze_at(40));
  const double cycles_per_px = share * finest_visible_cycles_per_deg(40) * 2 *
                               profile.viewports[0].tan_right / kSize * 180 / std::numbers::pi;
  LinearPicture picture = test::picture_of(map, 0);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double phase = 2 * std::numbers::pi * cycles_per_px * ((along_rows ? x : y) - kSize / 2);
      for (auto& plane : picture.plane)
        plane[static_cast<std::size_t>(y * kSize + x)] = static_cast<float>(std::cos(phase));
    }
  }
  low_pass_at_acuity(map, picture, test::on_threads(2));
  return static_cast<double>(picture.plane[2][static_cast<std::size_t>(kSize * (kSize / 2) + kSize / 2)]);
}

TEST(AcuityFilterTest, AGratingOfTheLimitIsHalvedAndOneOfAQuarterStays) {
  for (const bool along_rows : {true, false}) {
    // A Gaussian leaves 2^(-share^2). Its width is right to 1/256, so the exponent to 1/128 (0.3 % of the
    // half); cutting it at 3 sigma changes the transform by 0.3 % at most.
    EXPECT_NEAR(amplitude_left(1, along_rows), 0.5, 0.006) << along_rows;
    const double quarter = amplitude_left(0.25, along_rows);
    EXPECT_NEAR(quarter, std::exp2(-1.0 / 16), 0.006) << along_rows;
    EXPECT_GE(quarter, 0.9) << along_rows;
    EXPECT_NEAR(amplitude_left(2, along_rows), 1.0 / 16, 0.006) << along_rows;
  }
}

TEST(AcuityFilterTest, AConstantStaysAndHiddenPixelsHaveNoSay) {
  const DisplayProfile profile = xr1_half_profile();
  const ViewportMap map = viewport_map(profile, 0, test::gaze_at(-30));
  LinearPicture picture = test::picture_of(map, 0.25f);
  for (std::size_t i = 0; i < map.band.size(); ++i) {
    if (map.band[i] == kNotSeen) picture.plane[0][i] = 1000;
  }
  low_pass_at_acuity(map, picture, test::on_threads(2));
  // Two means of up to 30 floats each: sums round by 30 * 2^-24 of themselves at most.
  float farthest = 0;
  for (std::size_t i = 0; i < map.band.size(); ++i) {
    for (const auto& plane : picture.plane)
      farthest = std::max(farthest, std::abs(plane[i] - (map.band[i] == kNotSeen ? 0.0f : 0.25f)));
  }
  EXPECT_LE(farthest, 0.25f * 2 * 2 * 30 * 0x1p-24f);
}

TEST(AcuityFilterTest, OneAndFourThreadsGiveTheSameBits) {
  const unsigned seed = 5;
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  const std::vector<ViewportMap> maps = test::maps_of(xr1_half_profile(), test::gaze_at(-20, 10));
  auto one = test::random_pictures(maps, random);
  auto four = one;
  for (std::size_t v = 0; v < 2; ++v) {
    low_pass_at_acuity(maps[v], one[v], test::on_threads(1));
    low_pass_at_acuity(maps[v], four[v], test::on_threads(4));
    EXPECT_TRUE(one[v].plane == four[v].plane) << v;
  }
}

}  // namespace
}  // namespace herr
