// The height of the polar buffers below the least width: as steady, as fast and as bounded as the width.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/server/quality/deadline_trials.h"

namespace herr {
namespace {

using test::kSettled;
using test::Load;
using test::SimulatedFrame;
using test::SimulatedMachine;

// The paper's buffer, down to an eighth of its columns and a quarter of its rows.
DeadlineConfig paper_config(double target_ms = 50) {
  DeadlineConfig config;
  config.target_ms = target_ms;
  config.limits = quality_limits({1, 788, 0, 768}, default_narrowest(788), default_lowest(768));
  return config;
}

// A whole frame takes `full_ms`, all of it by its samples.
Load load_of(double full_ms, const DeadlineConfig& config) {
  const FrameQuality& full = config.limits.full;
  Load load;
  load.rows = full.polar_height;
  load.column_ms = full_ms / full.polar_width;
  return load;
}

TEST(DeadlineHeightTest, TheFloorIsAQuarterOfTheRowsAndEven) {
  EXPECT_EQ(default_lowest(768), 192);
  EXPECT_EQ(default_lowest(1174), 292);  // 293.5, even
  EXPECT_EQ(default_lowest(2), 2);
  const QualityLimits limits = quality_limits({1, 788, 0, 768}, 98, 333);
  EXPECT_EQ(limits.lowest, 332);
  EXPECT_EQ(quality_limits({1, 788, 0, 768}, 98, 9999).lowest, 768);
  EXPECT_EQ(quality_limits({1, 788, 0, 768}, 98, 0).lowest, 2);
  EXPECT_EQ(quality_limits({1, 788, 0, 768}, 98).lowest, 768) << "a height that never changes";
}

// 98 of 788 columns are an eighth. A load whose whole frame takes 4 targets leaves 0.97 / 4 of the size: 191
// columns of all rows. One of 16 targets leaves 0.97 / 16 * 788 = 47.77 columns: 98 columns of 374.4 rows, so
// 374. One of 64 is beyond the floor, 98 x 192 / (788 x 768) = 1 / 32.2.
TEST(DeadlineHeightTest, RowsGoWhenTheWidthIsAtItsLeastAndStillTooSlow) {
  const DeadlineConfig config = paper_config();
  const struct {
    double targets;
    int width, height;
    QualityReason reason;
  } cases[] = {{0.5, 788, 768, QualityReason::full},
               {4, 191, 768, QualityReason::steady},
               {16, 98, 374, QualityReason::steady},
               {64, 98, 192, QualityReason::floor_too_slow}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.targets);
    SimulatedMachine machine(config);
    const Load load = load_of(c.targets * config.target_ms, config);
    machine.frames(kSettled, [&](int) { return load; });
    const SimulatedFrame frame = machine.frame(load);
    EXPECT_EQ(frame.decision.quality.polar_width, c.width);
    EXPECT_NEAR(frame.decision.quality.polar_height, c.height, 4) << "within the dead band";
    EXPECT_EQ(frame.decision.quality.polar_height % 2, 0);
    EXPECT_EQ(frame.decision.reason, c.reason) << name_of(frame.decision.reason);
    EXPECT_EQ(frame.ms > config.target_ms, c.targets == 64);
  }
}

TEST(DeadlineHeightTest, ReasonsTellRowsFromColumns) {
  const DeadlineConfig config = paper_config();
  SimulatedMachine machine(config);
  Load load = load_of(4 * config.target_ms, config);
  EXPECT_EQ(machine.frame(load).decision.quality.polar_height, 192) << "the first frame has the least";
  machine.frames(kSettled, [&](int) { return load; });
  load.factor = 4;
  machine.frame(load);
  const QualityDecision less = machine.frame(load).decision;
  EXPECT_EQ(less.reason, QualityReason::fewer_rows) << name_of(less.reason);
  EXPECT_EQ(less.quality.polar_width, 98);
  machine.frames(kSettled, [&](int) { return load; });
  load.factor = 2.4;  // less than twice as much fits: no limit to growth
  std::set<QualityReason> reasons;
  for (const SimulatedFrame& frame : machine.frames(kSettled, [&](int) { return load; })) {
    reasons.insert(frame.decision.reason);
    const FrameQuality& quality = frame.decision.quality;
    EXPECT_TRUE(quality.polar_width == 98 || quality.polar_height == 768) << "one at a time";
  }
  EXPECT_TRUE(reasons.contains(QualityReason::more_rows));
}

// A row of two is 2 % of 100.
TEST(DeadlineHeightTest, AfterAStepOf50FramesAreWithinATenthOfTheTargetByTheEighth) {
  for (const test::StepCase& step : test::kStepsOf50) {
    SCOPED_TRACE(testing::Message() << step.target_ms << " ms, fixed " << step.fixed_share << ", rows "
                                    << step.settled << ", times " << step.factor);
    Load load;
    load.rows = 1;  // a column of one row, of which a row of the frame has 16
    load.fixed_ms = step.fixed_ms();
    load.column_ms = step.ms_each() / 16;
    const std::vector<SimulatedFrame> after =
        test::frames_after_step(step, test::tall_config(step.target_ms), load);
    for (std::size_t i = 0; i < after.size(); ++i) {
      ASSERT_EQ(after[i].decision.quality.polar_width, 16);
      ASSERT_EQ(after[i].decision.quality.polar_height % 2, 0);
      if (i == 0) continue;
      ASSERT_LE(after[i].decision.quality.polar_height, 2 * after[i - 1].decision.quality.polar_height);
    }
  }
}

// Also where what fits lies on the corner between the least width of all rows and fewer rows.
TEST(DeadlineHeightTest, AConstantLoadIsHeldWithoutSwinging) {
  const DeadlineConfig config = paper_config();
  for (const double columns : {30.0, 60.0, 97.9, 98.0, 98.3, 99.0, 101.5, 150.0}) {
    for (const double fixed_share : {0.0, 0.5}) {
      SCOPED_TRACE(testing::Message() << columns << " columns, fixed " << fixed_share);
      SimulatedMachine machine(config);
      Load load = load_of(0, config);
      load.fixed_ms = fixed_share * config.target_ms;
      load.column_ms = (1 / 1.03 - fixed_share) * config.target_ms / columns;
      machine.frames(kSettled, [&](int) { return load; });
      std::set<std::pair<int, int>> sizes;
      for (const SimulatedFrame& frame : machine.frames(2000, [&](int) { return load; })) {
        sizes.insert({frame.decision.quality.polar_width, frame.decision.quality.polar_height});
        ASSERT_LE(frame.ms, config.target_ms);
        ASSERT_GE(frame.ms, 0.90 * config.target_ms);
      }
      EXPECT_EQ(sizes.size(), 1u);
    }
  }
}

TEST(DeadlineHeightTest, WithWhiteNoiseTwoPercentAreMissedAtMost) {
  const DeadlineConfig config = paper_config();
  for (const double noise : {0.05, 0.15}) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
      SCOPED_TRACE(testing::Message() << "noise " << noise << ", seed " << seed);
      SimulatedMachine machine(config);
      const Load load = load_of(12 * config.target_ms, config);
      for (const SimulatedFrame& frame :
           test::frames_with_noise(machine, load, config.target_ms, noise, seed)) {
        ASSERT_GE(frame.decision.quality.polar_height, 192);
      }
    }
  }
}

