// Where nothing holds there is always something to ask next.
#include "server/study/rate/next_try.h"

#include <gtest/gtest.h>

#include "tests/server/study/rate/simulated_rate.h"

namespace herr {
namespace {

constexpr double kPeriod_ms = 10;
const FramePlan kPlain;

FramePlan over_a_feed() {
  FramePlan plan;
  plan.camera = true;
  return plan;
}

// Frames of 30 ms on average, most of it the stage.
MeasuredRate smallest_of(Stage stage, double ms) {
  RateTrial trial = test::trial_of(40);
  trial.frame_ms = 30;
  trial.stages[stage] = ms;
  return {{98, 192, 1, 0.1}, {trial}, 40};
}

TEST(NextTry, LeavesOutWhatFlagsLeaveOutFirst) {
  MeasuredRate smallest = smallest_of(Stage::viewports, 20);
  smallest.trials.front().stages[Stage::occlusion] = 9;
  const NextTry next = next_try(smallest, {}, kPlain, kPeriod_ms);
  EXPECT_EQ(flags_text(next.changes), "--occlusion-rays 0");
  EXPECT_EQ(next.words, "without what flags leave out");
  EXPECT_FALSE(next.hz);
}

// One stage has what mirrors and what glass show; of a scene without glass no flag of glass is proposed.
TEST(NextTry, LeavesOutOnlyWhatTheSceneHas) {
  const MeasuredRate smallest = smallest_of(Stage::second_hits, 20);
  FramePlan plan;
  plan.mirror_rays = true;
  EXPECT_EQ(flags_text(next_try(smallest, {}, plan, kPeriod_ms).changes), "--no-reflections");
  plan.refraction = true;
  EXPECT_EQ(flags_text(next_try(smallest, {}, plan, kPeriod_ms).changes), "--no-reflections --no-refraction");
}

// Surroundings are indirect light, too: with probes off that stage stays, and half of --polar is next.
TEST(NextTry, LeavesOutNothingTwice) {
  RenderSettings asked;
  asked.probes.on = false;
  EXPECT_EQ(flags_text(next_try(smallest_of(Stage::indirect_light, 20), {}, kPlain, kPeriod_ms).changes),
            "--no-probes");
  EXPECT_EQ(flags_text(next_try(smallest_of(Stage::indirect_light, 20), asked, kPlain, kPeriod_ms).changes),
            "--polar 788x384");
}

TEST(NextTry, LeavesTheFeedOutWhereThereIsOneAndViewportsTakeMost) {
  EXPECT_EQ(flags_text(next_try(smallest_of(Stage::viewports, 20), {}, over_a_feed(), kPeriod_ms).changes),
            "--no-camera");
  EXPECT_EQ(flags_text(next_try(smallest_of(Stage::first_hits, 20), {}, over_a_feed(), kPeriod_ms).changes),
            "--polar 788x384");
}

TEST(NextTry, HalvesThePolarBuffersWhereNoFlagHelps) {
  RenderSettings asked;
  asked.polar_width = 788, asked.polar_height = 768;  // --polar 1576x768
  const NextTry next = next_try(smallest_of(Stage::first_hits, 20), asked, kPlain, kPeriod_ms);
  EXPECT_EQ(flags_text(next.changes), "--polar 788x384");
  EXPECT_EQ(next.words, "with half of --polar");
}

// Viewports alone take 20 of 10 ms, or there is nothing to halve: 1000 / 40 = 25 Hz is what it is enough for.
TEST(NextTry, AsksForTheRateThatTheSmallestHoldsWhereNothingElseIsLeft) {
  const NextTry pixels = next_try(smallest_of(Stage::viewports, 20), {}, kPlain, kPeriod_ms);
  EXPECT_TRUE(pixels.changes.empty());
  EXPECT_EQ(pixels.hz, 25);
  RenderSettings small;
  small.polar_width = 40, small.polar_height = 64;
  EXPECT_EQ(next_try(smallest_of(Stage::first_hits, 20), small, kPlain, kPeriod_ms).hz, 25);
  MeasuredRate slow = smallest_of(Stage::viewports, 20);
  slow.p95_ms = 3000;  // 0.333 Hz
  EXPECT_EQ(next_try(slow, {}, kPlain, kPeriod_ms).hz, 0.333);
}

}  // namespace
}  // namespace herr
