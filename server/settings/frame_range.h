// Which frames of a session a replay renders, and when each of them is. Frame k lies k display periods after
// the session's start, whatever --start says: the same number is the same picture in every run. (Probes begin
// to gather light at --start.)
#pragma once

#include <cstdint>
#include <optional>

#include "sessions/format/pose.h"

namespace herr {

struct FrameRange {
  TimeNs session_start_ns = 0;
  double display_hz = 60;
  std::int64_t first = 0, count = 0;

  // Rounded to whole nanoseconds; exact to 104 days.
  TimeNs time_ns(std::int64_t frame) const;
  double period_ms() const { return 1e3 / display_hz; }
  std::int64_t middle() const { return first + count / 2; }
};

struct FrameRangeRequest {
  double start_s = 0;
  std::optional<double> duration_s;
  std::optional<std::int64_t> frames;
};

// Frames within [start_ns, end_ns] that the request covers; count is 0 when it starts past the end.
FrameRange frames_to_replay(TimeNs start_ns, TimeNs end_ns, double display_hz,
                            const FrameRangeRequest& request);

}  // namespace herr
