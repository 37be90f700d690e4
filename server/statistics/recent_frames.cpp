#include "server/statistics/recent_frames.h"

namespace herr {

void RecentFrames::add(const RecentFrame& frame) {
  while (!frames_.empty() && (frames_.front().finished_ns <= frame.finished_ns - kWindowNs ||
                              frames_.size() >= kMostRecentFrames)) {
    frames_.pop_front();
  }
  frames_.push_back(frame);
}

RunStatistics window_statistics(std::span<const RecentFrame> frames, TimeNs now_ns) {
  RunStatistics statistics;
  for (const RecentFrame& frame : frames) {
    const bool inside = frame.finished_ns > now_ns - kWindowNs && frame.finished_ns <= now_ns;
    if (inside) statistics.add(frame.record);
  }
  return statistics;
}

}  // namespace herr
