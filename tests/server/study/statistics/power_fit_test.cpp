// Power laws that are known: exact ones, one worked out by hand, and noisy ones, of which the intervals must
// hold the truth as often as they say.
#include "server/study/statistics/power_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace herr {
namespace {

constexpr std::uint64_t kSeed = 20230517;
constexpr int kSets = 500;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Law {
  double floor = 0, c = 1, p = -0.5;
};

std::vector<double> doubled_from(double first, int count) {
  std::vector<double> n;
  for (int i = 0; i < count; ++i) n.push_back(std::ldexp(first, i));
  return n;
}

std::vector<double> errors_of(const Law& law, const std::vector<double>& n) {
  std::vector<double> errors;
  for (const double x : n) errors.push_back(law.floor + law.c * std::pow(x, law.p));
  return errors;
}

// Normal noise by Box and Muller from the bits of the generator: the same on any machine.
double normal(std::mt19937_64& random) {
  const auto unit = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  const double radius = std::sqrt(-2 * std::log(unit()));
  return radius * std::cos(2 * std::acos(-1.0) * unit());
}

// How many of kSets noisy copies of a law (5 % log-normal) leave a fit that `holds`.
int count_noisy(const Law& law, int points, bool with_floor,
                const std::function<bool(const PowerFit&)>& holds) {
  const std::vector<double> n = doubled_from(1, points);
  std::mt19937_64 random(kSeed);
  int count = 0;
  for (int i = 0; i < kSets; ++i) {
    std::vector<double> errors = errors_of(law, n);
    for (double& error : errors) error *= std::exp(0.05 * normal(random));
    const auto fit = fit_power(n, errors, with_floor);
    count += fit && holds(*fit);
  }
  std::cout << "seed " << kSeed << ": " << count << " of " << kSets << "\n";
  return count;
}

bool holds_truth(const Interval& interval, double truth) {
  return interval.lower <= truth && truth <= interval.upper;
}

TEST(PowerFitTest, ExactLawsComeBackToAMillionth) {
  for (const double p : {-2.0, -1.0, -0.503, -0.25, 0.0, 0.7, 3.0}) {
    for (const double c : {1e-12, 1.0, 1e9}) {
      const std::vector<double> n = doubled_from(0.5, 8);
      const auto fit = fit_power(n, errors_of({0, c, p}, n), false);
      ASSERT_TRUE(fit);
      EXPECT_NEAR(fit->p.estimate, p, 1e-6);
      EXPECT_NEAR(fit->c / c, 1, 1e-6);
      EXPECT_EQ(fit->floor.estimate, 0);
      EXPECT_EQ(fit->points, 8);
      // Nothing but rounding is left, so the intervals close up.
      EXPECT_LT(fit->relative_rms, 1e-12);
      EXPECT_NEAR(fit->p.lower, p, 1e-6);
      EXPECT_NEAR(fit->p.upper, p, 1e-6);
    }
  }
}

TEST(PowerFitTest, ExactLawsWithAFloorComeBackToAMillionth) {
  // Of the last one only a thousandth is no floor.
  for (const Law& law : {Law{0.02, 1, -0.5}, Law{0.3, 2, -1.37}, Law{5e-7, 1e-3, -2}, Law{1, 1e-3, -0.8}}) {
    const std::vector<double> n = doubled_from(1, 9);
    const auto fit = fit_power(n, errors_of(law, n), true);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->p.estimate, law.p, 1e-6);
    EXPECT_NEAR(fit->floor.estimate / law.floor, 1, 1e-6);
    EXPECT_NEAR(fit->c / law.c, 1, 1e-6);
    EXPECT_NEAR(fit->floor.lower / law.floor, 1, 1e-6);
    EXPECT_NEAR(fit->floor.upper / law.floor, 1, 1e-6);
  }
}

TEST(PowerFitTest, AnExactLawWithoutFloorHasNone) {
  const std::vector<double> n = doubled_from(1, 9);
  const auto fit = fit_power(n, errors_of({0, 3, -0.75}, n), true);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->p.estimate, -0.75, 1e-6);
  EXPECT_EQ(fit->floor.lower, 0);
  EXPECT_LT(fit->floor.upper, 1e-6);
}

