// Which frames of a session a measurement renders, and which of them count. Before: the session's range.
// After: RateSubject goes through them, again from the start where a session is short.
#pragma once

#include <cstdint>
#include <vector>

#include "server/settings/frame_range.h"

namespace herr {

inline constexpr int kRateFrames =
    100;  // that count, of one measurement: the 95th percentile has five above it

struct RateFrame {
  std::int64_t frame = 0;
  bool counts = true;  // false: warms caches and probes up
  int stretch = 0;     // 0, 1, ... in the session's order
};

// One lap, ascending: four stretches spread evenly over the range, each of frames that follow one another as
// a display shows them, the first five of each to warm up; or all of a range that is shorter, its first five
// at most, and no more than half, to warm up.
std::vector<RateFrame> rate_frames(const FrameRange& range);

// Which frames of a measurement count, once each is rendered: those that do not warm up, and of those that do
// any that is more than 4 times the period long after another such one: then nothing is left to warm up for.
class CountedFrames {
 public:
  explicit CountedFrames(double period_ms) : period_ms_(period_ms) {}
  bool counts(const RateFrame& frame, double frame_ms);

 private:
  const double period_ms_;
  bool was_far_ = false;
};

}  // namespace herr
