// The headline of a run says what its policy did.
#include "server/replay/policy_text.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

FrameRecord frame_of(const FrameQuality& quality, QualityReason reason) {
  FrameRecord record;
  record.decision.quality = quality;
  record.decision.reason = reason;
  return record;
}

TEST(PolicyText, TellsTheRangeOfWhatTheDeadlineChose) {
  RunStatistics statistics;
  statistics.add(frame_of({1, 98, 128, 192}, QualityReason::floor_too_slow));
  statistics.add(frame_of({1, 98, 128, 384}, QualityReason::shrink));
  statistics.add(frame_of({64, 788, 2048, 768}, QualityReason::full));
  // Foretold to fit, and over the target all the same: what was measured counts.
  FrameRecord late = frame_of({1, 98, 128, 192}, QualityReason::floor);
  late.over_target = true;
  statistics.add(late);
  // Of both eyes, as --polar takes it: 2 (98 + 98 + 788 + 98) / 4 = 541; (192 + 384 + 768 + 192) / 4 = 384;
  // 67 / 4; 2432 / 4.
  EXPECT_EQ(
      policy_text(statistics, {false, true}),
      "deadline: polar width 196 ... 1576 (mean 541), height 192 ... 768 (mean 384), light samples 1 ... 64 "
      "(mean 17), probes 128 ... 2048 (mean 608), 2 of 4 frames at the floor, 1 of them over the target");
}

TEST(PolicyText, ARunThatBeginsKnowingNothingSaysThatItWarmsUp) {
  RunStatistics statistics;
  statistics.add(frame_of({1, 98, 0, 192}, QualityReason::start));
  EXPECT_EQ(policy_text(statistics, {false, true}),
            "deadline: polar width 196, height 192, light samples 1; its first tens of frames are a warm-up "
            "from the floor");
}

TEST(PolicyText, WhatNeverChangedIsOneNumber) {
  RunStatistics statistics;
  statistics.add(frame_of({1, 315, 0, 768}, QualityReason::head_moving));
  statistics.add(frame_of({1, 788, 0, 768}, QualityReason::head_still));
  EXPECT_EQ(policy_text(statistics, {true, false}),
            "motion: polar width 630 ... 1576 (mean 1103), height 768, light samples 1");
  EXPECT_EQ(policy_text(statistics, {false, false}), "");
  EXPECT_EQ(policy_text({}, {false, true}), "");
}

}  // namespace
}  // namespace herr
