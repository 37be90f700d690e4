// Means over seeds: chance alone is never called a difference, a difference always is.
#include "server/study/relations/light/seed_means.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace herr {
namespace {

constexpr std::size_t kSeeds = 16;

// Values about `mean`, each with a scatter of its own between 0.1 and 1, some of them as rare spikes.
SeedRows any_rows(std::mt19937& random, std::size_t values, double mean) {
  SeedRows rows(kSeeds, std::vector<float>(values));
  std::normal_distribution<double> normal;
  for (auto& row : rows) {
    for (std::size_t p = 0; p < values; ++p) {
      const double scatter = 0.1 + 0.9 * static_cast<double>(p) / static_cast<double>(values);
      const bool spikes = p % 4 == 1;  // 4 with probability 1/17, else -1/4: mean 0, variance 1
      const double deviate =
          spikes ? (std::uniform_int_distribution<int>(0, 16)(random) == 0 ? 4.0 : -0.25) : normal(random);
      row[p] = static_cast<float>(mean + scatter * deviate);
    }
  }
  return rows;
}

// One in 31,574 normal deviates lies above 4; 200 trials of each kind have none but once in 30.
TEST(SeedMeansTest, ChanceAloneStaysBelowFourStandardErrors) {
  std::mt19937 random(1);
  for (const std::size_t values : {1u, 3u, 30u, 300u}) {
    int beyond = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const SeedRows a = any_rows(random, values, 2), b = any_rows(random, values, 2);
      beyond += mean_difference(a, b, 0).worst() > 4 ? 1 : 0;
    }
    EXPECT_LE(beyond, 1) << values << " values, seed 1";
  }
}

// Each D_i has the difference b = 0.1 at every value and the variance s^2 = 2 of two rows of variance 1:
// <D_i, D_j> is K b^2 in the mean, of standard deviation s^2 sqrt(K + 2 K b^2 / s^2); the mean of 120 pairs
// scatters 1 / sqrt(120) as much but for what pairs share.
TEST(SeedMeansTest, ADifferenceGivesItsSizeOverTheStandardError) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  constexpr std::size_t kValues = 2000;
  const double z = 0.01 * std::sqrt(kValues) / 2 * std::sqrt(120.0);
  double sum = 0;
  constexpr int kTrials = 40;
  for (int trial = 0; trial < kTrials; ++trial) {
    SeedRows a(kSeeds, std::vector<float>(kValues)), b = a;
    for (std::size_t i = 0; i < kSeeds; ++i) {
      for (std::size_t p = 0; p < kValues; ++p) {
        // Up here, down there: the overall mean has none.
        a[i][p] = static_cast<float>(normal(random) + (p % 2 == 0 ? 0.1 : -0.1));
        b[i][p] = static_cast<float>(normal(random));
      }
    }
    const MeanDifference difference = mean_difference(a, b, 0);
    sum += difference.local;
    EXPECT_LT(difference.overall, 4);
  }
  // z = 2.45, its scatter 1.2 or so in each of 40 trials: 4 standard errors of their mean are 0.8.
  EXPECT_NEAR(sum / kTrials, z, 0.8);
}

// A difference of 5 % in one value of a hundred, of no more scatter than that.
TEST(SeedMeansTest, ALocalDifferenceIsFoundHoweverStrong) {
  std::mt19937 random(3);
  for (const float difference : {0.5f, 5.0f, 500.0f}) {
    SeedRows a = any_rows(random, 300, 2), b = any_rows(random, 300, 2);
    for (auto& row : a) {
      for (std::size_t p = 0; p < row.size(); p += 100) row[p] += 5 * difference;
    }
    EXPECT_GT(mean_difference(a, b, 0).local, 6) << difference;
  }
}

// Values of 2 differ by 2^-10 of themselves: less than 2^-9, more than 2^-11.
TEST(SeedMeansTest, WhatRoundingExplainsIsNoDifference) {
  const SeedRows a(kSeeds, std::vector<float>(50, 2 + 0x1p-9f)), b(kSeeds, std::vector<float>(50, 2.0f));
  EXPECT_EQ(mean_difference(a, b, 0x1p-9).worst(), 0);
  EXPECT_EQ(mean_difference(a, b, 0x1p-11).worst(), std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(mean_difference(a, b, 0).share, 0x1p-10);
}

TEST(SeedMeansTest, AValueThatIsNoNumberMakesTheResultNone) {
  SeedRows a(kSeeds, std::vector<float>(5, 1.0f)), b = a;
  a[3][2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(mean_difference(a, b, 0).local));
  EXPECT_TRUE(std::isnan(mean_difference(b, a, 0).overall));
}

// Rows of variance 9: sigma is 3, within 4 of the standard errors that are told.
TEST(SeedMeansTest, NoiseIsTheRootOfTheMeanVariance) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal(5, 3);
  SeedRows rows(kSeeds, std::vector<float>(200));
  for (auto& row : rows) {
    for (float& value : row) value = static_cast<float>(normal(random));
  }
  const SeedNoise noise = seed_noise(rows);
  EXPECT_NEAR(noise.sigma, 3, 4 * noise.standard_error);
  // The variance of 15 x 200 deviates scatters by sqrt(2 / 3000) of itself, the root by half of that.
  EXPECT_NEAR(noise.standard_error, 3 * 0.5 * std::sqrt(2.0 / 3000), 0.5 * 3 * 0.5 * std::sqrt(2.0 / 3000));
}

// Paulson's and Wallace's approximations, against the exact distributions.
TEST(SeedMeansTest, DeviatesAreAsLikelyAsThoseOfANormalDistribution) {
  const boost::math::normal normal;
  for (const double degrees : {1.0, 3.0, 30.0, 1000.0}) {
    const boost::math::fisher_f fisher(degrees, 15 * degrees);
    for (const double z : {0.5, 2.0, 4.0}) {
      const double tail = boost::math::cdf(boost::math::complement(normal, z));
      const double f = boost::math::quantile(boost::math::complement(fisher, tail));
      EXPECT_NEAR(normal_from_f(f, degrees, 15 * degrees), z, 0.1) << degrees << " degrees, " << z;
    }
  }
  const boost::math::students_t t15(15);
  for (const double t : {1.0, 3.0, 6.0}) {
    const double tail = boost::math::cdf(boost::math::complement(t15, t));
    EXPECT_NEAR(normal_from_t(t, 15), boost::math::quantile(boost::math::complement(normal, tail)), 0.02)
        << t;
  }
}

}  // namespace
}  // namespace herr