TEST(PowerFitTest, TwoErrorsAtEachOfTwoPointsAreWhatPaperSays) {
  // With two n the law passes through the best value m of each: of errors e1, e2 the one that makes
  // (m / e1 - 1)^2 + (m / e2 - 1)^2 least is m = (1/e1 + 1/e2) / (1/e1^2 + 1/e2^2), and 2 - (1/e1 + 1/e2)^2 /
  // (1/e1^2 + 1/e2^2) is left. Errors 1 and 1.25: m = 1.8 / 1.64, left 2 - 3.24 / 1.64. At n = 4 they are
  // half as large, so p = log(1/2) / log 4 = -1/2.
  const std::vector<double> n{1, 1, 4, 4}, errors{1, 1.25, 0.5, 0.625};
  const auto fit = fit_power(n, errors, false);
  ASSERT_TRUE(fit);
  const double share = 3.24 / 1.64, least = 2 * (2 - share);
  // A least value is found to the root of the rounding of sums, 1e-8.
  EXPECT_NEAR(fit->p.estimate, -0.5, 1e-7);
  EXPECT_NEAR(fit->c, 1.8 / 1.64, 1e-7);
  EXPECT_NEAR(fit->relative_rms, std::sqrt(least / 4), 1e-12);
  // A p that is off by log(s) / log 4 makes the second pair's value s times too large; with the best c the
  // sum is 4 - share (1 + s)^2 / (1 + s^2). Student's t of 2 degrees of freedom: t^2 / (2 + t^2) = 0.95^2.
  // Where the sum is least (1 + t^2 / 2), s + 1 / s = 2 / (q - 1) with q = (4 - limit) / share.
  const double limit = least * (1 + 0.9025 / 0.0975), q = (4 - limit) / share;
  const double s = (1 + std::sqrt(1 - (q - 1) * (q - 1))) / (q - 1);
  EXPECT_NEAR(fit->p.upper, -0.5 + std::log(s) / std::log(4), 1e-7);
  EXPECT_NEAR(fit->p.lower, -0.5 - std::log(s) / std::log(4), 1e-7);
}

TEST(PowerFitTest, APowerThatNoBoundHoldsIsUnbounded) {
  // As above with errors 1 and 2: share = 2.25 / 1.25 = 1.8, least = 0.4, and the limit of 0.4 * 10.26 = 4.1
  // is more than the 4 of a law that misses everything.
  const auto fit = fit_power(std::vector<double>{1, 1, 4, 4}, std::vector<double>{1, 2, 0.5, 1}, false);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->p.estimate, -0.5, 1e-7);
  EXPECT_EQ(fit->p.lower, -kInfinity);
  EXPECT_EQ(fit->p.upper, kInfinity);
}

TEST(PowerFitTest, EqualErrorsDoNotFall) {
  const std::vector<double> n = doubled_from(1, 6), errors(6, 0.3);
  const auto plain = fit_power(n, errors, false);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->p.estimate, 0);
  EXPECT_NEAR(plain->c, 0.3, 1e-15);
  EXPECT_NEAR(plain->p.lower, 0, 1e-6);
  EXPECT_NEAR(plain->p.upper, 0, 1e-6);
  // A floor alone fits with any p, and p = 0 with any floor up to the error.
  const auto floored = fit_power(n, errors, true);
  ASSERT_TRUE(floored);
  EXPECT_EQ(floored->p.estimate, 0);
  EXPECT_EQ(floored->p.lower, -kInfinity);
  EXPECT_EQ(floored->p.upper, kInfinity);
  EXPECT_EQ(floored->floor.estimate, 0);
  EXPECT_EQ(floored->floor.lower, 0);
  EXPECT_NEAR(floored->floor.upper, 0.3, 1e-6);
}

TEST(PowerFitTest, NoiseAloneBoundsNoPower) {
  // Errors that go up and down by 5 % about a floor: the floor alone leaves 6 * 0.05^2 = 0.015. A law beside
  // it can remove one point's share at an end, which leaves more than 1 / 4.4 of that, and the limit is 4.4
  // times what is left (t of 3 degrees of freedom: 3.18).
  const auto fit =
      fit_power(doubled_from(1, 6), std::vector<double>{1.05, 0.95, 1.05, 0.95, 1.05, 0.95}, true);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->p.lower, -kInfinity);
  EXPECT_EQ(fit->p.upper, kInfinity);
  EXPECT_GT(fit->floor.upper, 1);
}

