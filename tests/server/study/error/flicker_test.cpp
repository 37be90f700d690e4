// Changes from frame to frame of clips made by hand.
#include "server/study/error/flicker.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/server/study/error/error_pictures.h"

namespace herr {
namespace {

struct Clip {
  std::vector<ViewportMap> maps = test::maps_of(test::plain_profile(8, 4, 2, 1), test::gaze_at(0));
  FlickerSum sum;

  void add(float of_test, float of_reference) {
    sum.add(maps, test::pictures_of(maps, of_test), test::pictures_of(maps, of_reference));
  }
};

TEST(FlickerTest, AConstantOffsetHasNone) {
  Clip clip;
  EXPECT_FALSE(clip.sum.flicker().has_value());
  clip.add(0.75f, 0.25f);
  EXPECT_FALSE(clip.sum.flicker().has_value());
  clip.add(0.75f, 0.25f);
  const auto flicker = clip.sum.flicker();
  ASSERT_TRUE(flicker.has_value());
  for (const std::size_t band : {std::size_t{0}, kAllPixels}) {
    EXPECT_EQ(flicker->test[band], 0);
    EXPECT_EQ(flicker->reference[band], 0);
    EXPECT_EQ(flicker->excess[band], 0);
  }
  EXPECT_TRUE(std::isnan(flicker->test[1]));
}

TEST(FlickerTest, AnAlternatingOffsetHasItsStep) {
  Clip clip;
  for (int frame = 0; frame < 5; ++frame) clip.add(frame % 2 == 0 ? 0.5f : 0.625f, 0.25f);
  const auto flicker = clip.sum.flicker();
  EXPECT_EQ(flicker->test[kAllPixels], 0.125);
  EXPECT_EQ(flicker->reference[kAllPixels], 0);
  EXPECT_EQ(flicker->excess[kAllPixels], 0.125);
}

TEST(FlickerTest, WhatMovesInTheReferenceTooIsNoExcess) {
  Clip clip;
  // Steps 1/4, -1/2, 1/4: the mean square is 1/8. All are floats without rounding.
  for (const float light : {0.25f, 0.5f, 0.0f, 0.25f}) clip.add(light + 0.125f, light);
  const auto flicker = clip.sum.flicker();
  EXPECT_DOUBLE_EQ(flicker->test[kAllPixels], std::sqrt(0.125));
  EXPECT_DOUBLE_EQ(flicker->reference[kAllPixels], std::sqrt(0.125));
  EXPECT_EQ(flicker->excess[kAllPixels], 0);
}

TEST(FlickerTest, PixelsCountThatAreSeenInBothFramesInTheBandOfTheSecond) {
  Clip clip;
  clip.maps[0].band[0] = kNotSeen;
  clip.add(0, 0);
  clip.maps[0].band[0] = 0;
  clip.maps[0].band[1] = kNotSeen;
  clip.maps[0].band[2] = 3;
  auto pictures = test::pictures_of(clip.maps, 0);
  for (auto& plane : pictures[0].plane) {
    plane[0] = 1;    // was not seen
    plane[1] = 1;    // is not seen
    plane[2] = 0.5;  // counts in its own band, and as one of 30 pixels
  }
  clip.sum.add(clip.maps, pictures, test::pictures_of(clip.maps, 0));
  const auto flicker = clip.sum.flicker();
  EXPECT_EQ(flicker->test[0], 0);
  EXPECT_EQ(flicker->test[3], 0.5);
  EXPECT_DOUBLE_EQ(flicker->test[kAllPixels], std::sqrt(0.25 / 30));
}

TEST(FlickerTest, AFrameOfAnotherSizeIsRefused) {
  Clip clip;
  clip.add(0, 0);
  clip.maps = test::maps_of(test::plain_profile(4, 4, 2, 1), test::gaze_at(0));
  EXPECT_THROW(clip.add(0, 0), std::invalid_argument);
  EXPECT_THROW(clip.sum.add(clip.maps, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace herr
