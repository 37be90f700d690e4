// Stutter and the three "1 % lows", against slow, obvious code and by hand.
#include "server/statistics/frame_pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace herr {
namespace {

LatencyHistogram histogram_of(const std::vector<double>& times_ms) {
  LatencyHistogram histogram;
  for (const double ms : times_ms) histogram.add_ms(ms);
  return histogram;
}

TEST(OnePercentLowsTest, AreThreeDifferentNumbers) {
  // 990 frames of 10 ms, 9 of 20 ms, 1 of 100 ms: 10,180 ms in all. The rank below 1 % is the last of 10 ms;
  // the slowest ten take 28 ms on average; 1 % of the time, 101.8 ms, is full with the first of 20 ms.
  std::vector<double> times(990, 10);
  times.insert(times.end(), 9, 20);
  times.push_back(100);
  const OnePercentLows lows = one_percent_lows(histogram_of(times));
  constexpr double kError = 2 * LatencyHistogram::kRelativeError;
  EXPECT_NEAR(lows.rank_fps, 100, 100 * kError);
  EXPECT_NEAR(lows.mean_fps, 1000 / 28.0, 36 * kError);
  EXPECT_NEAR(lows.time_fps, 50, 50 * kError);
}

TEST(OnePercentLowsTest, AgreeWithSortedFrames) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    std::mt19937 random(seed);
    std::lognormal_distribution<double> distribution(std::log(15), 0.4);
    std::vector<double> times(1 + 1500 * seed);
    for (double& time : times) time = distribution(random);
    const OnePercentLows lows = one_percent_lows(histogram_of(times));
    std::sort(times.rbegin(), times.rend());
    const auto slowest = static_cast<std::ptrdiff_t>(std::ceil(0.01 * static_cast<double>(times.size())));
    const double mean =
        std::accumulate(times.begin(), times.begin() + slowest, 0.0) / static_cast<double>(slowest);
    const double all = std::accumulate(times.begin(), times.end(), 0.0);
    std::size_t i = 0;
    for (double sum = times[0]; sum < 0.01 * all;) sum += times[++i];
    // Within the histogram's error, and for the share of time within that of the sums: one bucket more.
    EXPECT_NEAR(lows.mean_fps * mean / 1000, 1, 0.006) << seed;
    EXPECT_NEAR(lows.time_fps * times[i] / 1000, 1, 0.016) << seed;
  }
}

TEST(OnePercentLowsTest, OfOneFrameAndOfNone) {
  const OnePercentLows one = one_percent_lows(histogram_of({25}));
  EXPECT_DOUBLE_EQ(one.rank_fps, 40);
  EXPECT_DOUBLE_EQ(one.mean_fps, 40);
  EXPECT_DOUBLE_EQ(one.time_fps, 40);
  const OnePercentLows none = one_percent_lows({});
  EXPECT_EQ(none.rank_fps, 0);
  EXPECT_EQ(none.mean_fps, 0);
  EXPECT_EQ(none.time_fps, 0);
}

int stutters_of(const std::vector<double>& times_ms) {
  StutterWatch watch;
  return static_cast<int>(
      std::count_if(times_ms.begin(), times_ms.end(), [&](double ms) { return watch.next_ms(ms); }));
}

TEST(StutterTest, CountsFramesThatStandOutFromThoseBefore) {
  EXPECT_EQ(stutters_of({10, 10, 10, 24.9, 10}), 0);
  EXPECT_EQ(stutters_of({10, 10, 10, 26, 10}), 1);
  EXPECT_EQ(stutters_of({100, 10, 10}), 0) << "the first has none before it";
  EXPECT_EQ(stutters_of({}), 0);
}

TEST(StutterTest, ALastingChangeIsStutterOnlyUntilTheMeanHasFollowed) {
  // From 10 to 30 ms: mean' = 30 - 20 exp(-0.03 n) passes 30 / 2.5 = 12 ms at n = ln(20 / 18) / 0.03 = 3.5:
  // the first four frames stand out.
  std::vector<double> times(500, 10);
  times.insert(times.end(), 100, 30);
  EXPECT_EQ(stutters_of(times), 4);
}

}  // namespace
}  // namespace herr
