// How long the intervals of a stream are, or how old its samples: quantiles within 1 % in little memory
// whatever the length. Nanoseconds, 0 or more.
// Before: import_rows, stream_meter, frame_ages. After: reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sessions/format/pose.h"

namespace herr {

// Longer than this many usual intervals: at least one sample is missing.
inline constexpr double kHitchIntervals = 1.5;

class IntervalCensus {
 public:
  // `line`: where it ends. `times`: that many intervals of this length.
  void count(TimeNs interval_ns, std::int64_t line, std::int64_t times = 1);

  std::int64_t intervals() const { return intervals_; }
  // Mean of the intervals within 1 % of the quantile (nearest rank); the longest is exact. 0 when there is
  // none. fraction in [0, 1].
  double quantile_ns(double fraction) const;
  double median_ns() const { return quantile_ns(0.5); }
  // Standard deviation of the intervals of at most kHitchIntervals medians.
  double jitter_ns() const;
  std::int64_t hitches() const;  // intervals of more than kHitchIntervals medians
  TimeNs widest_ns() const { return widest_ns_; }
  std::int64_t widest_line() const { return widest_line_; }

 private:
  struct Bucket {
    int name = 0;                   // by logarithm
    TimeNs from_ns = 0, to_ns = 0;  // intervals that certainly belong to it
    std::int64_t intervals = 0;
    double sum_ns = 0, sum_squares = 0;

    double mean_ns() const { return sum_ns / static_cast<double>(intervals); }
  };
  Bucket& bucket_of(TimeNs interval_ns);

  std::vector<Bucket> buckets_;  // by name
  std::size_t last_ = 0;         // where the last interval was counted
  std::int64_t intervals_ = 0;
  TimeNs widest_ns_ = 0;
  std::int64_t widest_line_ = 0;
};

}  // namespace herr
