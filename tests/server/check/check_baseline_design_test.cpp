// How often `herr check --baseline` errs, on simulated machines; what makes a machine too restless; counters.
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "server/check/statistics/baseline_design.h"
#include "server/check/statistics/counter_gate.h"
#include "server/check/statistics/noise.h"

namespace herr {
namespace {

constexpr unsigned kSeed = 20210210;
constexpr double kCalibratedCv = 0.016;  // measured: medians of runs over the calibration beside them
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Runs of one sitting: noise that remembers, and 3 % of runs slower by 30 % on average.
std::vector<double> sitting(std::mt19937_64& random, int runs, double effect) {
  std::normal_distribution<double> normal(0, kCalibratedCv);
  std::exponential_distribution<double> slower(1 / 0.3);
  std::bernoulli_distribution spiked(0.03);
  constexpr double kMemory = 0.7;
  std::vector<double> times;
  double drift = normal(random);
  for (int i = 0; i < runs; ++i) {
    drift = kMemory * drift + std::sqrt(1 - kMemory * kMemory) * normal(random);
    times.push_back(drift + std::log1p(effect) + (spiked(random) ? std::log1p(slower(random)) : 0));
  }
  return times;
}

int regressions(int checks, double effect) {
  const BaselineDesign design;
  int found = 0;
  for (int i = 0; i < checks; ++i) {
    std::mt19937_64 random(kSeed + static_cast<unsigned>(i));
    const std::vector<double> stored = sitting(random, design.stored_runs, 0);
    const std::vector<double> now = sitting(random, design.runs, effect);
    found += judge_against_baseline(now, stored, design).verdict == Verdict::regression;
  }
  return found;
}

using Binomial = boost::math::binomial_distribution<double>;

TEST(BaselineDesign, RaisesNoMoreThanTwoFalseAlarmsInAThousandChecks) {
  constexpr int kChecks = 5000;
  const int alarms = regressions(kChecks, 0);
  EXPECT_LE(Binomial::find_upper_bound_on_p(kChecks, alarms, 0.01), 0.002) << alarms << ", seed " << kSeed;
}

TEST(BaselineDesign, FindsEightPercentInNineOfTenChecks) {
  constexpr int kChecks = 500;
  const int found = regressions(kChecks, 0.08);
  EXPECT_GE(Binomial::find_lower_bound_on_p(kChecks, found, 0.01), 0.90) << found << ", seed " << kSeed;
}

TEST(BaselineDesign, SaysNothingOfTooFewRuns) {
  const BaselineDesign design;
  const std::vector<double> slow(10, 1.0), few(9, 1.0), stored(20, 0.0), few_stored(19, 0.0);
  EXPECT_EQ(judge_against_baseline(slow, stored, design).verdict, Verdict::regression);
  EXPECT_EQ(judge_against_baseline(few, stored, design).verdict, Verdict::inconclusive);
  EXPECT_EQ(judge_against_baseline(slow, few_stored, design).verdict, Verdict::inconclusive);
  EXPECT_EQ(judge_against_baseline({}, stored, design).verdict, Verdict::inconclusive);
}

TEST(Noise, MeasuresTheSpreadOfANormalDistribution) {
  constexpr int kValues = 10000;
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal(2.0, 0.1);
  std::vector<double> values(kValues);
  for (double& x : values) x = normal(random);
  // CV 0.05. The median absolute deviation has 37 % efficiency: standard error 0.05 / sqrt(2 * 0.37 * n).
  EXPECT_NEAR(robust_cv(values), 0.05, 4 * 0.05 / std::sqrt(0.74 * kValues)) << "seed " << kSeed;
}

TEST(Noise, IsNotMovedByOneWildRun) {
  // Deviations from the median 1.02 are 0.02 0.01 0 0.01 and a huge one: the median deviation is 0.01.
  const std::vector<double> values{1.00, 1.01, 1.02, 1.03, 9.0};
  EXPECT_NEAR(robust_cv(values), 1.4826 * 0.01 / 1.02, 1e-12);
}

TEST(Noise, NamesWhatIsTooRestless) {
  EXPECT_EQ(noise_text({0.05, 0.05}), "");
  EXPECT_NE(noise_text({0.0501, 0}).find("speed varied by 5.0 %"), std::string::npos);
  EXPECT_NE(noise_text({0, 0.06}).find("hypervisor took 6.0 %"), std::string::npos);
  EXPECT_NE(noise_text({kNan, 0}), "");
  EXPECT_NE(noise_text({0, kNan}), "");
}

Verdict verdict_of_counter(const CounterRange& before, const CounterRange& now) {
  return judge_counters({before}, {now}).at(0).verdict;
}

TEST(CounterGate, AllowsHalfAPercent) {
  EXPECT_EQ(verdict_of_counter({"rays", 1000, 1000}, {"rays", 1005, 1005}), Verdict::ok);
  EXPECT_EQ(verdict_of_counter({"rays", 1000, 1000}, {"rays", 1006, 1006}), Verdict::regression);
  EXPECT_EQ(verdict_of_counter({"rays", 1000, 1000}, {"rays", 10, 10}), Verdict::ok);
}

TEST(CounterGate, TakesAnythingAboveNothingForMore) {
  EXPECT_EQ(verdict_of_counter({"allocations", 0, 0}, {"allocations", 0, 0}), Verdict::ok);
  EXPECT_EQ(verdict_of_counter({"allocations", 0, 0}, {"allocations", 0.1, 0.1}), Verdict::regression);
}

TEST(CounterGate, SaysNothingOfCountersThatDifferFromRunToRun) {
  EXPECT_EQ(verdict_of_counter({"rays", 1000, 1010}, {"rays", 1000, 1010}), Verdict::inconclusive);
  EXPECT_EQ(verdict_of_counter({"rays", 1000, 1010}, {"rays", 1020, 1030}), Verdict::regression);
  EXPECT_EQ(verdict_of_counter({"rays", kNan, kNan}, {"rays", 1, 1}), Verdict::inconclusive);
}

TEST(CounterGate, LetsNoMissingCounterPass) {
  const auto judgements =
      judge_counters({{"rays", 1, 1}, {"pixels", 2, 2}}, {{"rays", 1, 1}, {"bytes", 3, 3}});
  ASSERT_EQ(judgements.size(), 3u);
  EXPECT_EQ(judgements[0].verdict, Verdict::ok);
  EXPECT_EQ(judgements[1].verdict, Verdict::inconclusive);
  EXPECT_EQ(judgements[1].reason, "the candidate does not count it");
  EXPECT_EQ(judgements[2].verdict, Verdict::inconclusive);
  EXPECT_EQ(judgements[2].reason, "the baseline does not count it");
}

}  // namespace
}  // namespace herr
