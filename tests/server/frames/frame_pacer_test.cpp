// The clock `realtime`, driven by a clock of the test: nothing here sleeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "server/frames/frame_pacer.h"

namespace herr {
namespace {

constexpr TimeNs kPeriodNs = 10'000'000;
constexpr TimeNs kOriginNs = 5'000'000'000;

struct Replay {
  std::vector<std::int64_t> frames;
  std::int64_t missed = 0, dropped = 0, repeated = 0;
  TimeNs end_ns = 0;
  std::vector<double> shown_after_ms;
};

// Every frame takes what `cost_ns` says; waiting costs no time of the test.
template <typename Cost>
Replay simulate(std::int64_t count, Cost cost_ns) {
  FramePacer pacer(kOriginNs, static_cast<double>(kPeriodNs), 0, count);
  Replay run;
  TimeNs now_ns = kOriginNs;
  while (const auto begin = pacer.begin(now_ns)) {
    const TimeNs started_ns = std::max(now_ns, begin->due_ns);
    now_ns = started_ns + cost_ns(begin->frame);
    const FramePacer::Outcome outcome = pacer.finish(started_ns, now_ns);
    run.frames.push_back(begin->frame);
    run.missed += outcome.missed ? 1 : 0;
    run.dropped += begin->dropped;
    run.repeated += outcome.repeated;
    run.shown_after_ms.push_back(outcome.shown_after_ms);
    EXPECT_GE(outcome.presentation_ns, now_ns);
    EXPECT_LT(outcome.presentation_ns - now_ns, kPeriodNs);
  }
  run.dropped += pacer.frames_dropped_at_end();
  run.end_ns = now_ns;
  return run;
}

TEST(FramePacer, FramesInTimeAreAllRenderedAndShownOneTickLater) {
  const Replay run = simulate(100, [](std::int64_t) { return kPeriodNs - 1; });
  EXPECT_EQ(run.frames.size(), 100u);
  EXPECT_EQ(run.missed, 0);
  EXPECT_EQ(run.dropped, 0);
  EXPECT_EQ(run.repeated, 0);
  for (const double after_ms : run.shown_after_ms) EXPECT_DOUBLE_EQ(after_ms, 10.0);
}

// Exactly one period: done at the next tick, shown there, not missed (missed is later than start + period).
TEST(FramePacer, AFrameOfExactlyOnePeriodIsInTime) {
  const Replay run = simulate(50, [](std::int64_t) { return kPeriodNs; });
  EXPECT_EQ(run.frames.size(), 50u);
  EXPECT_EQ(run.missed, 0);
  EXPECT_EQ(run.repeated, 0);
}

// 2.5 periods each: begun at 0, 2.5, 5, 7.5, ... with frames 0, 2, 5, 7, ... (the newest that is due); shown
// at ticks 3, 5, 8, 10, ...: of every five ticks two have a new frame and three repeat.
TEST(FramePacer, FramesThatAreTooSlowDropAndRepeatAtTheRateOfTheOverload) {
  const Replay run = simulate(100, [](std::int64_t) { return 5 * kPeriodNs / 2; });
  ASSERT_EQ(run.frames.size(), 40u);
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    EXPECT_EQ(run.frames[i], static_cast<std::int64_t>(i * 5 / 2));
  }
  EXPECT_EQ(run.missed, 40);
  EXPECT_EQ(run.dropped, 60);
  // From tick 3 to tick ceil(39 * 2.5 + 2.5) = 100 there are 97 ticks, 39 of them with a new frame.
  EXPECT_EQ(run.repeated, 97 - 39);
}

TEST(FramePacer, OneFrameOfTenSecondsIsOneMissAndNoSpiral) {
  const Replay run =
      simulate(2000, [](std::int64_t frame) { return frame == 3 ? 1000 * kPeriodNs : kPeriodNs / 2; });
  EXPECT_EQ(run.missed, 1);
  // Frame 3 ends at tick 1003, where frame 1003 is due: 4 ... 1002 were never rendered.
  EXPECT_EQ(run.dropped, 999);
  // Shown: frame 2 at tick 3, frame 3 at tick 1003; between them 999 ticks.
  EXPECT_EQ(run.repeated, 999);
  EXPECT_EQ(run.frames.size(), 2000u - 999u);
  // The last frame begins at its tick as if nothing had been.
  EXPECT_EQ(run.end_ns, kOriginNs + 1999 * kPeriodNs + kPeriodNs / 2);
}

TEST(FramePacer, FramesLeftOverWhenTheSessionEndsCountAsDropped) {
  const Replay run = simulate(10, [](std::int64_t) { return 100 * kPeriodNs; });
  EXPECT_EQ(run.frames, std::vector<std::int64_t>{0});
  EXPECT_EQ(run.dropped, 9);
}

// Whatever the load: every frame is rendered once or dropped once, in order, and the run ends when the
// session does or when its last frame is done.
TEST(FramePacer, AnyLoadAccountsForEveryFrame) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 200; ++round) {
    std::exponential_distribution<double> load(1.0 / (0.2 + 0.01 * round));
    TimeNs longest_ns = 0;
    const Replay run = simulate(500, [&](std::int64_t) {
      const auto cost_ns = static_cast<TimeNs>(load(random) * static_cast<double>(kPeriodNs));
      longest_ns = std::max(longest_ns, cost_ns);
      return cost_ns;
    });
    EXPECT_EQ(static_cast<std::int64_t>(run.frames.size()) + run.dropped, 500) << "round " << round;
    for (std::size_t i = 1; i < run.frames.size(); ++i) EXPECT_GT(run.frames[i], run.frames[i - 1]);
    // A frame begins less than one period late, plus one frame of waiting for the one before.
    EXPECT_LE(run.end_ns, kOriginNs + 500 * kPeriodNs + 2 * longest_ns) << "round " << round;
  }
}

// 1/60 s is no whole number of nanoseconds: ticks stay within half a nanosecond of the true ones for hours.
TEST(FramePacer, TicksDoNotDrift) {
  FramePacer pacer(0, 1e9 / 60, 0, std::int64_t{1} << 40);
  EXPECT_EQ(pacer.tick_ns(60 * 3600 * 24), TimeNs{3600} * 24 * 1'000'000'000);
  for (std::int64_t frame = 0; frame < 100000; frame += 7) {
    const TimeNs tick_ns = pacer.tick_ns(frame);
    FramePacer fresh(0, 1e9 / 60, 0, std::int64_t{1} << 40);
    EXPECT_EQ(fresh.begin(tick_ns)->frame, frame);
  }
}

}  // namespace
}  // namespace herr
