// Frames are held at a target against simulated loads: steps, noise, targets out of
// reach, times that are none.
#include "server/quality/deadline_policy.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "tests/server/quality/deadline_trials.h"

namespace herr {
namespace {

using test::kSettled;
using test::Load;
using test::SimulatedFrame;
using test::SimulatedMachine;
using test::StepCase;

Load load_before(const StepCase& step) {
  Load load;
  load.fixed_ms = step.fixed_ms();
  load.column_ms = step.ms_each();
  return load;
}

TEST(DeadlinePolicyTest, AfterAStepOf50FramesAreWithinATenthOfTheTargetByTheEighth) {
  for (const StepCase& step : test::kStepsOf50) {
    SCOPED_TRACE(testing::Message() << step.target_ms << " ms, fixed " << step.fixed_share << ", width "
                                    << step.settled << ", times " << step.factor);
    const std::vector<SimulatedFrame> after =
        test::frames_after_step(step, test::wide_config(step.target_ms), load_before(step));
    for (std::size_t i = 1; i < after.size(); ++i) {
      ASSERT_LE(after[i].decision.quality.polar_width, 2 * after[i - 1].decision.quality.polar_width);
    }
  }
}

TEST(DeadlinePolicyTest, AConstantLoadIsHeldWithoutSwinging) {
  for (const double fixed_share : {0.0, 0.3, 0.7}) {
    for (const double settled_width : {40.0, 777.0, 8000.0}) {
      SCOPED_TRACE(testing::Message() << fixed_share << ", " << settled_width);
      SimulatedMachine machine(test::wide_config(50));
      const Load load = load_before({50, fixed_share, settled_width, 1});
      machine.frames(kSettled, [&](int) { return load; });
      double lowest = 1e300, highest = 0;
      for (const SimulatedFrame& frame : machine.frames(2000, [&](int) { return load; })) {
        lowest = std::min(lowest, frame.ms), highest = std::max(highest, frame.ms);
      }
      EXPECT_LE(highest - lowest, 0.05 * 50);
      EXPECT_GE(lowest, 0.90 * 50);
      EXPECT_LE(highest, 50);
    }
  }
}

TEST(DeadlinePolicyTest, WithWhiteNoiseTwoPercentAreMissedAtMost) {
  for (const double noise : {0.05, 0.15, 0.30}) {
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u, 5u}) {
      SCOPED_TRACE(testing::Message() << "noise " << noise << ", seed " << seed);
      SimulatedMachine machine(test::wide_config(50));
      test::frames_with_noise(machine, load_before({50, 0.2, 2000, 1}), 50, noise, seed);
      EXPECT_NEAR(machine.policy.deviation(), noise, 0.35 * noise);
    }
  }
}

TEST(DeadlinePolicyTest, ATargetOutOfReachEndsAtTheFloorAndSaysSo) {
  SimulatedMachine machine(test::wide_config(50, 98, 788));
  Load load;
  load.fixed_ms = 40;
  load.column_ms = 0.2;  // 98 columns: 59.6 ms in all
  for (const SimulatedFrame& frame : machine.frames(200, [&](int) { return load; })) {
    EXPECT_EQ(frame.decision.quality.polar_width, 98);
  }
  EXPECT_EQ(machine.frame(load).decision.reason, QualityReason::floor_too_slow);
  EXPECT_NEAR(*machine.frame(load).decision.predicted_ms, 59.6, 1e-6);
  load.fixed_ms = 30;  // 49.6 ms: within the target, though not within the head-room
  machine.frames(20, [&](int) { return load; });
  EXPECT_EQ(machine.frame(load).decision.reason, QualityReason::floor);
  load.fixed_ms = 0;
  machine.frames(20, [&](int) { return load; });
  EXPECT_GT(machine.frame(load).decision.quality.polar_width, 230) << "reachable again: 0.97 * 250";
}

TEST(DeadlinePolicyTest, AFrameThatIsMissedForOtherReasonsIsOverloadToo) {
  // Frames take half of the target by every clock, and yet are reported missed: the width falls all the same.
  SimulatedMachine machine(test::wide_config(50, 10, 1000));
  Load load;
  load.column_ms = 0.025;
  machine.frames(kSettled, [&](int) { return load; });
  int width = 1000;
  for (int i = 0; i < 30; ++i) {
    const FrameQuality quality = machine.policy.decide({1, 1000, 0}).quality;
    FrameCost cost = test::cost_of(load, quality, machine.now_ns += 50'000'000, 50);
    cost.missed = true;
    machine.policy.observe(cost);
    EXPECT_LE(quality.polar_width, std::max(10.0, (i >= 2 ? 0.8 : 1.02) * width)) << i;
    width = quality.polar_width;
  }
  EXPECT_EQ(width, 10);
}

