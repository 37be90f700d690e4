// The exact rank tests behind `herr check` against published examples, published tables and counting by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "server/check/statistics/rank_counts.h"
#include "server/check/statistics/rank_sum.h"
#include "server/check/statistics/signed_rank.h"

namespace herr {
namespace {

constexpr double kTail = 0.05;
constexpr double kRounding = 1e-12;  // sums of at most 2^30 whole numbers, one division
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(SignedRank, AgreesWithDarwinsMaize) {
  // Cross- minus self-fertilised heights, in eighths of an inch (Fisher, The Design of Experiments, 1935).
  // The negative ones have ranks 14 and 10: W+ = 120 - 24 = 96. Published two-sided p: 0.04126.
  const std::vector<double> inches{49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};
  EXPECT_NEAR(2 * signed_rank_shift(inches, kTail).p, 0.04126, 0.5e-5);
}

TEST(SignedRank, AgreesWithThePatientsOfHollanderAndWolfe) {
  // Depression before and after a tranquilliser (Nonparametric Statistical Methods, 1973, p. 29):
  // V = 40, p = 0.01953; the estimate of the shift is 0.46.
  const std::array<double, 9> before{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
  const std::array<double, 9> after{0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
  std::vector<double> differences;
  for (std::size_t i = 0; i < 9; ++i) differences.push_back(before[i] - after[i]);
  const Shift shift = signed_rank_shift(differences, kTail);
  EXPECT_NEAR(shift.p, 0.01953, 0.5e-5);
  EXPECT_NEAR(shift.estimate, 0.46, 0.5e-2);
}

TEST(RankSum, AgreesWithThePlacentasOfHollanderAndWolfe) {
  // Permeability at term and at 12 to 26 weeks (p. 69): W = 35, p = 0.1272; the estimate is 0.305.
  const std::vector<double> term{0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
  const std::vector<double> earlier{1.15, 0.88, 0.90, 0.74, 1.21};
  const Shift shift = rank_sum_shift(term, earlier, kTail);
  EXPECT_NEAR(shift.p, 0.1272, 0.5e-4);
  EXPECT_NEAR(shift.estimate, 0.305, kRounding);
}

TEST(SignedRank, HasTheCriticalValuesOfThePublishedTable) {
  // Largest T with P(T) <= 0.025 in one tail, n = 6 ... 30 (Wilcoxon, Katti & Wilcox, 1970).
  const std::array<int, 25> critical{0,  2,  3,  5,  8,  10, 13, 17, 21,  25,  29,  34, 40,
                                     46, 52, 58, 65, 73, 81, 89, 98, 107, 116, 126, 137};
  for (std::size_t i = 0; i < critical.size(); ++i) {
    std::vector<int> ranks(i + 6);
    std::iota(ranks.begin(), ranks.end(), 1);
    const RankCounts counts = RankCounts::of_subsets(ranks);
    EXPECT_LE(counts.share_to(critical[i]), 0.025) << "n = " << ranks.size();
    EXPECT_GT(counts.share_to(critical[i] + 1), 0.025) << "n = " << ranks.size();
  }
}

TEST(RankSum, HasTheCriticalValuesOfThePublishedTable) {
  // Largest U with P(U) <= 0.025 in one tail (Mann & Whitney's table as in Siegel, 1956): {n, m, U}.
  for (const auto& [n, m, u] : {std::array{5, 5, 2}, {8, 8, 13}, {10, 10, 23}, {10, 20, 55}, {20, 20, 127}}) {
    std::vector<int> ranks(static_cast<std::size_t>(n + m));
    std::iota(ranks.begin(), ranks.end(), 1);
    const RankCounts counts = RankCounts::of_subsets(ranks, static_cast<std::size_t>(n));
    const int smallest = n * (n + 1) / 2;
    EXPECT_LE(counts.share_to(smallest + u), 0.025) << n << ", " << m;
    EXPECT_GT(counts.share_to(smallest + u + 1), 0.025) << n << ", " << m;
  }
}

// The share of all 2^n choices of signs whose sum of positive ranks is at least the observed one.
double p_by_counting_signs(const std::vector<double>& differences) {
  std::vector<double> sizes;
  double observed = 0;
  for (const double d : differences) sizes.push_back(std::abs(d));
  const auto rank = [&](std::size_t i) {
    double below = 0, alike = 0;
    for (const double other : sizes) below += other < sizes[i], alike += other == sizes[i];
    return below + (alike + 1) / 2;
  };
  for (std::size_t i = 0; i < sizes.size(); ++i) observed += differences[i] > 0 ? rank(i) : 0;
  int as_large = 0;
  for (unsigned signs = 0; signs < 1u << sizes.size(); ++signs) {
    double sum = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) sum += (signs >> i & 1u) != 0 ? rank(i) : 0;
    as_large += sum >= observed;
  }
  return as_large / std::pow(2.0, static_cast<double>(sizes.size()));
}

TEST(SignedRank, EqualsCountingEverySignWithTiesAsWell) {
  constexpr unsigned kSeed = 20210207;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> few(1, 5);
  std::bernoulli_distribution sign(0.7);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> differences;
    for (int i = 0; i < 9; ++i) differences.push_back(few(random) * (sign(random) ? 1 : -1));
    EXPECT_NEAR(signed_rank_shift(differences, kTail).p, p_by_counting_signs(differences), kRounding)
        << "seed " << kSeed << ", trial " << trial;
  }
}

TEST(RankSum, EqualsCountingEveryChoiceWithTiesAsWell) {
  constexpr unsigned kSeed = 20210208;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> few(1, 6);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> all(9);
    for (double& x : all) x = few(random);
    // Wins of the chosen four over the other five, ties half: Mann and Whitney's own count.
    const auto wins = [&](unsigned chosen) {
      double sum = 0;
      for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t j = 0; j < 9; ++j) {
          if ((chosen >> i & 1u) == 0 || (chosen >> j & 1u) != 0) continue;
          sum += all[i] > all[j] ? 1.0 : all[i] == all[j] ? 0.5 : 0.0;
        }
      }
      return sum;
    };
    int choices = 0, as_large = 0;
    for (unsigned chosen = 0; chosen < 1u << 9; ++chosen) {
      if (std::popcount(chosen) != 4) continue;
      ++choices;
      as_large += wins(chosen) >= wins(0b1111);
    }
    const std::span<const double> now(all.data(), 4), before(all.data() + 4, 5);
    EXPECT_NEAR(rank_sum_shift(now, before, kTail).p, static_cast<double>(as_large) / choices, kRounding)
        << "seed " << kSeed << ", trial " << trial;
  }
}

