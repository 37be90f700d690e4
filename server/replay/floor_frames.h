// Frames of a run that had as little quality as the policy `deadline` may give, and what made those late that
// took longer than its target all the same. Before: FrameRecords. After: a warning of the run.
#pragma once

#include <cstdint>
#include <string>

#include "server/statistics/frame_record.h"

namespace herr {

// Not thread-safe.
class FloorFrames {
 public:
  // `target_ms`: what the policy holds; `threads`: that render, as far as there are cores for them.
  void add(const FrameRecord& record, double target_ms, int threads);
  // One line where frames had the least quality and still were too slow; empty where none was. It blames the
  // machine where most of those that exceeded the target were kept off the cores and their work would have
  // fitted (miss_cause.h, with the target for the period), and the settings elsewhere.
  std::string warning() const;

 private:
  double target_ms_ = 0, kept_off_cpu_ms_ = 0;
  int threads_ = 1;
  std::int64_t frames_ = 0, out_of_reach_ = 0, late_ = 0, kept_off_ = 0, kept_off_preemptions_ = 0;
};

}  // namespace herr
