// Quality from head motion: all of it at rest, less by the logarithm of the speed, never below the limits.
#include "server/quality/motion_policy.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "server/quality/quality_controller.h"
#include "sessions/streams/head_speed.h"
#include "tests/server/quality/simulated_machine.h"

namespace herr {
namespace {

HeadSpeed turning(double deg_s) {
  return {glm::radians(deg_s), 0};
}

const QualityLimits kLimits = quality_limits({64, 788, 2048}, 98);

TEST(MotionPolicyTest, AStillHeadHasEverything) {
  for (const double deg_s : {0.0, 22.6, 34.99}) {
    const QualityDecision decision = quality_for_motion(turning(deg_s), kLimits);
    EXPECT_EQ(decision.quality.polar_width, 788);
    EXPECT_EQ(decision.quality.light_samples, 64);
    EXPECT_EQ(decision.reason, QualityReason::head_still);
  }
}

TEST(MotionPolicyTest, AFastHeadHasTwoFifthsOfTheWidthAndHardShadows) {
  for (const double deg_s : {95.0, 500.0, 1e300}) {
    const QualityDecision decision = quality_for_motion(turning(deg_s), kLimits);
    EXPECT_EQ(decision.quality.polar_width, 315) << "0.4 * 788 = 315.2";
    EXPECT_EQ(decision.quality.light_samples, 1);
    EXPECT_EQ(decision.quality.probes, 2048) << "probes carry over: they do not follow motion";
    EXPECT_EQ(decision.reason, QualityReason::head_moving);
  }
}

TEST(MotionPolicyTest, HalfwayOnTheLogarithmicScaleBothAreGeometricMeans) {
  // sqrt(35 * 95) = 57.7 deg/s: 788 * sqrt(0.4) = 498.4, sqrt(64) = 8.
  const QualityDecision decision = quality_for_motion(turning(std::sqrt(35.0 * 95.0)), kLimits);
  EXPECT_EQ(decision.quality.polar_width, 498);
  EXPECT_EQ(decision.quality.light_samples, 8);
}

TEST(MotionPolicyTest, FasterIsNeverMore) {
  FrameQuality before = kLimits.full;
  for (double deg_s = 1; deg_s < 1000; deg_s *= 1.01) {
    const FrameQuality quality = quality_for_motion(turning(deg_s), kLimits).quality;
    EXPECT_LE(quality.polar_width, before.polar_width);
    EXPECT_LE(quality.light_samples, before.light_samples);
    EXPECT_TRUE(quality.light_samples == 64 ||
                std::has_single_bit(static_cast<unsigned>(quality.light_samples)));
    before = quality;
  }
}

TEST(MotionPolicyTest, MetresCountAsTheAngleThatTheyAreSeenUnder) {
  // 1 m/s seen from 2 m: half a radian a second, 28.6 degrees.
  EXPECT_NEAR(motion_deg_s({0, 1}), 28.648, 0.001);
  EXPECT_NEAR(motion_deg_s({glm::radians(30.0), 1}), 58.648, 0.001);
}

// One second of sway, a turn by 60 degrees at 120 degrees a second, and rest.
TEST(MotionPolicyTest, SwayKeepsEverythingATurnHardensAndItsEndSoftensAgain) {
  HeadSpeedMeter meter;
  double yaw_deg = 0;
  const auto at = [&](int step, double deg_s) {
    yaw_deg += deg_s * 0.01;
    meter.add(step * TimeNs{10'000'000}, {{}, glm::angleAxis(glm::radians(yaw_deg), glm::dvec3(0, 1, 0))});
    return quality_for_motion(meter.speed(), kLimits);
  };
  int step = 0;
  // 2 degrees to and fro, 1.5 times a second: 2 * 2 pi * 1.5 = 18.8 deg/s at most.
  for (; step < 100; ++step) {
    EXPECT_EQ(at(step, 18.8 * std::cos(0.03 * glm::pi<double>() * step)).quality.light_samples, 64) << step;
  }
  for (; step < 150; ++step) {
    const QualityDecision decision = at(step, 120);
    // The velocity goes from the sway's, -18.8 at most, to 120 with 20 ms: above 95 from
    // t = 20 ms * ln(138.8 / 25) = 34 ms on.
    if (step < 105) continue;
    EXPECT_EQ(decision.quality.light_samples, 1) << step;
    EXPECT_EQ(decision.quality.polar_width, 315) << step;
  }
  // The velocity goes to 0 with 20 ms, the speed follows it with 250 ms: 120 * 250 / 230 exp(-t / 250 ms)
  // once the former is gone. That is 35 after 250 ms * ln(130.4 / 35) = 329 ms: in the 33rd row.
  for (const int end = step + 60; step < end; ++step) {
    const QualityDecision decision = at(step, 0);
    EXPECT_EQ(decision.quality.polar_width == 788, step - 149 >= 33) << step;
  }
}

TEST(MotionPolicyTest, TheNarrowestWidthHolds) {
  const QualityLimits limits = quality_limits({1, 788, 0}, 600);
  EXPECT_EQ(quality_for_motion(turning(300), limits).quality.polar_width, 600);
  const QualityLimits one = quality_limits({1, 1, 0}, 1);
  EXPECT_EQ(quality_for_motion(turning(300), one).quality.polar_width, 1);
}

TEST(QualityControllerTest, FixedIsWhatTheSettingsSay) {
  QualityController controller({}, kLimits, 50);
  const QualityDecision decision = controller.decide(turning(300));
  EXPECT_EQ(decision.quality.polar_width, 788);
  EXPECT_EQ(decision.reason, QualityReason::fixed);
  EXPECT_FALSE(decision.predicted_ms);
}

TEST(QualityControllerTest, MotionDoesNotAskWhatFramesCost) {
  QualityController controller({true, false}, kLimits, 50);
  for (int i = 0; i < 10; ++i) {
    const QualityDecision decision = controller.decide(turning(100));
    EXPECT_EQ(decision.quality.polar_width, 315);
    controller.observe(test::cost_of({1000, 10, 0, 0, 1}, decision.quality, i * 50'000'000, 50));
  }
}

TEST(QualityControllerTest, TogetherTheSmallerOfBothHolds) {
  const QualityLimits limits = quality_limits({1, 788, 0}, 98);
  QualityController controller({true, true}, limits, 50);
  TimeNs now_ns = 0;
  const auto run = [&](double deg_s, double column_ms) {
    QualityDecision decision;
    for (int i = 0; i < 40; ++i) {
      decision = controller.decide(turning(deg_s));
      controller.observe(test::cost_of({0, column_ms, 0, 0, 1}, decision.quality, now_ns += 50'000'000, 50));
    }
    return decision;
  };
  QualityDecision decision = run(0, 0.01);
  EXPECT_EQ(decision.quality.polar_width, 788);
  EXPECT_EQ(decision.reason, QualityReason::head_still);
  decision = run(100, 0.01);
  EXPECT_EQ(decision.quality.polar_width, 315);
  EXPECT_EQ(decision.reason, QualityReason::head_moving);
  decision = run(100, 0.25);  // 50 / 1.03 / 0.25 = 194 columns
  EXPECT_NEAR(decision.quality.polar_width, 194, 4);
  EXPECT_EQ(decision.reason, QualityReason::steady);
}

}  // namespace
}  // namespace herr
