// The clock `realtime`, without a clock in it: which frame of a session is due, and what became of it.
// Display tick k is the time of frame k; a frame begins at its tick, or late with the newest frame that is
// due, and is shown at the first tick at or after its completion. What is late is never caught up with: the
// work of a frame does not depend on how late the one before was. Before: the replay loop says what time it
// is. After: FrameRecord::missed, dropped_frames, repeated_ticks.
#pragma once

#include <cstdint>
#include <optional>

#include "sessions/format/pose.h"

namespace herr {

// Not thread-safe. All times are nanoseconds of one clock that never goes back.
class FramePacer {
 public:
  // Frame `first` is due at origin_ns, the others period_ns apart; `count` frames in all.
  FramePacer(TimeNs origin_ns, double period_ns, std::int64_t first, std::int64_t count);

  struct Begin {
    std::int64_t frame = 0;
    TimeNs due_ns = 0;         // begin now if this is past, otherwise wait for it
    std::int64_t dropped = 0;  // frames left out just before this one
  };
  // The next frame to render; none when the session is over (frames_dropped_at_end() is then known).
  std::optional<Begin> begin(TimeNs now_ns);

  struct Outcome {
    bool missed = false;         // finished_ns > started_ns + period
    std::int64_t repeated = 0;   // ticks since the presentation before that showed nothing new
    TimeNs presentation_ns = 0;  // a tick
    double shown_after_ms = 0;   // from the frame's own tick to its presentation
  };
  // Of the frame that begin() named last; started_ns is when its work began.
  Outcome finish(TimeNs started_ns, TimeNs finished_ns);

  TimeNs tick_ns(std::int64_t frame) const;
  std::int64_t frames_dropped_at_end() const { return dropped_at_end_; }

 private:
  std::int64_t last_tick_at(TimeNs now_ns) const;
  std::int64_t first_tick_from(TimeNs now_ns) const;

  const TimeNs origin_ns_;
  const double period_ns_;
  const std::int64_t first_, end_;
  std::int64_t current_;  // the frame begun last
  std::optional<std::int64_t> shown_tick_;
  std::int64_t dropped_at_end_ = 0;
};

}  // namespace herr
