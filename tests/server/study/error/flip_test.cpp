// The product's FLIP against slow code of the paper, and against answers that follow by hand.
#include "server/study/error/flip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "tests/server/study/error/flip_pictures.h"
#include "tests/server/study/error/slow_flip.h"

namespace herr {
namespace {

using slow_flip::Picture;

void flip_in_order(int count, const std::function<void(int)>& work) {
  for (int i = 0; i < count; ++i) work(i);
}

std::vector<float> product(const Picture& test, const Picture& reference, double pixels_per_degree) {
  std::vector<float> out;
  flip_map(slow_flip::linear(test), slow_flip::linear(reference), pixels_per_degree, flip_in_order, out);
  return out;
}

// Half a unit in the last place of a float is 6e-8 of a value. Lightness, of size 100, passes about ten
// roundings, 1e-5 of HyAB at random; where both colours are the same, the power 0.7 makes 3e-4 of it and the
// scale 0.95 / 16.5 a share of 2e-5, elsewhere less. Features are at most 1: ten roundings are 6e-7, whose
// root, where there is no other feature, is 7e-4; it moves e^(1 - f) by -e ln(e) of that, 0.37 at
// most: 2.4e-4. Both together stay below 1e-3. (Where features differ but colours are the same to six digits,
// the power 1 - f would make more of it; no pair has such a pixel.) Signs differ: the mean keeps 1e-4.
constexpr double kPixelTolerance = 1e-3, kMeanTolerance = 1e-4;

void expect_like_slow(const Picture& test, const Picture& reference, double pixels_per_degree) {
  const std::vector<double> slow = slow_flip::flip(test, reference, pixels_per_degree);
  const std::vector<float> fast = product(test, reference, pixels_per_degree);
  ASSERT_EQ(fast.size(), slow.size());
  double slow_sum = 0, fast_sum = 0, worst = 0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < slow.size(); ++i) {
    slow_sum += slow[i];
    fast_sum += static_cast<double>(fast[i]);
    const double off = std::abs(static_cast<double>(fast[i]) - slow[i]);
    if (off <= worst) continue;
    ASSERT_TRUE(std::isfinite(off)) << "pixel " << i;
    worst = off;
    at = i;
  }
  const auto width = static_cast<std::size_t>(test.width);
  EXPECT_LE(worst, kPixelTolerance) << "at column " << at % width << ", row " << at / width << ": "
                                    << fast[at] << ", slowly " << slow[at];
  const auto count = static_cast<double>(slow.size());
  EXPECT_NEAR(fast_sum / count, slow_sum / count, kMeanTolerance);
}

class FlipPairs : public testing::TestWithParam<double> {};

TEST_P(FlipPairs, EveryPixelIsThatOfThePaperWrittenSlowly) {
  for (const slow_flip::Pair& pair : slow_flip::pairs()) {
    SCOPED_TRACE(pair.name);
    expect_like_slow(pair.test, pair.reference, GetParam());
  }
}

// Below and above the resolutions of headsets; kernels of 2 to 9 pixels to each side.
INSTANTIATE_TEST_SUITE_P(PixelsPerDegree, FlipPairs, testing::Values(11.0, 22.0, 30.0, 60.0));

TEST(Flip, PicturesSmallerThanAKernelRepeatTheirBorders) {
  for (const auto& [width, height] : {std::pair{1, 1}, {5, 3}, {2, 40}, {33, 1}}) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    // 67.02: a monitor 0.7 m wide with 3840 pixels, seen from 0.7 m: the paper's own.
    expect_like_slow(slow_flip::noise(width, height, 1), slow_flip::noise(width, height, 5), 67.02);
  }
}

Picture plain(const glm::dvec3& colour) {
  return slow_flip::picture(24, 16, [&](double, double) { return colour; });
}

// Both programs, at every pixel.
void expect_everywhere(const Picture& test, const Picture& reference, double expected, double tolerance) {
  for (const double pixels_per_degree : {11.0, 60.0}) {
    for (const double value : slow_flip::flip(test, reference, pixels_per_degree)) {
      ASSERT_NEAR(value, expected, tolerance);
    }
    for (const float value : product(test, reference, pixels_per_degree)) {
      ASSERT_NEAR(value, expected, tolerance);
    }
  }
}

TEST(Flip, EqualPicturesDoNotDifferAnywhere) {
  for (const slow_flip::Pair& pair : slow_flip::pairs()) {
    SCOPED_TRACE(pair.name);
    for (const float value : product(pair.test, pair.test, 22.0)) ASSERT_EQ(value, 0.0f);
  }
}

