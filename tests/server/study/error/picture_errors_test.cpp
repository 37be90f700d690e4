// Errors of tiny pictures against sums done by hand, and what counts in them.
#include "server/study/error/picture_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <iostream>
#include <stdexcept>

#include "server/study/error/flip.h"
#include "server/study/error/high_percentile.h"
#include "tests/server/study/error/error_pictures.h"

namespace herr {
namespace {

// Two pixels whose middles lie at tangents of -1/2 and 1/2 on the axis, the gaze at the left one: 0 and
// 2 atan(1/2) = 53.13 degrees, the first band and the last.
struct TwoPixels {
  std::vector<ViewportMap> maps =
      test::maps_of(test::plain_profile(2, 1, 45, 45), test::gaze_at(-26.56505117707799));
  std::vector<LinearPicture> reference = test::pictures_of(maps, 0), pictures;

  TwoPixels() {
    for (std::size_t c = 0; c < 3; ++c) reference[0].plane[c] = {0.5f, 0};
    pictures = reference;
    pictures[0].plane[0][0] = 0.6f;
    pictures[0].plane[1][1] = 0.3f;
  }
  ErrorTable errors() const { return picture_errors(maps, pictures, reference, test::on_threads(1)); }
};

// Values are sums of a few floats: each is right to 2^-24 of 1, differences of 0.1 to 1e-6 of themselves, and
// their squares to 2e-6.
constexpr double kFloats = 2e-6;

TEST(PictureErrorsTest, OfTwoPixelsAreTheSumsByHand) {
  const ErrorTable table = TwoPixels().errors();
  // Squares 0.01 and 0.09 of 6 values.
  EXPECT_NEAR(table.at(Metric::rmse), std::sqrt(0.1 / 6), kFloats);
  EXPECT_NEAR(table.at(Metric::relative_mse), (0.01 / 0.26 + 0.09 / 0.01) / 6, 9 * kFloats);
  EXPECT_NEAR(table.at(Metric::largest), 0.3, kFloats);
  EXPECT_NEAR(table.at(Metric::p99_9), 0.3, kFloats);      // rank ceil(1.998) = 2 of 2
  EXPECT_NEAR(table.at(Metric::psnr_db), 17.78151, 1e-4);  // -10 log10(1 / 60)
}

TEST(PictureErrorsTest, EachBandHasItsOwnPixels) {
  const ErrorTable table = TwoPixels().errors();
  EXPECT_NEAR(table.at(Metric::rmse, 0), std::sqrt(0.01 / 3), kFloats);
  EXPECT_NEAR(table.at(Metric::rmse, 4), std::sqrt(0.09 / 3), kFloats);
  EXPECT_NEAR(table.at(Metric::relative_mse, 0), 0.01 / 0.26 / 3, kFloats);
  EXPECT_NEAR(table.at(Metric::largest, 0), 0.1, kFloats);
  EXPECT_NEAR(table.at(Metric::p99_9, 4), 0.3, kFloats);
  for (const std::size_t band : {1u, 2u, 3u}) {
    for (const double value : table.value[band]) EXPECT_TRUE(std::isnan(value));
  }
}

TEST(PictureErrorsTest, AcuityWeighsBySamplesOfTheEye) {
  // Pixels of 45 degrees: the low-pass leaves them. Both have one solid angle, so weights are as the squares
  // of the limits: ((53.13010 + 2.3) / 2.3)^2 = 580.80 to 1.
  const ErrorTable table = TwoPixels().errors();
  EXPECT_NEAR(table.at(Metric::acuity_rmse), std::sqrt((580.80 * 0.01 + 0.09) / 3 / 581.80), 1e-6);
  EXPECT_NEAR(table.at(Metric::acuity_rmse, 4), std::sqrt(0.09 / 3), kFloats);
}

TEST(PictureErrorsTest, FlipIsTheMeanOfItsMapOverTheBand) {
  const TwoPixels two;
  std::vector<float> map;
  flip_map(two.pictures[0], two.reference[0], two.maps[0].pixels_per_degree, test::on_threads(1), map);
  const ErrorTable table = two.errors();
  EXPECT_GT(map[0], 0);
  EXPECT_EQ(table.at(Metric::flip, 0), static_cast<double>(map[0]));
  EXPECT_EQ(table.at(Metric::flip, 4), static_cast<double>(map[1]));
  EXPECT_EQ(table.at(Metric::flip), (static_cast<double>(map[0]) + static_cast<double>(map[1])) / 2);
}

TEST(PictureErrorsTest, EqualPicturesHaveNoErrorAndNoSignalToNoise) {
  const std::vector<ViewportMap> maps = test::maps_of(test::tenth_profile(), test::gaze_at(5, 3));
  std::mt19937 random(1);
  const auto pictures = test::random_pictures(maps, random);
  const ErrorTable table = picture_errors(maps, pictures, pictures, test::on_threads(2));
  for (std::size_t band = 0; band < kBands; ++band) {
    for (std::size_t m = 0; m < kMetrics; ++m) {
      if (static_cast<Metric>(m) == Metric::psnr_db) {
        EXPECT_TRUE(std::isnan(table.value[band][m]));
      } else {
        EXPECT_EQ(table.value[band][m], 0) << metric_rows()[m].name << " of band " << band;
      }
    }
  }
}

TEST(PictureErrorsTest, HiddenPixelsDoNotCount) {
  const std::vector<ViewportMap> maps = test::maps_of(test::tenth_profile(), test::gaze_at(0));
  const auto reference = test::pictures_of(maps, 0.25f);
  auto pictures = reference;
  int hidden = 0;
  for (const std::size_t context : {0u, 2u}) {
    for (std::size_t i = 0; i < maps[context].band.size(); ++i) {
      if (maps[context].band[i] != kNotSeen) continue;
      pictures[context].plane[1][i] = 1;
      ++hidden;
    }
  }
  ASSERT_GT(hidden, 1000);
  ErrorTable table = picture_errors(maps, pictures, reference, test::on_threads(1));
  for (const Metric metric :
       {Metric::rmse, Metric::relative_mse, Metric::p99_9, Metric::largest, Metric::acuity_rmse})
    EXPECT_EQ(table.at(metric), 0) << metric_rows()[static_cast<std::size_t>(metric)].name;
  // One pixel that is seen, in the context's corner at 54 degrees.
  pictures[0].plane[2][0] = 0.75f;
  table = picture_errors(maps, pictures, reference, test::on_threads(1));
  EXPECT_EQ(table.at(Metric::largest), 0.5);
  EXPECT_EQ(table.at(Metric::largest, 4), 0.5);
  EXPECT_EQ(table.at(Metric::largest, 3), 0);
}

TEST(PictureErrorsTest, ThePercentileIsTheValueOfItsRank) {
  // 2000 pixels with 1/4000, 2/4000, ... in another order (7 has no divisor in common with 2000): rank
  // ceil(1998) holds 1998/4000.
  const std::vector<ViewportMap> maps = test::maps_of(test::plain_profile(100, 20, 1, 1), test::gaze_at(0));
  const auto reference = test::pictures_of(maps, 0);
  auto pictures = reference;
  for (std::size_t i = 0; i < 2000; ++i)
    pictures[0].plane[i % 3][i] = static_cast<float>(i * 7 % 2000 + 1) / 4000;
  const ErrorTable table = picture_errors(maps, pictures, reference, test::on_threads(1));
  EXPECT_EQ(table.at(Metric::p99_9), static_cast<double>(1998.0f / 4000));
  EXPECT_EQ(table.at(Metric::largest), 0.5);
}

TEST(PictureErrorsTest, ThePercentileIsThatOfAllValuesSorted) {
  const std::vector<ViewportMap> maps = test::maps_of(test::tenth_profile(), test::gaze_at(10, -4));
  const unsigned seed = 7;
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  std::vector<std::vector<float>> values;
  std::array<std::vector<float>, kBands> sorted;
  for (const ViewportMap& map : maps) {
    std::vector<float>& of_map = values.emplace_back();
    for (const std::uint8_t band : map.band) {
      // Small values crowd, and a quarter is 0, a quarter 1/64 sharp.
      const float u = test::unit_value(random);
      of_map.push_back(u < 0.25f ? 0 : u < 0.5f ? 1.0f / 64 : std::pow(2 * u - 1, 8.0f));
      if (band == kNotSeen) continue;
      sorted[band].push_back(of_map.back());
      sorted[kAllPixels].push_back(of_map.back());
    }
  }
  const auto found = high_percentiles(maps, values, test::on_threads(2));
  for (std::size_t band = 0; band < kBands; ++band) {
    ASSERT_FALSE(sorted[band].empty());
    std::sort(sorted[band].begin(), sorted[band].end());
    const auto rank = static_cast<std::size_t>(std::ceil(0.999 * static_cast<double>(sorted[band].size())));
    EXPECT_EQ(found[band], static_cast<double>(sorted[band][rank - 1])) << band;
  }
}

TEST(PictureErrorsTest, AreTheSameForAnyNumberOfThreadsBitForBit) {
  const std::vector<ViewportMap> maps = test::maps_of(test::tenth_profile(), test::gaze_at(-7, 2));
  const unsigned seed = 3;
  std::cout << "seed " << seed << "\n";
  std::mt19937 random(seed);
  const auto reference = test::random_pictures(maps, random), pictures = test::random_pictures(maps, random);
  const ErrorTable one = picture_errors(maps, pictures, reference, test::on_threads(1));
  for (const int threads : {2, 4}) {
    const ErrorTable table = picture_errors(maps, pictures, reference, test::on_threads(threads));
    for (std::size_t band = 0; band < kBands; ++band) {
      for (std::size_t m = 0; m < kMetrics; ++m) {
        EXPECT_FALSE(std::isnan(one.value[band][m]));
        EXPECT_EQ(std::bit_cast<std::uint64_t>(table.value[band][m]),
                  std::bit_cast<std::uint64_t>(one.value[band][m]))
            << metric_rows()[m].name << " of band " << band << " on " << threads << " threads";
      }
    }
  }
}

TEST(PictureErrorsTest, PicturesOfOtherSizesAreRefused) {
  TwoPixels two;
  two.pictures[0].width_px = 1;
  EXPECT_THROW(two.errors(), std::invalid_argument);
  two = {};
  two.reference[0].plane[2].pop_back();
  EXPECT_THROW(two.errors(), std::invalid_argument);
  two = {};
  two.pictures.push_back(two.pictures[0]);
  EXPECT_THROW(two.errors(), std::invalid_argument);
}

}  // namespace
}  // namespace herr