TEST(DeadlinePolicyTest, AHiccupCostsAFewNarrowFrames) {
  // One frame of 3 times the cost, one of a tenth more: believed for a frame, then forgotten. After a miss
  // the width does not grow for two frames, and from a third it is back after two doublings.
  for (const double factor : {3.0, 1.1}) {
    SimulatedMachine machine(test::wide_config(50));
    Load load = load_before({50, 0.2, 2000, 1});
    machine.frames(kSettled, [&](int) { return load; });
    const int before = machine.frame(load).decision.quality.polar_width;
    load.factor = factor;
    machine.frame(load);
    load.factor = 1;
    const std::vector<SimulatedFrame> after = machine.frames(6, [&](int) { return load; });
    EXPECT_LT(after.front().decision.quality.polar_width, before) << factor;
    EXPECT_NEAR(after.back().decision.quality.polar_width, before, 0.03 * before) << factor;
    for (const SimulatedFrame& frame : after) EXPECT_LE(frame.ms, 50) << factor;
  }
}

void expect_sound(DeadlinePolicy& policy, const DeadlineConfig& config) {
  const QualityDecision decision = policy.decide(config.limits.full);
  ASSERT_GE(decision.quality.polar_width, config.limits.narrowest);
  ASSERT_LE(decision.quality.polar_width, config.limits.full.polar_width);
  ASSERT_GE(decision.quality.light_samples, 1);
  ASSERT_LE(decision.quality.light_samples, config.limits.full.light_samples);
  ASSERT_GE(decision.quality.probes, config.limits.fewest_probes);
  ASSERT_LE(decision.quality.probes, config.limits.full.probes);
  ASSERT_TRUE(std::isfinite(policy.headroom()));
  ASSERT_TRUE(std::isfinite(*decision.aim_ms));
  ASSERT_GT(*decision.aim_ms, 0);
  ASSERT_TRUE(std::isfinite(decision.predicted_ms.value_or(0)));
}

TEST(DeadlinePolicyTest, TimesThatAreNoneLeaveItSound) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr TimeNs kHours = 5 * 3'600'000'000'000;
  const std::uint32_t seed = 7;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  DeadlineConfig config = test::wide_config(50, 98, 788);
  config.limits = quality_limits({64, 788, 2048}, 98);
  SimulatedMachine machine(config);
  const Load load{10, 0.02, 0.001, 0.002, 1};
  const std::vector<double> times{kInfinity, -kInfinity, kNaN, 0.0, -1.0, 1e300, 5e-324, 1e7, 40.0};
  const std::vector<TimeNs> steps{0,
                                  kHours,
                                  -kHours,
                                  1,
                                  -1,
                                  50'000'000,
                                  std::numeric_limits<TimeNs>::max() / 4,
                                  std::numeric_limits<TimeNs>::min() / 4};
  for (int i = 0; i < 20000; ++i) {
    FrameCost cost =
        test::cost_of(load, machine.policy.decide(config.limits.full).quality, 0, config.target_ms);
    if (random() % 3 == 0) cost.total_ms = times[random() % times.size()];
    if (random() % 3 == 0) cost.work_ms[random() % kWorkKinds] = times[random() % times.size()];
    if (random() % 5 == 0) cost.rays[random() % kWorkKinds] = static_cast<std::int64_t>(random() % 3) - 1;
    cost.finished_ns = machine.now_ns +=
        random() % 3 == 0 ? steps[random() % steps.size()] / 1000 : 50'000'000;
    machine.policy.observe(cost);
    ASSERT_NO_FATAL_FAILURE(expect_sound(machine.policy, config)) << i;
  }
  // And it finds back: 10 ms + 2048 * 0.002 ms leave (48.5 - 14.1) / 0.02 columns and more, all 788.
  machine.frames(100, [&](int) { return load; });
  const SimulatedFrame frame = machine.frame(load);
  EXPECT_LE(frame.ms, 50);
  EXPECT_GT(frame.decision.quality.polar_width, 394);
}

