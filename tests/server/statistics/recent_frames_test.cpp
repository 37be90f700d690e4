// The window of ten seconds against a list that keeps everything.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "server/statistics/recent_frames.h"

namespace herr {
namespace {

RecentFrame frame_at(std::int64_t sequence, TimeNs finished_ns, double frame_ms) {
  RecentFrame frame;
  frame.sequence = sequence;
  frame.finished_ns = finished_ns;
  frame.record.times.frame_ms = frame_ms;
  frame.record.times[Stage::first_hits] = frame_ms;
  frame.record.missed = frame_ms > 20;
  frame.record.dropped_frames = sequence % 3;
  return frame;
}

std::vector<RecentFrame> copy_of(const RecentFrames& recent) {
  return {recent.frames().begin(), recent.frames().end()};
}

TEST(RecentFrames, StatisticsOfTheWindowAreThoseOfTheFramesInIt) {
  std::mt19937_64 random(3);
  std::exponential_distribution<double> gap_s(20.0), cost_ms(0.1);
  RecentFrames recent;
  std::vector<RecentFrame> everything;
  TimeNs now_ns = 0;
  for (std::int64_t i = 1; i <= 3000; ++i) {
    // Now and then a silence that is longer than the window.
    now_ns += i % 700 == 0 ? 2 * kWindowNs : static_cast<TimeNs>(gap_s(random) * 1e9);
    everything.push_back(frame_at(i, now_ns, cost_ms(random)));
    recent.add(everything.back());
    if (i % 50 != 0) continue;
    for (const TimeNs later_ns : {TimeNs{0}, kWindowNs / 3, kWindowNs}) {
      RunStatistics expected;
      for (const RecentFrame& frame : everything) {
        if (frame.finished_ns > now_ns + later_ns - kWindowNs) expected.add(frame.record);
      }
      const RunStatistics window = window_statistics(copy_of(recent), now_ns + later_ns);
      EXPECT_EQ(window.frames, expected.frames) << i;
      EXPECT_EQ(window.frame, expected.frame) << i;
      EXPECT_EQ(window.stages, expected.stages) << i;
      EXPECT_EQ(window.missed_frames, expected.missed_frames);
      EXPECT_EQ(window.dropped_frames, expected.dropped_frames);
    }
  }
}

TEST(RecentFrames, TheWindowOpensAfterTenSecondsSharp) {
  const std::vector<RecentFrame> frames{frame_at(1, 1000, 5)};
  EXPECT_EQ(window_statistics(frames, 1000 + kWindowNs - 1).frames, 1);
  EXPECT_EQ(window_statistics(frames, 1000 + kWindowNs).frames, 0);
  EXPECT_EQ(window_statistics(frames, 999).frames, 0) << "not finished yet";
}

TEST(RecentFrames, AnyRateOfFramesStaysWithinItsBound) {
  RecentFrames recent;
  for (std::int64_t i = 1; i <= 25'000; ++i) recent.add(frame_at(i, i * 1000, 0.001));
  EXPECT_EQ(recent.frames().size(), kMostRecentFrames);
  EXPECT_EQ(recent.frames().back().sequence, 25'000);
}

TEST(LatencyHistogram, CountsUpToABoundWithinOneBucket) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(2, 12);
  LatencyHistogram histogram;
  std::vector<std::int64_t> all;
  for (int i = 0; i < 5000; ++i) {
    all.push_back(static_cast<std::int64_t>(std::pow(10.0, exponent(random))));
    histogram.add_ns(all.back());
  }
  // Bounds of a bucket are a factor (1 + a) / (1 - a) apart, a = 0.005: 1.01006 covers it. Below 1 us and
  // above 100 s there is one bucket each.
  std::int64_t before = 0;
  for (double bound = 1000; bound < 9e10; bound *= 1.37) {
    const auto count_below = [&](double limit) {
      return std::count_if(all.begin(), all.end(),
                           [&](std::int64_t v) { return static_cast<double>(v) <= limit; });
    };
    const std::int64_t count = histogram.count_up_to_ns(static_cast<std::int64_t>(bound));
    EXPECT_GE(count, count_below(bound / 1.01006));
    EXPECT_LE(count, count_below(bound * 1.01006));
    EXPECT_GE(count, before);
    before = count;
  }
  EXPECT_EQ(histogram.count_up_to_ns(LatencyHistogram::kHighestNs), histogram.count());
  EXPECT_EQ(LatencyHistogram().count_up_to_ns(5), 0);
}

}  // namespace
}  // namespace herr
