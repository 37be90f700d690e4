// The time that a whole check may take. Before: --max-seconds. After: runs that would not end in time are not
// begun, one that does not is ended.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>

#include "sessions/format/pose.h"

namespace herr {

// A run did not end in time and is no measurement.
class OutOfTime : public std::runtime_error {
 public:
  OutOfTime() : std::runtime_error("no run ended in time") {}
};

class TimeLimit {
 public:
  TimeLimit() = default;  // none
  // Counts from now. `seconds` is positive.
  explicit TimeLimit(double seconds);

  double seconds_left() const;  // infinite where there is no limit, negative after it
  // Will another turn end in time, if it takes as long as the middle one of the earlier turns? Where there
  // are none, whether any time is left.
  bool has_room_for_another(std::span<const double> earlier_seconds) const;

 private:
  std::optional<TimeNs> end_ns_;
};

}  // namespace herr
