#include "server/check/measure/time_limit.h"

#include <limits>
#include <vector>

#include "renderer/timing.h"
#include "server/process/steady_time.h"

namespace herr {

TimeLimit::TimeLimit(double seconds) : end_ns_(steady_now_ns() + static_cast<TimeNs>(seconds * 1e9)) {}

double TimeLimit::seconds_left() const {
  if (!end_ns_) return std::numeric_limits<double>::infinity();
  return 1e-9 * static_cast<double>(*end_ns_ - steady_now_ns());
}

bool TimeLimit::has_room_for_another(std::span<const double> earlier_seconds) const {
  return median(std::vector<double>(earlier_seconds.begin(), earlier_seconds.end())) < seconds_left();
}

}  // namespace herr
