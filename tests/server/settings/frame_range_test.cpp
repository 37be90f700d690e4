#include "server/settings/frame_range.h"

#include <gtest/gtest.h>

namespace herr {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;

TEST(FrameRange, CoversTheSessionIncludingItsLastInstant) {
  // 2 s at 60 Hz: frames 0 ... 120, the last one exactly on the end.
  const FrameRange range = frames_to_replay(5 * kSecond, 7 * kSecond, 60, {});
  EXPECT_EQ(range.first, 0);
  EXPECT_EQ(range.count, 121);
  EXPECT_EQ(range.time_ns(0), 5 * kSecond);
  EXPECT_EQ(range.time_ns(120), 7 * kSecond);
  EXPECT_EQ(range.time_ns(1), 5 * kSecond + 16'666'667);  // 1/60 s rounded to nanoseconds
}

TEST(FrameRange, ASessionOfOneInstantHasOneFrame) {
  EXPECT_EQ(frames_to_replay(kSecond, kSecond, 60, {}).count, 1);
}

TEST(FrameRange, FrameNumbersDoNotDependOnTheStart) {
  const FrameRange whole = frames_to_replay(0, 10 * kSecond, 90, {});
  const FrameRange part = frames_to_replay(0, 10 * kSecond, 90, {2.0, 1.0, {}});
  EXPECT_EQ(part.first, 180);
  EXPECT_EQ(part.count, 90);  // [2 s, 3 s)
  EXPECT_EQ(part.time_ns(200), whole.time_ns(200));
}

TEST(FrameRange, PartsThatFollowEachOtherShareNoFrameAndLeaveNoneOut) {
  for (const double hz : {59.94, 60.0, 72.0, 90.0, 120.0, 1000.0}) {
    std::int64_t next = 0;
    for (int i = 0; i < 40; ++i) {
      const FrameRange part = frames_to_replay(123, 10 * kSecond, hz, {0.1 * i, 0.1, {}});
      EXPECT_EQ(part.first, next) << hz << " part " << i;
      next = part.first + part.count;
    }
  }
}

TEST(FrameRange, FramesAndDurationLimitEachOther) {
  EXPECT_EQ(frames_to_replay(0, 10 * kSecond, 60, {0, 1.0, 7}).count, 7);
  EXPECT_EQ(frames_to_replay(0, 10 * kSecond, 60, {0, 0.05, 7}).count, 3);  // 0, 16.7, 33.3 ms
}

TEST(FrameRange, AStartPastTheEndGivesNoFrame) {
  EXPECT_EQ(frames_to_replay(0, kSecond, 60, {1.001, {}, {}}).count, 0);
  EXPECT_EQ(frames_to_replay(0, kSecond, 60, {1e7, {}, {}}).count, 0);
  EXPECT_EQ(frames_to_replay(0, kSecond, 60, {1.0, {}, {}}).count, 1);
  EXPECT_EQ(frames_to_replay(0, kSecond, 60, {0.5, 0.0, {}}).count, 0);
}

TEST(FrameRange, LongSessionsKeepNanosecondStamps) {
  // 40 days at 60 Hz: frame 60 * 86400 * 40 lies exactly on the last second.
  const TimeNs end = 40LL * 86400 * kSecond;
  const FrameRange range = frames_to_replay(0, end, 60, {});
  EXPECT_EQ(range.count, 60LL * 86400 * 40 + 1);
  EXPECT_EQ(range.time_ns(range.count - 1), end);
}

}  // namespace
}  // namespace herr
