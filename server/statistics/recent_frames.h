// The frames of the last ten seconds, one record each: what the window's statistics are made from.
// Before: the loop of `herr serve` adds each frame. After: GET /v1/frames, window_statistics().
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>

#include "server/statistics/frame_record.h"
#include "server/statistics/run_statistics.h"

namespace herr {

struct RecentFrame {
  std::int64_t sequence = 0;  // 1 for the first frame that the server rendered, without gaps
  std::int64_t lap = 0;       // how often the sessions were replayed before
  TimeNs finished_ns = 0;     // steady clock
  FrameRecord record;
};

inline constexpr TimeNs kWindowNs = 10'000'000'000;
// 1000 frames/s, the fastest display that a profile may name, for ten seconds.
inline constexpr std::size_t kMostRecentFrames = 10'000;

// Not thread-safe.
class RecentFrames {
 public:
  // finished_ns must not decrease. Frames out of the window, and the oldest over kMostRecentFrames, go.
  void add(const RecentFrame& frame);
  const std::deque<RecentFrame>& frames() const { return frames_; }

 private:
  std::deque<RecentFrame> frames_;
};

// Statistics of the frames that were finished in (now_ns - window, now_ns].
RunStatistics window_statistics(std::span<const RecentFrame> frames, TimeNs now_ns);

}  // namespace herr