TEST(PowerFitTest, ThePowerHolds95OfHundredTimes) {
  // Of 500 sets 475 +- 4.9 hold a truth that is held with 95 %: 460 ... 490 is 3.1 deviations, which one seed
  // of 500 misses.
  // Without floor any p has the same residuals, so other numbers of points try more than other powers.
  for (const int points : {4, 8, 16}) {
    const int held = count_noisy({0, 1, -0.5}, points, false,
                                 [](const PowerFit& fit) { return holds_truth(fit.p, -0.5); });
    EXPECT_GE(held, 460);
    EXPECT_LE(held, 490);
  }
}

TEST(PowerFitTest, PowerAndFloorHold95OfHundredTimesWhereBothAreSeen) {
  // Errors from 1.1 to 0.101, so that the floor never reaches 0, where its interval would be cut off. 460 ...
  // 490 as above.
  const Law law{0.1, 1, -1};
  const int p_held =
      count_noisy(law, 11, true, [&](const PowerFit& fit) { return holds_truth(fit.p, law.p); });
  EXPECT_GE(p_held, 460);
  EXPECT_LE(p_held, 490);
  const int floor_held =
      count_noisy(law, 11, true, [&](const PowerFit& fit) { return holds_truth(fit.floor, law.floor); });
  EXPECT_GE(floor_held, 460);
  EXPECT_LE(floor_held, 490);
}

TEST(PowerFitTest, AFloorIsFoundWhereThereIsOne) {
  // The last four errors are 0.108 ... 0.101 and would fall to an eighth without floor: noise of 5 % does not
  // hide that.
  EXPECT_EQ(count_noisy({0.1, 1, -1}, 11, true, [](const PowerFit& fit) { return fit.floor.lower > 0; }),
            kSets);
}

TEST(PowerFitTest, AFloorIsSeldomFoundWhereThereIsNone) {
  // A floor is never negative, so only the upper half of the 5 % errs: 487.5 +- 3.5 of 500 begin at 0, 3.1
  // deviations below are 477.
  EXPECT_GE(count_noisy({0, 1, -0.5}, 9, true, [](const PowerFit& fit) { return fit.floor.lower == 0; }),
            477);
}

// The least sum of squared relative residuals with this floor, by trying p in steps of a thousandth.
double sum_with_floor(const std::vector<double>& n, const std::vector<double>& errors, double floor) {
  double least = kInfinity;
  for (int step = -8000; step <= 8000; ++step) {
    double by_target = 0, squares = 0, sum = 0;
    for (std::size_t i = 0; i < n.size(); ++i) {
      const double power = std::pow(n[i], 0.001 * step) / errors[i];
      by_target += power * (1 - floor / errors[i]);
      squares += power * power;
    }
    const double c = std::max(0.0, by_target / squares);
    for (std::size_t i = 0; i < n.size(); ++i) {
      const double residual = (floor + c * std::pow(n[i], 0.001 * step)) / errors[i] - 1;
      sum += residual * residual;
    }
    least = std::min(least, sum);
  }
  return least;
}

TEST(PowerFitTest, BoundsOfAFloorAreWhereItsBestFitIsAtTheLimit) {
  // 1 / n + 0.1 with up to 4 % added or taken; t of 3 degrees of freedom is 3.182446 (Student's table). A
  // thousandth of p changes residuals by 0.003 at most, next to 0.04.
  const std::vector<double> n = doubled_from(1, 6);
  const std::vector<double> errors{1.1 * 1.03,   0.6 * 0.97,    0.35 * 1.02,
                                   0.225 * 1.03, 0.1625 * 0.96, 0.13125 * 1.01};
  const auto fit = fit_power(n, errors, true);
  ASSERT_TRUE(fit);
  const double least = 6 * fit->relative_rms * fit->relative_rms,
               limit = least * (1 + 3.182446 * 3.182446 / 3);
  EXPECT_NEAR(sum_with_floor(n, errors, fit->floor.estimate) / least, 1, 0.01);
  ASSERT_GT(fit->floor.lower, 0);
  EXPECT_GT(sum_with_floor(n, errors, fit->floor.lower * 0.98), limit);
  EXPECT_LT(sum_with_floor(n, errors, fit->floor.lower * 1.02), limit);
  EXPECT_LT(sum_with_floor(n, errors, fit->floor.upper * 0.99), limit);
  EXPECT_GT(sum_with_floor(n, errors, fit->floor.upper * 1.01), limit);
}