// Light goes first, then columns, then rows; on the way back rows come first.
TEST(DeadlineHeightTest, LightAndColumnsGoBeforeRows) {
  DeadlineConfig config = paper_config();
  config.limits = quality_limits({16, 788, 1024, 768}, 98, 192);
  SimulatedMachine machine(config);
  Load load = load_of(10, config);
  load.light_ms = load.column_ms / 16, load.probe_ms = 5.0 / 1024;
  machine.frames(kSettled * 10, [&](int) { return load; });
  EXPECT_EQ(machine.frame(load).decision.quality.light_samples, 16);
  for (const double factor : {4.0, 20.0, 50.0, 4.0, 1.0}) {
    load.factor = factor;
    for (const SimulatedFrame& frame : machine.frames(kSettled, [&](int) { return load; })) {
      const FrameQuality& quality = frame.decision.quality;
      if (quality.polar_height < 768) {
        EXPECT_EQ(quality.polar_width, 98);
        EXPECT_EQ(quality.light_samples, 1);
        EXPECT_EQ(quality.probes, 64);
      }
    }
  }
  load.factor = 50;
  machine.frames(kSettled, [&](int) { return load; });
  EXPECT_LT(machine.frame(load).decision.quality.polar_height, 768);
}

// Motion asks for less width than the least that the deadline keeps: the height goes down from there.
TEST(DeadlineHeightTest, ANarrowerWishIsLoweredToo) {
  const DeadlineConfig config = paper_config();
  SimulatedMachine machine(config);
  const Load load = load_of(64 * config.target_ms, config);
  for (int i = 0; i < kSettled; ++i) {
    const FrameQuality quality = machine.policy.decide({1, 50, 0, 768}).quality;
    EXPECT_EQ(quality.polar_width, 50);
    machine.policy.observe(test::cost_of(load, quality, machine.now_ns += 50'000'000, config.target_ms));
  }
  // 0.97 / 64 * 788 = 11.94 columns of 768 rows are below 50 x 192 = 12.5 of them.
  EXPECT_EQ(machine.policy.decide({1, 50, 0, 768}).quality.polar_height, 192);
}

}  // namespace
}  // namespace herr
