#include "sessions/streams/interval_census.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace herr {
namespace {
// Buckets 1 % apart.
const double kLogStep = std::log(1.01);

// Far more than the rounding of logarithms, far less than a bucket.
constexpr double kEdge = 1e-9;

int bucket_name(TimeNs ns) {
  if (ns <= 0) return std::numeric_limits<int>::min();
  return static_cast<int>(std::floor(std::log(static_cast<double>(ns)) / kLogStep));
}
}  // namespace

// Logarithms are only taken of intervals in new buckets and at the edges of old ones.
IntervalCensus::Bucket& IntervalCensus::bucket_of(TimeNs interval_ns) {
  const auto holds = [&](const Bucket& bucket) {
    return interval_ns >= bucket.from_ns && interval_ns <= bucket.to_ns;
  };
  if (last_ < buckets_.size() && holds(buckets_[last_])) return buckets_[last_];
  auto found = std::lower_bound(buckets_.begin(), buckets_.end(), interval_ns,
                                [](const Bucket& bucket, TimeNs wanted) { return bucket.to_ns < wanted; });
  if (found == buckets_.end() || !holds(*found)) {
    const int name = bucket_name(interval_ns);
    found = std::lower_bound(buckets_.begin(), buckets_.end(), name,
                             [](const Bucket& bucket, int wanted) { return bucket.name < wanted; });
    if (found == buckets_.end() || found->name != name) {
      Bucket bucket;
      bucket.name = name;
      if (interval_ns > 0) {
        bucket.from_ns = static_cast<TimeNs>(std::ceil(std::exp(name * kLogStep) * (1 + kEdge)));
        bucket.to_ns = static_cast<TimeNs>(std::floor(std::exp((name + 1) * kLogStep) * (1 - kEdge)));
      }
      found = buckets_.insert(found, bucket);
    }
  }
  last_ = static_cast<std::size_t>(found - buckets_.begin());
  return *found;
}

void IntervalCensus::count(TimeNs interval_ns, std::int64_t line, std::int64_t times) {
  Bucket& bucket = bucket_of(interval_ns);
  const auto length = static_cast<double>(interval_ns), many = static_cast<double>(times);
  bucket.intervals += times;
  bucket.sum_ns += many * length;
  bucket.sum_squares += many * length * length;
  intervals_ += times;
  if (interval_ns <= widest_ns_) return;
  widest_ns_ = interval_ns;
  widest_line_ = line;
}

double IntervalCensus::quantile_ns(double fraction) const {
  const double rank = std::max(1.0, std::ceil(fraction * static_cast<double>(intervals_)));
  if (intervals_ > 0 && rank >= static_cast<double>(intervals_)) return static_cast<double>(widest_ns_);
  std::int64_t seen = 0;
  for (const Bucket& bucket : buckets_) {
    seen += bucket.intervals;
    if (static_cast<double>(seen) >= rank) return bucket.mean_ns();
  }
  return 0;
}

double IntervalCensus::jitter_ns() const {
  const double limit_ns = kHitchIntervals * median_ns();
  double count = 0, sum_ns = 0;
  for (const Bucket& bucket : buckets_) {
    if (bucket.mean_ns() > limit_ns) continue;
    count += static_cast<double>(bucket.intervals);
    sum_ns += bucket.sum_ns;
  }
  if (count == 0) return 0;
  // About the mean of all, bucket by bucket: the squares of long equal intervals do not cancel out.
  const double mean_ns = sum_ns / count;
  double squares = 0;
  for (const Bucket& bucket : buckets_) {
    if (bucket.mean_ns() > limit_ns) continue;
    const auto many = static_cast<double>(bucket.intervals);
    const double within = bucket.sum_squares - many * bucket.mean_ns() * bucket.mean_ns();
    const double off = bucket.mean_ns() - mean_ns;
    squares += std::max(0.0, within) + many * off * off;
  }
  return std::sqrt(squares / count);
}

std::int64_t IntervalCensus::hitches() const {
  const double limit_ns = kHitchIntervals * median_ns();
  std::int64_t found = 0;
  for (const Bucket& bucket : buckets_)
    if (bucket.mean_ns() > limit_ns) found += bucket.intervals;
  return found;
}

}  // namespace herr
