// Width and height of the polar buffers together: as steady, as fast and as bounded as the width alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

// How far a size is from the whole to the least, by its columns and by its rows: 0 ... 1.
double way_of(int size, int full, int least) {
  return std::log(static_cast<double>(full) / size) / std::log(static_cast<double>(full) / least);
}

// Columns and rows are as far on their ways as each other: within what a column of 98 and two rows of 192 are
// on ways of 2.08 and 1.39, 0.5 and 0.75 %.
void expect_even(const FrameQuality& quality) {
  EXPECT_NEAR(way_of(quality.polar_width, 788, 98), way_of(quality.polar_height, 768, 192), 0.0125)
      << quality.polar_width << "x" << quality.polar_height;
}

// A load whose whole frame takes 4 targets leaves 0.97 / 4 = 0.2427 of the samples. ln 0.2427 = -1.416 of
// ln(98 * 192 / (788 * 768)) = -3.471 is 0.408 of the way: 788 / 8.04^0.408 = 337 columns, 768 / 4^0.408 =
// 436 rows. One of 16 targets leaves 0.0607, 0.807 of the way: 146.5 columns, 250.8 rows. One of 64 is beyond
// the floor, 1 / 32.2. The dead band is 2 % of the samples, so about 1 % of each.
TEST(DeadlineHeightTest, ColumnsAndRowsGoTogether) {
  const DeadlineConfig config = paper_config();
  const struct {
    double targets, width, height;
    QualityReason reason;
  } cases[] = {{0.5, 788, 768, QualityReason::full},
               {4, 337, 436, QualityReason::steady},
               {16, 146.5, 250.8, QualityReason::steady},
               {64, 98, 192, QualityReason::floor_too_slow}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.targets);
    SimulatedMachine machine(config);
    const Load load = load_of(c.targets * config.target_ms, config);
    machine.frames(kSettled, [&](int) { return load; });
    const SimulatedFrame frame = machine.frame(load);
    EXPECT_NEAR(frame.decision.quality.polar_width, c.width, 0.015 * c.width);
    EXPECT_NEAR(frame.decision.quality.polar_height, c.height, 0.015 * c.height);
    EXPECT_EQ(frame.decision.quality.polar_height % 2, 0);
    expect_even(frame.decision.quality);
    EXPECT_EQ(frame.decision.reason, c.reason) << name_of(frame.decision.reason);
    EXPECT_EQ(frame.ms > config.target_ms, c.targets == 64);
  }
}

TEST(DeadlineHeightTest, EveryFrameOnTheWayIsEven) {
  const DeadlineConfig config = paper_config();
  SimulatedMachine machine(config);
  Load load = load_of(4 * config.target_ms, config);
  EXPECT_EQ(machine.frame(load).decision.quality.polar_height, 192) << "the first frame has the least";
  for (const double factor : {1.0, 4.0, 2.4, 0.6, 0.1, 8.0}) {
    load.factor = factor;
    for (const SimulatedFrame& frame : machine.frames(kSettled, [&](int) { return load; }))
      expect_even(frame.decision.quality);
  }
}

// Where one of them may not change the other does alone: rows of 788 columns, columns of 768 rows. 0.2427 of
// 768 are 186.4 rows, of 788 191.3 columns.
TEST(DeadlineHeightTest, WhereOneIsFixedTheOtherChangesAlone) {
  DeadlineConfig rows = paper_config(), columns = paper_config();
  rows.limits = quality_limits({1, 788, 0, 768}, 788, 2);
  columns.limits = quality_limits({1, 788, 0, 768}, 98);
  const auto settled = [](const DeadlineConfig& config) {
    SimulatedMachine machine(config);
    const Load load = load_of(4 * config.target_ms, config);
    return machine.frames(2 * kSettled, [&](int) { return load; }).back().decision.quality;
  };
  EXPECT_EQ(settled(rows).polar_width, 788);
  EXPECT_NEAR(settled(rows).polar_height, 186, 4);
  EXPECT_EQ(settled(columns).polar_height, 768);
  EXPECT_NEAR(settled(columns).polar_width, 191, 4);
}

// The same times, told again, give the same sizes, one by one.
TEST(DeadlineHeightTest, TheSameRecordedTimesGiveTheSameSizes) {
  const DeadlineConfig config = paper_config();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Load load = load_of(6 * config.target_ms, config);
  DeadlinePolicy first(config);
  std::vector<FrameCost> recorded;
  TimeNs now_ns = 0;
  for (int i = 0; i < 500; ++i) {
    load.factor = std::max(0.1, 1 + 0.2 * normal(random) + (i / 100 % 2));
    const FrameQuality quality = first.decide(config.limits.full).quality;
    recorded.push_back(test::cost_of(load, quality, now_ns += 50'000'000, config.target_ms));
    first.observe(recorded.back());
  }
  DeadlinePolicy again(config);
  for (const FrameCost& cost : recorded) {
    const FrameQuality quality = again.decide(config.limits.full).quality;
    ASSERT_EQ(quality.polar_width, cost.quality.polar_width);
    ASSERT_EQ(quality.polar_height, cost.quality.polar_height);
    again.observe(cost);
  }
}

// With --polar acuity the width that a frame can use follows the gaze: what is steady does not creep.
TEST(DeadlineHeightTest, AWidestThatChangesWithEachFrameDoesNotMoveTheSamples) {
  const DeadlineConfig config = paper_config();
  SimulatedMachine machine(config);
  const Load load = load_of(4 * config.target_ms, config);
  machine.frames(kSettled, [&](int) { return load; });
  for (int i = 0; i < 300; ++i) {
    const FrameQuality quality = machine.policy.decide({1, 700 + 37 * i % 88, 0, 768}).quality;
    // 0.2427 of 788, within the dead band of 2 % and a column's rounding.
    EXPECT_NEAR(test::columns_of(load, quality), 191.3, 0.025 * 191.3) << i;
    machine.policy.observe(test::cost_of(load, quality, machine.now_ns += 50'000'000, config.target_ms));
  }
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

// Also where what fits lies close to the whole or to the least, 98 x 192 / 768 = 24.5 columns.
TEST(DeadlineHeightTest, AConstantLoadIsHeldWithoutSwinging) {
  const DeadlineConfig config = paper_config();
  for (const double columns : {25.0, 30.0, 60.0, 97.9, 98.0, 98.3, 99.0, 101.5, 150.0, 700.0, 787.5}) {
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

// Light goes first, then the size; on the way back the size comes first.
TEST(DeadlineHeightTest, LightGoesBeforeTheSizeIsHalved) {
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
      expect_even(quality);
      if (test::columns_of(load, quality) < 0.4 * 788) {
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
