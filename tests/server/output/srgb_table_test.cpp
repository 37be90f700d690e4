#include "server/output/srgb_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "sessions/camera/half_from_samples.h"
#include "tests/server/output/pictures.h"

namespace herr {
namespace {

TEST(SrgbTable, MatchesPublishedValuesOfTheStandard) {
  // IEC 61966-2-1: 0.0031308 is the end of the linear part (12.92 * 0.0031308 = 0.04045); 0.5 encodes to
  // 0.73536, 0.18 to 0.46136 (both in the literature to five digits).
  EXPECT_NEAR(srgb_from_linear(0.0031308), 0.040450, 1e-6);
  EXPECT_NEAR(srgb_from_linear(0.5), 0.735357, 1e-6);
  EXPECT_NEAR(srgb_from_linear(0.18), 0.461356, 1e-6);
  EXPECT_EQ(srgb_from_linear(1.0), 1.055 - 0.055);
  EXPECT_EQ(srgb_from_linear(-1.0), 0.0);
}

TEST(SrgbTable, EveryEightBitValueSurvivesDecodingAndEncoding) {
  // A half has 11 bits of precision: half a unit in the last place is 2^-12 of the value, at most
  // 255 * 2^-12 / 2.4 = 0.026 of an 8-bit step on the power part: never enough to change the rounding.
  for (int value = 0; value < 256; ++value) {
    const double linear = linear_from_srgb(value / 255.0);
    EXPECT_EQ(srgb8_of_half()[half_from_float(static_cast<float>(linear))], value);
  }
}

TEST(SrgbTable, IsMonotonicOverAllPositiveHalves) {
  for (std::uint32_t bits = 1; bits < 0x7C01; ++bits) {
    ASSERT_GE(srgb8_of_half()[bits], srgb8_of_half()[bits - 1]) << bits;
  }
}

TEST(SrgbTable, ClampsWhatLiesOutsideAndShowsNanAsBlack) {
  EXPECT_EQ(srgb8_of_half()[half_from_float(-2.0f)], 0);
  EXPECT_EQ(srgb8_of_half()[half_from_float(40000.0f)], 255);
  EXPECT_EQ(srgb8_of_half()[0x7C00], 255);  // +Inf
  EXPECT_EQ(srgb8_of_half()[0xFC00], 0);    // -Inf
  EXPECT_EQ(srgb8_of_half()[0x7E00], 0);    // NaN
}

TEST(SrgbTable, AnExposureMultipliesBeforeTheCurve) {
  // 0.125 at +2 EV is 0.5, which encodes to 187.516; at 0 EV 0.125 encodes to 255 * 0.388573 = 99.09.
  EXPECT_EQ(srgb8_of_half(4.0f)[half_from_float(0.125f)], 188);
  EXPECT_EQ(srgb8_of_half(1.0f)[half_from_float(0.125f)], 99);
  // A lamp of 54351 cd at -16 EV would be 0.83: beyond what 16 bits lose, the table multiplies in double.
  EXPECT_EQ(srgb8_of_half(std::exp2(-15.0f))[half_from_float(16384.0f)], 188);
}

TEST(SrgbPicture, AlphaIsUnassociatedAndColoursAreDividedByIt) {
  ViewportImage image;
  image.width_px = image.height_px = 1;
  image.row_stride = 1;
  // Premultiplied 0.25 at coverage 0.5: the object's colour is 0.5, which encodes to 255 * 0.735357 = 187.5
  // -> the exact product is 187.516, rounded 188; coverage is 127.5, rounded away from zero to 128.
  image.rgba_half = {half_from_float(0.25f), half_from_float(0.25f), half_from_float(0.25f),
                     half_from_float(0.5f)};
  Srgb8Image out;
  srgb8_from_viewport(image, true, out);
  EXPECT_EQ(out.values, (std::vector<std::uint8_t>{188, 188, 188, 128}));
  // Without alpha: over black, so 0.25 encodes to 255 * 0.537099 = 136.96.
  srgb8_from_viewport(image, false, out);
  EXPECT_EQ(out.values, (std::vector<std::uint8_t>{137, 137, 137}));
}

TEST(SrgbPicture, CountsNanAndInfButNotTheGarbageBetweenRows) {
  ViewportImage image = random_picture(7, 5, 1);
  Srgb8Image out;
  srgb8_from_viewport(image, false, out);
  EXPECT_EQ(out.nonfinite_values, 0);
  image.row(2)[4 * 3 + 1] = 0x7E00;
  image.row(4)[4 * 6 + 3] = 0x7C00;
  srgb8_from_viewport(image, false, out);
  EXPECT_EQ(out.nonfinite_values, 2);
  srgb8_from_viewport(image, true, out);
  EXPECT_EQ(out.nonfinite_values, 2);
}

// Whole pixels count, once each, and by what is shown: at -1 EV white is 2.
TEST(SrgbPicture, CountsPixelsThatEightBitsCannotShow) {
  ViewportImage image;
  image.resize(9, 1);
  const auto set = [&](int x, float r, float g, float b, float alpha) {
    std::uint16_t* texel = image.row(0) + 4 * x;
    for (const float value : {r, g, b, alpha}) *texel++ = half_from_float(value);
  };
  set(0, 1, 1, 1, 1);       // white itself
  set(1, 1.001f, 0, 0, 1);  // the next half above it is 1 + 2^-10
  set(2, 3, 3, -1, 1);      // once, whatever the channels
  set(3, -0.0f, 0, 0, 1);   // no less than 0
  set(4, 0, -4e-4f, 0, 1);
  set(5, 0.75f, 0, 0, 0.5f);  // 1.5 where alpha counts
  set(6, 1.5f, 0, 0, 1);
  set(7, NAN, 5, 0, 1);  // a fault, counted as such
  // A step of 8 bits is 1 / 255 of the code, 12.92 times the value near black: 3.04e-4.
  set(8, -1.5e-4f, -6e-8f, 0, 1);
  Srgb8Image out;
  srgb8_from_viewport(image, false, out);
  EXPECT_EQ(out.clipped_pixels, 4) << "1, 2, 4 and 6";
  srgb8_from_viewport(image, true, out);
  EXPECT_EQ(out.clipped_pixels, 5) << "and 5";
  image.exposure = 0.5f;
  srgb8_from_viewport(image, true, out);
  EXPECT_EQ(out.clipped_pixels, 2) << "2 and 4";
  EXPECT_EQ(out.nonfinite_values, 1);
  image.exposure = 2;
  srgb8_from_viewport(image, false, out);
  EXPECT_EQ(out.clipped_pixels, 7) << "all but 3, which is 0, and 7: pixel 8 is -3e-4 as shown";
}

// White of a camera feed is 1 / exposure in the picture, rounded to a half.
TEST(SrgbPicture, WhiteOfAFeedIsNotClippedAtAnyExposure) {
  for (int i = -800; i <= 800; ++i) {
    const float exposure = std::exp2(static_cast<float>(i) / 100);
    EXPECT_LE(half_from_float(1 / exposure), white_half(exposure)) << exposure;
    EXPECT_GT(half_from_float(1.002f / exposure), white_half(exposure)) << exposure;
  }
}

TEST(SrgbPicture, NoCoverageIsTransparentBlack) {
  ViewportImage image;
  image.width_px = image.height_px = 1;
  image.row_stride = 1;
  image.rgba_half = {0, 0, 0, 0};
  Srgb8Image out;
  srgb8_from_viewport(image, true, out);
  EXPECT_EQ(out.values, (std::vector<std::uint8_t>{0, 0, 0, 0}));
}

}  // namespace
}  // namespace herr
