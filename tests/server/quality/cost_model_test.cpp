// What frames of another quality will take, from frames that were measured.
#include "server/quality/cost_model.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/server/quality/simulated_machine.h"

namespace herr {
namespace {

constexpr test::Load kLoad{5, 0.02, 0.003, 0.001, 1};

double truth_ms(const FrameQuality& quality) {
  return 5 + quality.polar_width * (0.02 + 0.003 * quality.light_samples) + 0.001 * quality.probes;
}

TEST(CostModelTest, ForetellsAFrameOfAnyQualityFromOne) {
  CostModel model;
  model.learn(test::cost_of(kLoad, {4, 400, 256}, 0, 50), 0);
  for (const FrameQuality& quality : {FrameQuality{4, 400, 256}, {1, 98, 128}, {64, 788, 2048}, {1, 1, 0}}) {
    // Counts of rays are whole numbers: one of 500 * 400 at most is lost.
    EXPECT_NEAR(model.predict_ms(quality), truth_ms(quality), 1e-5 * truth_ms(quality));
    EXPECT_NEAR(model.width_for(truth_ms(quality), quality), quality.polar_width,
                1e-4 * quality.polar_width + 1e-9);
  }
  EXPECT_EQ(model.width_for(4.9, {1, 788, 0}), 0) << "the fixed part alone is 5 ms";
}

// Half the rows: half the rays of a column, and twice the columns in the same time.
TEST(CostModelTest, ALowerFrameHasShorterColumns) {
  test::Load load{0, 0.02, 0.003, 0, 1};
  load.rows = 768;
  CostModel model;
  model.learn(test::cost_of(load, {4, 400, 0, 768}, 0, 50), 0);
  const double whole_ms = 400 * (0.02 + 4 * 0.003);
  EXPECT_NEAR(model.predict_ms({4, 400, 0, 768}), whole_ms, 1e-4);
  EXPECT_NEAR(model.predict_ms({4, 400, 0, 384}), whole_ms / 2, 1e-4);
  EXPECT_NEAR(model.width_for(whole_ms, {4, 400, 0, 384}), 800, 0.01);
}

TEST(CostModelTest, ForgetsByWhatItIsToldToKeep) {
  // Twice as slow from one frame to the next: times follow by 1 - exp(-dt / tau).
  CostModel model;
  const FrameQuality quality{1, 400, 0};
  model.learn(test::cost_of(kLoad, quality, 0, 50), 0);
  const double before = model.predict_ms(quality);
  test::Load slower = kLoad;
  slower.factor = 2;
  const double keep = std::exp(-0.05 / 0.25);
  model.learn(test::cost_of(slower, quality, 0, 50), keep);
  EXPECT_NEAR(model.predict_ms(quality), before * (2 - keep), 1e-9);
}

TEST(CostModelTest, BelievesMoreRaysAtOnceAndFewerAsItBelievesTimes) {
  // Rays from the eye that take the same time each, whatever their number.
  CostModel model;
  const FrameQuality quality{1, 400, 0};
  const FrameCost many = test::cost_of({0, 0.1, 0, 0, 1}, quality, 0, 50);
  FrameCost few = many;
  few.rays[0] /= 2, few.work_ms[0] /= 2, few.total_ms /= 2;
  model.learn(few, 0);
  EXPECT_NEAR(model.predict_ms(quality), 20, 1e-9);
  model.learn(many, 0.999);
  EXPECT_NEAR(model.predict_ms(quality), 40, 1e-9);
  model.learn(few, 0.75);
  EXPECT_NEAR(model.predict_ms(quality), 20 + 0.75 * 20, 1e-9);
}

TEST(CostModelTest, TimeWithoutRaysIsFixed) {
  CostModel model;
  FrameCost cost;
  cost.quality = {1, 100, 0};
  cost.total_ms = 12;
  cost.work_ms[0] = 7;
  model.learn(cost, 0);
  EXPECT_NEAR(model.predict_ms({1, 800, 0}), 12, 1e-12);
  EXPECT_EQ(model.width_for(20, {1, 800, 0}), 1e9);
}

TEST(CostModelTest, ShareOfIdleThreadsGoesToTheWorkTheyWaitFor) {
  RenderedFrame frame;
  frame.quality = {1, 100, 0};
  frame.times[Stage::first_hits] = 6;
  frame.times[Stage::light_rays] = 2;
  frame.times[Stage::viewports] = 2;
  frame.times[Stage::idle] = 5;
  frame.times[Stage::other] = 1;
  frame.counters.rays[RayKind::primary] = 1000;
  frame.counters.rays[RayKind::shadow] = 500;
  const FrameCost cost = frame_cost(frame, 16, false, 7);
  EXPECT_NEAR(cost.work_ms[static_cast<std::size_t>(WorkKind::eye)], 9, 1e-12);  // 6 * (1 + 5 / 10)
  EXPECT_NEAR(cost.work_ms[static_cast<std::size_t>(WorkKind::light)], 3, 1e-12);
  CostModel model;
  model.learn(cost, 0);
  EXPECT_NEAR(model.predict_ms({1, 200, 0}), 16 + 9 + 3, 1e-9);
}

TEST(CostModelTest, StaysFiniteWhateverItLearns) {
  CostModel model;
  FrameCost cost = test::cost_of(kLoad, {1, 100, 10}, 0, 50);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0, 1e300}) {
    cost.total_ms = bad;
    cost.work_ms.fill(bad);
    for (const double keep : {0.0, 0.5, 1.0}) {
      model.learn(cost, keep);
      EXPECT_TRUE(std::isfinite(model.predict_ms({4096, 8192, 65536})));
      EXPECT_TRUE(std::isfinite(model.width_for(50, {1, 8192, 0})));
    }
  }
}

}  // namespace
}  // namespace herr