TEST(SignedRank, BoundsAreTheAveragesThatTheTestLeavesOutside) {
  // n = 5: W+ = 0 has 1 of 32 choices, W+ <= 1 has 2. With tail 0.05 no more than the largest average may lie
  // outside; with tail 0.03 five pairs are never that sure.
  const std::vector<double> differences{1, 2, 3, 4, 5};
  const Shift shift = signed_rank_shift(differences, 0.05);
  EXPECT_EQ(shift.estimate, 3);
  EXPECT_EQ(shift.lower, 1);
  EXPECT_EQ(shift.upper, 5);
  EXPECT_EQ(signed_rank_shift(differences, 0.03).upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(signed_rank_shift(differences, 0.03).lower, -std::numeric_limits<double>::infinity());
}

TEST(SignedRank, UpperBoundIsTooLowNoMoreOftenThanPromised) {
  // Each of the 2^n signs of distances around a true middle of 0 is as likely: the bound lies below 0 in
  // exactly P(W+ < quantile) of them. n = 10: P(W+ <= 10) = 43 / 1024, the largest below 0.05.
  std::vector<double> distances(10);
  for (std::size_t i = 0; i < 10; ++i) distances[i] = std::pow(1.7, static_cast<double>(i));
  int below = 0;
  for (unsigned signs = 0; signs < 1u << 10; ++signs) {
    std::vector<double> differences = distances;
    for (std::size_t i = 0; i < 10; ++i) differences[i] *= (signs >> i & 1u) != 0 ? 1 : -1;
    below += signed_rank_shift(differences, 0.05).upper < 0;
  }
  EXPECT_EQ(below, 43);
}

TEST(SignedRank, LeavesPairsWithoutDifferenceOutOfTheTest) {
  EXPECT_EQ(signed_rank_shift(std::vector<double>{0, 0, 0}, kTail).p, 1);
  // Three positive ones: 1 of 8 choices.
  EXPECT_EQ(signed_rank_shift(std::vector<double>{1, 0, 2, 0, 3}, kTail).p, 0.125);
}

TEST(SignedRank, RefusesWhatIsMissing) {
  EXPECT_THROW(signed_rank_shift(std::vector<double>{}, kTail), std::invalid_argument);
  EXPECT_THROW(signed_rank_shift(std::vector<double>{1, kNan}, kTail), std::invalid_argument);
  EXPECT_THROW(signed_rank_shift(std::vector<double>(51, 1.0), kTail), std::invalid_argument);
}

TEST(RankSum, RefusesWhatIsMissing) {
  const std::vector<double> one{1}, none, unknown{kNan};
  EXPECT_THROW(rank_sum_shift(none, one, kTail), std::invalid_argument);
  EXPECT_THROW(rank_sum_shift(one, none, kTail), std::invalid_argument);
  EXPECT_THROW(rank_sum_shift(one, unknown, kTail), std::invalid_argument);
}

}  // namespace
}  // namespace herr
