#include "server/statistics/latency_histogram.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace herr {
namespace {

// Bucket i > 0 holds durations in (upper[i - 1], upper[i]]; bucket 0 holds all up to kLowestNs; the last
// bucket holds all above kHighestNs. Neighbouring bounds differ by gamma = (1 + alpha) / (1 - alpha), so that
// the value 2 * lower * upper / (lower + upper) is within alpha of everything in the bucket.
const std::vector<double>& upper_bounds_ns() {
  static const std::vector<double> bounds = [] {
    const double alpha = LatencyHistogram::kRelativeError;
    const double log_gamma = std::log((1.0 + alpha) / (1.0 - alpha));
    const double lowest = static_cast<double>(LatencyHistogram::kLowestNs);
    const double span = static_cast<double>(LatencyHistogram::kHighestNs) / lowest;
    const int steps = static_cast<int>(std::ceil(std::log(span) / log_gamma));
    std::vector<double> result;
    for (int i = 0; i <= steps; ++i) result.push_back(lowest * std::exp(i * log_gamma));
    return result;
  }();
  return bounds;
}

std::size_t bucket_of(std::int64_t duration_ns) {
  const std::vector<double>& bounds = upper_bounds_ns();
  const auto bound = std::lower_bound(bounds.begin(), bounds.end(), static_cast<double>(duration_ns));
  return static_cast<std::size_t>(bound - bounds.begin());
}

}  // namespace

void LatencyHistogram::add_ns(std::int64_t duration_ns) {
  const std::int64_t value = std::max<std::int64_t>(duration_ns, 0);
  if (counts_.empty()) counts_.resize(upper_bounds_ns().size() + 1);
  ++counts_[bucket_of(value)];
  min_ns_ = count_ == 0 ? value : std::min(min_ns_, value);
  max_ns_ = count_ == 0 ? value : std::max(max_ns_, value);
  sum_ns_ += value;
  ++count_;
}

void LatencyHistogram::add_ms(double duration_ms) {
  if (!std::isfinite(duration_ms)) throw std::invalid_argument("a duration is not finite");
  // 9e18 ns are 285 years: far beyond any duration, and the largest round number that an int64 holds.
  add_ns(static_cast<std::int64_t>(std::llround(std::clamp(duration_ms * 1e6, 0.0, 9e18))));
}

void LatencyHistogram::merge(const LatencyHistogram& other) {
  if (other.count_ == 0) return;
  if (counts_.empty()) counts_.resize(other.counts_.size());
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  min_ns_ = count_ == 0 ? other.min_ns_ : std::min(min_ns_, other.min_ns_);
  max_ns_ = count_ == 0 ? other.max_ns_ : std::max(max_ns_, other.max_ns_);
  sum_ns_ += other.sum_ns_;
  count_ += other.count_;
}

double LatencyHistogram::mean_ns() const {
  return count_ == 0 ? 0.0 : static_cast<double>(sum_ns_) / static_cast<double>(count_);
}

// What stands for the durations of a bucket.
double LatencyHistogram::value_of_ns(std::size_t bucket) const {
  const std::vector<double>& bounds = upper_bounds_ns();
  const double lowest = static_cast<double>(min_ns_), highest = static_cast<double>(max_ns_);
  if (bucket == 0) return lowest;
  if (bucket == bounds.size()) return highest;
  const double lower = bounds[bucket - 1], upper = bounds[bucket];
  return std::clamp(2.0 * lower * upper / (lower + upper), lowest, highest);
}

double LatencyHistogram::quantile_ns(double fraction) const {
  if (count_ == 0) return 0.0;
  const double wanted = std::ceil(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(count_));
  const std::int64_t rank = std::clamp<std::int64_t>(static_cast<std::int64_t>(wanted), 1, count_);
  // The first and the last rank are known exactly.
  if (rank == 1) return static_cast<double>(min_ns_);
  if (rank == count_) return static_cast<double>(max_ns_);
  std::int64_t seen = 0;
  std::size_t bucket = 0;
  while (seen + counts_[bucket] < rank) seen += counts_[bucket++];
  return value_of_ns(bucket);
}

double LatencyHistogram::mean_of_longest_ns(double fraction) const {
  if (count_ == 0) return 0.0;
  const double wanted = std::ceil(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(count_));
  const std::int64_t most = std::clamp<std::int64_t>(static_cast<std::int64_t>(wanted), 1, count_);
  // The longest one is known exactly.
  double sum_ns = static_cast<double>(max_ns_);
  std::int64_t left = most - 1;
  bool longest_is_taken = true;
  for (std::size_t bucket = counts_.size(); bucket-- > 0 && left > 0;) {
    std::int64_t here = counts_[bucket];
    if (here > 0 && longest_is_taken) --here, longest_is_taken = false;
    const std::int64_t taken = std::min(here, left);
    sum_ns += static_cast<double>(taken) * value_of_ns(bucket);
    left -= taken;
  }
  return sum_ns / static_cast<double>(most);
}

double LatencyHistogram::time_quantile_ns(double fraction) const {
  if (count_ == 0) return 0.0;
  const double wanted_ns = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(sum_ns_);
  double sum_ns = static_cast<double>(max_ns_);
  if (sum_ns >= wanted_ns) return sum_ns;
  bool longest_is_taken = true;
  for (std::size_t bucket = counts_.size(); bucket-- > 0;) {
    std::int64_t here = counts_[bucket];
    if (here > 0 && longest_is_taken) --here, longest_is_taken = false;
    sum_ns += static_cast<double>(here) * value_of_ns(bucket);
    if (here > 0 && sum_ns >= wanted_ns) return value_of_ns(bucket);
  }
  return static_cast<double>(min_ns_);
}

std::int64_t LatencyHistogram::count_up_to_ns(std::int64_t duration_ns) const {
  if (counts_.empty() || duration_ns < 0) return 0;
  if (duration_ns >= kHighestNs) return count_;
  // The whole bucket that the bound lies in: its bounds are 2 * alpha apart.
  const std::size_t last = bucket_of(duration_ns);
  std::int64_t count = 0;
  for (std::size_t i = 0; i <= last; ++i) count += counts_[i];
  return count;
}

}  // namespace herr