TEST(PowerFitTest, NeitherFloorNorLawIsEverNegative) {
  // Errors that bend below a power law, 1.1 n^(-1/2) - 0.1, would like a floor below 0.
  const std::vector<double> n = doubled_from(1, 6);
  const auto bent = fit_power(n, errors_of({-0.1, 1.1, -0.5}, n), true);
  ASSERT_TRUE(bent);
  EXPECT_EQ(bent->floor.estimate, 0);
  EXPECT_EQ(bent->floor.lower, 0);
  EXPECT_GT(bent->c, 0);
  // 2 - n^(-1/2) rises, which takes a p above 0 where c is not negative.
  const auto rising = fit_power(n, errors_of({2, -1, -0.5}, n), true);
  ASSERT_TRUE(rising);
  EXPECT_GT(rising->p.estimate, 0);
  EXPECT_GE(rising->floor.lower, 0);
  EXPECT_GT(rising->c, 0);
}

TEST(PowerFitTest, UnitsOfErrorAndEffortDoNotMatter) {
  const std::vector<double> n = doubled_from(1, 7);
  const std::vector<double> errors{1.02, 0.74, 0.49, 0.36, 0.27, 0.2, 0.19};
  const auto fit = fit_power(n, errors, true);
  ASSERT_TRUE(fit);
  std::vector<double> other_n, other_errors;
  for (const double x : n) other_n.push_back(x * 1e100);
  for (const double x : errors) other_errors.push_back(x * 1e-200);
  const auto other = fit_power(other_n, other_errors, true);
  ASSERT_TRUE(other);
  // Logarithms of 1e-200 are off by 6e-14, and a least value is found to 1e-7.
  EXPECT_NEAR(fit->p.estimate, other->p.estimate, 1e-6);
  EXPECT_NEAR(fit->p.lower, other->p.lower, 1e-6);
  EXPECT_NEAR(fit->floor.upper, other->floor.upper * 1e200, 1e-6);
  EXPECT_NEAR(fit->relative_rms, other->relative_rms, 1e-9);
}

TEST(PowerFitTest, PowersOfHugeNumbersDoNotOverflow) {
  // (10^36)^-8 = 1e-288, whose square is no double any more.
  std::vector<double> n, errors;
  for (int i = 0; i < 6; ++i) n.push_back(std::pow(10.0, 31 + i)), errors.push_back(std::pow(10.0, -7.5 * i));
  const auto fit = fit_power(n, errors, false);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->p.estimate, -7.5, 1e-6);
  EXPECT_NEAR(std::log10(fit->c), 7.5 * 31, 1e-3);
}

TEST(PowerFitTest, TooFewPointsHaveNoFit) {
  const std::vector<double> n{1, 2, 4}, errors{1, 0.7, 0.5};
  EXPECT_TRUE(fit_power(n, errors, false));
  EXPECT_FALSE(fit_power(n, errors, true));
  EXPECT_FALSE(fit_power(std::vector<double>{1, 2}, std::vector<double>{1, 0.7}, false));
  EXPECT_FALSE(fit_power(std::vector<double>{2, 2, 2}, errors, false));
  EXPECT_FALSE(fit_power(std::vector<double>{1, 1, 2, 2}, std::vector<double>{1, 1.1, 0.7, 0.8}, true));
  EXPECT_FALSE(fit_power({}, {}, false));
}

TEST(PowerFitTest, RefusesWhatIsNoErrorOfAnEffort) {
  const std::vector<double> n{1, 2, 4}, errors{1, 0.7, 0.5};
  for (const double wrong : {0.0, -1.0, kInfinity, std::nan("")}) {
    EXPECT_THROW(fit_power(std::vector<double>{1, 2, wrong}, errors, false), std::invalid_argument);
    EXPECT_THROW(fit_power(n, std::vector<double>{1, 0.7, wrong}, false), std::invalid_argument);
  }
  EXPECT_THROW(fit_power(n, std::vector<double>{1, 0.7}, false), std::invalid_argument);
}

}  // namespace
}  // namespace herr