// Plain pictures have no features, so the result is the colour's share alone. Green has CIELAB (87.735,
// -86.183, 83.179) and blue (32.297, 79.188, -107.860) (Lindbloom's tables, D65); Hunt's factor L / 100 makes
// (87.735, -75.612, 72.977) and (32.297, 25.575, -34.836). HyAB: 55.438 + hypot(101.187, 107.813) = 203.297;
// to the power 0.7: 41.275 = the largest, whose 0.4-fold is 16.510. The tables agree with exact
// chromaticities to 0.01: 5e-5 of a distance, less of a share.
constexpr double kShareTolerance = 1e-4;

TEST(Flip, GreenAgainstBlueIsTheLargestDifference) {
  expect_everywhere(plain({0, 1, 0}), plain({0, 0, 1}), 1.0, kShareTolerance);
}

TEST(Flip, BlackAgainstWhiteLiesInTheUpperRange) {
  // CIELAB (0, 0, 0) and (100, 0, 0): 100^0.7 = 25.119 > 16.510, so
  // 0.95 + 0.05 (25.119 - 16.510) / (41.275 - 16.510) = 0.96738.
  expect_everywhere(plain({0, 0, 0}), plain({1, 1, 1}), 0.96738, kShareTolerance);
}

TEST(Flip, BlackAgainstMiddleGreyLiesInTheLowerRange) {
  // L = 50 at (66 / 116)^3 of white: 50^0.7 = 15.462 < 16.510, so 0.95 * 15.462 / 16.510 = 0.88970.
  const double grey = std::pow(66.0 / 116, 3);
  expect_everywhere(plain({0, 0, 0}), plain(glm::dvec3{grey}), 0.88970, kShareTolerance);
}

// At 4 pixels per degree neighbours lie 0.25 degrees off: the achromatic filter gives them
// exp(-pi^2 0.25^2 / 0.0047) = 1e-57, so grey stays as it is, and the features' Gaussian (standard deviation
// 0.164 pixels) gives them exp(-1 / (2 * 0.164^2)) = 8e-9: only the row and the column of the middle count.
constexpr double kCoarse = 4.0;

TEST(Flip, AnEdgeThatIsMissingRaisesTheDifferenceBesideIt) {
  // Black against black with a white half. In the first white column the edge's weights of one sign see white
  // and the others black: a response of 1. The point's: half of its middle, 1/2. So the feature's share is
  // sqrt(1 / sqrt(2)) = 0.840896, and the colour's is that of black against white: 0.96738^0.159104 =
  // 0.99474.
  const Picture half =
      slow_flip::picture(24, 16, [](double x, double) { return glm::dvec3{x < 12 ? 0.0 : 1.0}; });
  const std::vector<float> map = product(half, plain({0, 0, 0}), kCoarse);
  for (int y = 0; y < 16; ++y) {
    EXPECT_NEAR(map[half.index(12, y)], 0.99474, kShareTolerance);
    for (int x = 0; x < 11; ++x) EXPECT_EQ(map[half.index(x, y)], 0.0f);
    for (int x = 13; x < 24; ++x) EXPECT_NEAR(map[half.index(x, y)], 0.96738, kShareTolerance);
  }
}

TEST(Flip, APointThatIsMissingDiffersFully) {
  // One white pixel: both second derivatives respond with the middle's weight, -1, so their length is
  // sqrt(2), the feature's share is 1, and any colour to the power 0 is 1.
  const Picture point =
      slow_flip::picture(24, 16, [](double x, double y) { return glm::dvec3{x == 9 && y == 5 ? 1.0 : 0.0}; });
  const std::vector<float> map = product(point, plain({0, 0, 0}), kCoarse);
  EXPECT_NEAR(map[point.index(9, 5)], 1.0, kShareTolerance);
  EXPECT_EQ(map[point.index(12, 5)], 0.0f);
}

TEST(Flip, DoesNotAskWhichOfTheTwoIsTheReference) {
  for (const slow_flip::Pair& pair : slow_flip::pairs()) {
    SCOPED_TRACE(pair.name);
    EXPECT_EQ(product(pair.test, pair.reference, 22.0), product(pair.reference, pair.test, 22.0));
  }
}

TEST(Flip, DoesNotDependOnTheOrderOfWorkAndKeepsItsStorage) {
  const slow_flip::Pair pair = slow_flip::pairs().front();
  const LinearPicture test = slow_flip::linear(pair.test), reference = slow_flip::linear(pair.reference);
  std::vector<float> out(2 * test.pixels(), -1.0f);
  const float* storage = out.data();
  flip_map(
      test, reference, 22.0,
      [](int count, const std::function<void(int)>& work) {
        for (int i = count - 1; i >= 0; --i) work(i);
      },
      out);
  EXPECT_EQ(out, product(pair.test, pair.reference, 22.0));
  EXPECT_EQ(out.data(), storage);
}

}  // namespace
}  // namespace herr
