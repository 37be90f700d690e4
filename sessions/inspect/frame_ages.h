// How old the newest sample of a stream is at each frame that `herr replay` would show: one frame for each
// display period of the replayed span, sampling `latest`. Nanoseconds.
// Before: the stamps of a stream in order. After: the table of ages.
#pragma once

#include <cstdint>
#include <optional>

#include "sessions/format/pose.h"
#include "sessions/streams/interval_census.h"

namespace herr {

class FrameAges {
 public:
  // Frames from start_ns on. A sample of forget_ns or more is no longer used; 0: samples never grow too old.
  FrameAges(TimeNs start_ns, double display_hz, TimeNs forget_ns = 0);
  // A usable sample; stamps grow. Judges the frames before it that do not lie past `end_ns`.
  void sample(TimeNs stamp_ns, std::optional<TimeNs> end_ns = {});
  // No sample comes any more: judges the frames up to end_ns.
  void finish(TimeNs end_ns);

  const IntervalCensus& ages() const { return ages_; }
  std::int64_t frames() const { return frame_; }
  std::int64_t frames_without() const { return without_; }  // none yet, or too old

 private:
  TimeNs time_ns(std::int64_t frame) const;
  void judge(std::int64_t frames, TimeNs t_ns);
  void judge_until(TimeNs last_ns);

  TimeNs start_ns_;
  double period_ns_;
  TimeNs forget_ns_;
  std::optional<TimeNs> newest_ns_;
  std::int64_t frame_ = 0;  // the next to be judged
  std::int64_t without_ = 0;
  IntervalCensus ages_;
};

}  // namespace herr
