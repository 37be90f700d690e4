#include "sessions/import/import_report.h"

#include <cmath>

namespace herr {
namespace {
// Buckets 1 % apart.
const double kLogStep = std::log(1.01);
constexpr double kHitch = 1.5;

int bucket_of(double ns) {
  return static_cast<int>(std::floor(std::log(ns) / kLogStep));
}

double mean_of(std::int64_t sum_ns, std::int64_t intervals) {
  return static_cast<double>(sum_ns) / static_cast<double>(intervals);
}
}  // namespace

void IntervalCensus::count(TimeNs interval_ns, std::int64_t line) {
  Bucket& bucket = buckets_[bucket_of(static_cast<double>(interval_ns))];
  ++bucket.intervals;
  bucket.sum_ns += interval_ns;
  ++intervals_;
  if (interval_ns <= widest_ns_) return;
  widest_ns_ = interval_ns;
  widest_line_ = line;
}

double IntervalCensus::median_ns() const {
  std::int64_t seen = 0;
  for (const auto& [name, bucket] : buckets_) {
    seen += bucket.intervals;
    if (2 * seen >= intervals_) return mean_of(bucket.sum_ns, bucket.intervals);
  }
  return 0;
}

std::int64_t IntervalCensus::hitches() const {
  const double limit_ns = kHitch * median_ns();
  std::int64_t found = 0;
  for (const auto& [name, bucket] : buckets_)
    if (mean_of(bucket.sum_ns, bucket.intervals) > limit_ns) found += bucket.intervals;
  return found;
}

}  // namespace herr
