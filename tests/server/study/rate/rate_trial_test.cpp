// A measurement's percentile, what the machine gave to it, and which frames it is of.
#include "server/study/rate/rate_trial.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "server/study/rate/rate_frames.h"

namespace herr {
namespace {

TEST(Percentile95, IsTheNearestRank) {
  std::vector<double> times(100);
  std::iota(times.rbegin(), times.rend(), 1.0);
  EXPECT_EQ(percentile_95(times), 95);
  EXPECT_EQ(percentile_95(std::vector<double>{7}), 7);
  EXPECT_EQ(percentile_95(std::vector<double>{7, 9}), 9);
  times.resize(20);  // 100 ... 81: rank 19 of 20
  EXPECT_EQ(percentile_95(times), 99);
}

TEST(RateStretch, TheWorstIsTheSlowestOfThoseWithFramesEnough) {
  RateTrial trial;
  EXPECT_EQ(worst_stretch(trial), nullptr);
  trial.stretches = {{0, 1, 25, 9}, {2, 3, 25, 12}, {4, 5, 19, 30}};
  ASSERT_NE(worst_stretch(trial), nullptr);
  EXPECT_EQ(worst_stretch(trial)->p95_ms, 12);
}

MachineUse quiet() {
  MachineUse use;
  use.cpu_ms = 1900, use.cores_ms = 2000, use.preemptions = 3, use.late = 5, use.used_ticks = 200;
  return use;
}

TEST(MachineUse, IsBusyWhenOthersHadTheCores) {
  EXPECT_FALSE(quiet().busy());
  EXPECT_FALSE(MachineUse().busy());
  MachineUse use = quiet();
  use.cpu_ms = 1500;  // three quarters, below four fifths
  EXPECT_TRUE(use.busy());
  use.preemptions = 0;  // it waited for itself
  EXPECT_FALSE(use.busy());
  use = quiet();
  use.late_by_machine = 3;  // of 5
  EXPECT_TRUE(use.busy());
  use = quiet();
  use.stolen_ticks = 20;  // of 220
  EXPECT_TRUE(use.busy());
  use = quiet();
  use.cpu_known = false, use.cpu_ms = 0;
  EXPECT_FALSE(use.busy());
  EXPECT_FALSE(use.cpu_share());
}

TEST(MachineUse, SaysWhatWasMeasuredOfAllTrialsTogether) {
  MachineUse use = quiet();
  use.add(quiet());
  use.late_by_machine = 4, use.stolen_ticks = 100;
  EXPECT_EQ(use.text(),
            "4 of 10 late frames for the machine alone, 6 preemptions, threads had 95 % of their cores, a "
            "hypervisor "
            "took 20 %");
}

FrameRange range_of(std::int64_t first, std::int64_t count) {
  FrameRange range;
  range.first = first, range.count = count;
  return range;
}

// 1000 frames from 50: shares of 250, their middles at 175, 425, 675, 925; stretches of 30 around them.
TEST(RateFrames, AreFourStretchesOfALongSession) {
  const std::vector<RateFrame> frames = rate_frames(range_of(50, 1000));
  ASSERT_EQ(frames.size(), 4u * 30);
  int counted = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].frame,
              50 + 125 + 250 * static_cast<std::int64_t>(i / 30) - 15 + static_cast<int>(i % 30));
    EXPECT_EQ(frames[i].counts, i % 30 >= 5);
    EXPECT_EQ(frames[i].stretch, static_cast<int>(i / 30));
    counted += frames[i].counts ? 1 : 0;
  }
  EXPECT_EQ(counted, kRateFrames);
}

// A period of 10 ms. The first frame after a renderer was built is slow, whatever follows.
TEST(CountedFrames, AColdFirstFrameCountsNothing) {
  CountedFrames counted(10);
  for (const double ms : {400.0, 9.0, 9.0, 41.0, 9.0}) EXPECT_FALSE(counted.counts({0, false}, ms)) << ms;
  EXPECT_TRUE(counted.counts({5, true}, 9));
}

TEST(CountedFrames, WhereAllAreFarTooSlowNothingHasToWarmUp) {
  CountedFrames counted(10);
  EXPECT_FALSE(counted.counts({0, false}, 900));
  EXPECT_TRUE(counted.counts({1, false}, 800));
  EXPECT_TRUE(counted.counts({2, false}, 800));
}

TEST(RateFrames, OfAShortSessionAreAllOfIt) {
  for (const std::int64_t count : {1, 2, 3, 9, 10, 119, 120, 121}) {
    SCOPED_TRACE(count);
    const std::vector<RateFrame> frames = rate_frames(range_of(7, count));
    EXPECT_EQ(static_cast<std::int64_t>(frames.size()), std::min<std::int64_t>(count, 120));
    EXPECT_GE(frames.front().frame, 7);
    EXPECT_LT(frames.back().frame, 7 + count);
    EXPECT_TRUE(frames.back().counts);
    for (std::size_t i = 1; i < frames.size(); ++i) EXPECT_GT(frames[i].frame, frames[i - 1].frame);
  }
}

}  // namespace
}  // namespace herr
