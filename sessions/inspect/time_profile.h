// A value over the time of a recording, in few bins whatever its length: their width doubles when the
// recording outgrows them. Before: head_meter and gaze_meter. After: the plot of `herr inspect`.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sessions/format/pose.h"

namespace herr {

// What fell into a span of time.
struct ProfileSpan {
  double peak = 0, sum = 0;  // of the values
  std::int64_t values = 0;   // instants with a value
  std::int64_t without = 0;  // instants whose value was lost

  void merge(const ProfileSpan& other);
  double mean() const { return values > 0 ? sum / static_cast<double>(values) : 0; }
};

class TimeProfile {
 public:
  // Times must not decrease. No value: lost at that instant.
  void add(TimeNs t_ns, std::optional<double> value);
  // The recording from start_ns to end_ns in `columns` spans of equal length. A span between two bins takes
  // both, so that short columns of long bins are never empty by accident.
  std::vector<ProfileSpan> columns(TimeNs start_ns, TimeNs end_ns, int columns) const;

 private:
  static constexpr std::size_t kBins = 4096;
  void halve();

  std::vector<ProfileSpan> bins_;
  std::optional<TimeNs> start_ns_;
  TimeNs width_ns_ = 1'000'000;
};

}  // namespace herr