TEST(DeadlinePolicyTest, AFrameThatNeverEndsThenFramesOfNoTimeThenClocksThatJump) {
  DeadlineConfig config = test::wide_config(50, 98, 788);
  SimulatedMachine machine(config);
  const Load load = load_before({50, 0.2, 400, 1});
  machine.frames(kSettled, [&](int) { return load; });
  const auto observe = [&](double total_ms, TimeNs after_ns) {
    FrameCost cost = test::cost_of(load, machine.policy.decide(config.limits.full).quality, 0, 50);
    cost.total_ms = total_ms;
    cost.missed = false;
    cost.finished_ns = machine.now_ns += after_ns;
    machine.policy.observe(cost);
  };
  observe(std::numeric_limits<double>::infinity(), 1);
  EXPECT_EQ(machine.policy.decide(config.limits.full).quality.polar_width, 98);
  for (int i = 0; i < 50; ++i) observe(0, 0);
  EXPECT_EQ(machine.policy.decide(config.limits.full).quality.polar_width, 788);
  for (const TimeNs jump : {TimeNs{7'200'000'000'000}, TimeNs{-7'200'000'000'000}}) {
    machine.now_ns += jump;
    machine.frames(8, [&](int) { return load; });
    for (const SimulatedFrame& frame : machine.frames(30, [&](int) { return load; })) {
      EXPECT_GE(frame.ms, 0.90 * 50);
      EXPECT_LE(frame.ms, 50);
    }
  }
}

TEST(DeadlinePolicyTest, LightIsTakenBeforeTheWidthHalvesAndComesBackLater) {
  DeadlineConfig config = test::wide_config(50, 98, 788);
  config.limits = quality_limits({64, 788, 2048}, 98);
  SimulatedMachine machine(config);
  Load load{10, 0.01, 0.0002, 0.001, 1};  // in full: 10 + 7.9 + 10.1 + 2 = 30 ms
  machine.frames(400, [&](int) { return load; });
  const FrameQuality all = machine.frame(load).decision.quality;
  EXPECT_EQ(all.polar_width, 788);
  EXPECT_EQ(all.light_samples, 64);
  EXPECT_EQ(all.probes, 2048);
  load.factor = 3;  // 30 + 23.6 + 2 * ... : only a part of the light fits
  machine.frames(3, [&](int) { return load; });
  const SimulatedFrame less = machine.frame(load);
  EXPECT_LT(less.decision.quality.light_samples, 64);
  EXPECT_GE(less.decision.quality.polar_width, 394 * 0.97);
  EXPECT_LE(less.ms, 50);
  load.factor = 1;
  machine.frames(10, [&](int) { return load; });
  EXPECT_LT(machine.frame(load).decision.quality.light_samples, 64) << "half a second for each step up";
  machine.frames(400, [&](int) { return load; });
  EXPECT_EQ(machine.frame(load).decision.quality.light_samples, 64);
}

TEST(DeadlinePolicyTest, LightThatDoesNotFitIsTriedMoreAndMoreRarely) {
  // Above 8 samples each costs ten times what it costs below: what is learnt below is wrong above.
  DeadlineConfig config = test::wide_config(50, 98, 788);
  config.limits = quality_limits({64, 788, 0}, 98);
  SimulatedMachine machine(config);
  int tries = 0, last = 0, late_tries = 0;
  constexpr int kFrames = 20 * 600;  // ten minutes
  Load load;
  for (int i = 0; i < kFrames; ++i) {
    load = {5, 0.01, last > 8 ? 0.01 : 0.001, 0, 1};
    const FrameQuality next = machine.policy.decide(config.limits.full).quality;
    load.light_ms = next.light_samples > 8 ? 0.01 : 0.001;
    const SimulatedFrame frame = machine.frame(load);
    if (frame.decision.quality.light_samples > last && i > 200) {
      ++tries;
      late_tries += i > kFrames / 2 ? 1 : 0;
    }
    last = frame.decision.quality.light_samples;
  }
  // Waits of 0.5, 1, 2, ... 60 s fill ten minutes with some 7 + 600 / 60 tries of each step.
  EXPECT_LE(tries, 2 * (7 + 10));
  EXPECT_LE(late_tries, 10);
}

}  // namespace
}  // namespace herr
