// Ratios of pairs, with bounds worked out from the signed-rank test's table.
#include "server/study/statistics/paired_ratio.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace herr {
namespace {

// exp of an argument near 1 is exact to a unit in the last place or two.
constexpr double kRounding = 1e-14;

TEST(PairedRatioTest, SixPairsAreBoundedByTheOutermostOnes) {
  // All signs alike: 1 / 64 on each side, below 2.5 %, so the bounds are the smallest and the largest of the
  // 21 averages of two. The median of those averages of 1 ... 6 is 3.5 by symmetry.
  std::vector<double> ratios;
  for (const int i : {4, 1, 6, 2, 5, 3}) ratios.push_back(0.1 * i);
  const Interval ratio = paired_ratio(ratios);
  EXPECT_NEAR(ratio.estimate, std::exp(0.35), kRounding);
  EXPECT_NEAR(ratio.lower, std::exp(0.1), kRounding);
  EXPECT_NEAR(ratio.upper, std::exp(0.6), kRounding);
}

TEST(PairedRatioTest, TenPairsAreBoundedByTheNinthAverages) {
  // W+ of 10 pairs is 8 or less with 25 / 1024 = 0.0244 and 9 or less with 33 / 1024 (Wilcoxon's table: 8),
  // so the bounds are the 9th averages from either end. Of 1 ... 10 the averages are 1, 1.5, 2, 2, 2.5, 2.5,
  // 3, 3, 3, ...: the 9th is 3, and 8 from above.
  std::vector<double> ratios;
  for (int i = 1; i <= 10; ++i) ratios.push_back(0.01 * i);
  const Interval ratio = paired_ratio(ratios);
  EXPECT_NEAR(ratio.estimate, std::exp(0.055), kRounding);
  EXPECT_NEAR(ratio.lower, std::exp(0.03), kRounding);
  EXPECT_NEAR(ratio.upper, std::exp(0.08), kRounding);
}

TEST(PairedRatioTest, FivePairsNeverAreThatSure) {
  // All signs alike happens once in 32 by chance on each side, more than 2.5 %.
  const Interval ratio = paired_ratio(std::vector<double>{0.2, 0.2, 0.2, 0.2, 0.2});
  EXPECT_NEAR(ratio.estimate, std::exp(0.2), kRounding);
  EXPECT_TRUE(std::isinf(ratio.lower) && ratio.lower < 0);
  EXPECT_TRUE(std::isinf(ratio.upper) && ratio.upper > 0);
}

TEST(PairedRatioTest, NoPairsHaveNoRatio) {
  const Interval ratio = paired_ratio({});
  EXPECT_TRUE(std::isnan(ratio.estimate));
  EXPECT_TRUE(std::isinf(ratio.lower) && ratio.lower < 0);
  EXPECT_TRUE(std::isinf(ratio.upper) && ratio.upper > 0);
}

TEST(PairedRatioTest, TheFirstFiftyCount) {
  std::vector<double> ratios(50, 0.5);
  ratios.resize(120, 9.0);
  const Interval ratio = paired_ratio(ratios);
  EXPECT_NEAR(ratio.estimate, std::exp(0.5), kRounding);
  EXPECT_NEAR(ratio.upper, std::exp(0.5), kRounding);
}

TEST(PairedRatioTest, RefusesARatioThatIsNotFinite) {
  EXPECT_THROW(paired_ratio(std::vector<double>{0.1, std::nan("")}), std::invalid_argument);
}

}  // namespace
}  // namespace herr
