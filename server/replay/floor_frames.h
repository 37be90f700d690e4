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
  // One line where frames had the least quality and still exceeded the target (FrameRecord::over_target,
  // whatever the policy foretold; the first frame, of which it knows nothing, aside); empty where none did.
  // It blames the machine where most of them were kept off the cores and their work would have fitted
  // (miss_cause.h, with the target for the period), the stage that alone takes longer than the target where
  // there is one, and the settings elsewhere. `profile_scale`: that the frames had.
  std::string warning(double profile_scale) const;

 private:
  // "viewports alone takes 25.3 ms; a smaller --profile-scale makes it shorter"; empty: none is too long.
  std::string stage_advice(double profile_scale) const;

  double target_ms_ = 0, kept_off_cpu_ms_ = 0;
  StageTimes stages_;  // sums over frames that are counted in late_
  int threads_ = 1;
  std::int64_t frames_ = 0, over_target_ = 0, late_ = 0, kept_off_ = 0, kept_off_preemptions_ = 0;
};

}  // namespace herr
