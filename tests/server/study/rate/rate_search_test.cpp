// The search of `herr study --hz` finds the largest setting that holds, whatever the measurements scatter by.
#include "server/study/rate/rate_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "tests/server/study/rate/simulated_rate.h"

namespace herr {
namespace {

constexpr double kPeriod_ms = 10;

// Runs a search to its end; returns how many trials it took.
int run(RateSearch& search, const std::function<double(std::size_t)>& p95_ms) {
  int trials = 0;
  while (const auto next = search.next()) {
    search.observe(test::trial_of(p95_ms(*next)));
    if (++trials > 1000) break;
  }
  return trials;
}

TEST(RateSearch, FindsTheBorderWhereverItLies) {
  for (const std::size_t settings : {1u, 2u, 3u, 10u, 87u}) {
    for (std::size_t hold = 0; hold <= settings; ++hold) {
      SCOPED_TRACE(testing::Message() << hold << " of " << settings << " hold");
      RateSearch search(settings, kPeriod_ms);
      // 3 % from one to the next.
      const int trials = run(search, [&](std::size_t i) {
        return kPeriod_ms * std::pow(1.03, static_cast<double>(i) - static_cast<double>(hold) + 0.5);
      });
      EXPECT_EQ(search.held().has_value(), hold > 0);
      EXPECT_EQ(search.refused().has_value(), hold < settings);
      if (hold > 0) {
        EXPECT_EQ(*search.held(), hold - 1);
        EXPECT_GE(search.trials(hold - 1).size(), 3u);
      }
      if (hold < settings) {
        EXPECT_EQ(*search.refused(), hold);
      }
      // Bisection looks at 7 of 87; each takes three where it is near, and none disagree.
      EXPECT_LE(trials, 3 * (1 + static_cast<int>(std::ceil(std::log2(static_cast<double>(settings + 1))))));
    }
  }
}

TEST(RateSearch, FarFromThePeriodOneTrialIsEnough) {
  RateSearch search(87, kPeriod_ms);
  EXPECT_EQ(run(search, [](std::size_t) { return 50.0; }), 6 + 2)
      << "43, 21, 10, 4, 1, 0, and two more of the last";
  EXPECT_FALSE(search.held());
  EXPECT_EQ(search.refused(), 0u);
  RateSearch easy(87, kPeriod_ms);
  EXPECT_EQ(run(easy, [](std::size_t) { return 1.0; }), 7 + 2) << "and two more of the last";
  EXPECT_EQ(easy.held(), 86u);
  EXPECT_FALSE(easy.refused());
}

// Noise of 5 %: what the search says holds by the median of its own three or five, and lies where the truth
// is within the noise of a median of three, 0.67 standard deviations, three times over, which is 3.4
// settings.
TEST(RateSearch, NoiseMovesTheAnswerByNoMoreThanItself) {
  constexpr std::size_t kSettings = 87, kHold = 40;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    RateSearch search(kSettings, kPeriod_ms);
    const int trials = run(search, [&](std::size_t i) {
      return kPeriod_ms * std::pow(1.03, static_cast<double>(i) - kHold + 0.5) *
             std::exp(0.05 * normal(random));
    });
    ASSERT_TRUE(search.held());
    EXPECT_LE(search.p95_ms(*search.held()), kPeriod_ms);
    EXPECT_GT(search.p95_ms(*search.refused()), kPeriod_ms);
    EXPECT_EQ(*search.refused(), *search.held() + 1);
    EXPECT_NEAR(static_cast<double>(*search.held()), kHold - 1.0, 6);
    EXPECT_LE(trials, 5 * 9);
  }
}

// The middle of three looks fast once, in truth it is slow: it is asked again, and given up.
TEST(RateSearch, ALuckyTrialIsNotBelieved) {
  RateSearch search(3, kPeriod_ms);
  std::vector<int> count(3);
  run(search, [&](std::size_t i) {
    ++count[i];
    if (i == 0) return 8.0;
    if (i == 2) return 20.0;
    return count[1] == 1 ? 8.5 : 12.0;
  });
  EXPECT_EQ(search.held(), 0u);
  EXPECT_EQ(search.refused(), 1u);
  EXPECT_EQ(count[1], 5) << "the trials disagreed";
}

// Far too slow once, and then not: the smallest is not given up for one trial.
TEST(RateSearch, TheSmallestIsNotGivenUpForOneSlowTrial) {
  for (const std::size_t settings : {1u, 2u, 3u}) {
    RateSearch search(settings, kPeriod_ms);
    int first = 0;
    run(search, [&](std::size_t i) { return i > 0 || ++first == 1 ? 50.0 : 5.0; });
    EXPECT_EQ(search.held(), 0u) << settings;
    EXPECT_EQ(first, 5) << "the trials disagree";
    EXPECT_EQ(search.refused().has_value(), settings > 1);
  }
}

// 43, 21, 10, 4, 1 and once the smallest, each of whose frames took more than three times the period.
TEST(RateSearch, AHopelessTrialOfTheSmallestIsNotRepeated) {
  RateSearch search(87, kPeriod_ms);
  int trials = 0;
  while (const auto next = search.next()) {
    RateTrial trial = test::trial_of(50);
    trial.hopeless = true;
    search.observe(trial);
    ++trials;
  }
  EXPECT_EQ(trials, 6);
  EXPECT_FALSE(search.held());
  EXPECT_EQ(search.refused(), 0u);
}

TEST(RateSearch, ThePeriodItselfHolds) {
  RateSearch search(1, kPeriod_ms);
  run(search, [](std::size_t) { return kPeriod_ms; });
  EXPECT_EQ(search.held(), 0u);
}

TEST(RateSearch, MedianAndSpreadAreThoseOfTheTrials) {
  const std::vector<RateTrial> trials{test::trial_of(12), test::trial_of(8), test::trial_of(10)};
  EXPECT_EQ(median_p95_ms(trials), 10);
  EXPECT_DOUBLE_EQ(spread_of(trials), 0.4);
  EXPECT_EQ(spread_of({test::trial_of(12)}), 0);
}

}  // namespace
}  // namespace herr
