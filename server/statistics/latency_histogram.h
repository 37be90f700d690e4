// Durations in logarithmic buckets: any number of them in constant memory, quantiles within 0.5 %, merges
// exact in any order. Method: DDSketch (Masson, Rim & Lee 2019, arxiv 1908.10693) with fixed buckets and
// integer counts. Before: one duration per frame and stage. After: latency table, summary.json.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace herr {

// Not thread-safe; fill one per thread and merge.
class LatencyHistogram {
 public:
  static constexpr double kRelativeError = 0.005;              // alpha: bound on |quantile / exact - 1|
  static constexpr std::int64_t kLowestNs = 1'000;             // 1 us: shorter durations share one bucket
  static constexpr std::int64_t kHighestNs = 100'000'000'000;  // 100 s: longer durations share one bucket

  // Negative durations count as 0.
  void add_ns(std::int64_t duration_ns);
  // Rounded to whole nanoseconds. Not finite: std::invalid_argument.
  void add_ms(double duration_ms);
  // Adds all counts of `other`: associative and commutative, exactly.
  void merge(const LatencyHistogram& other);

  std::int64_t count() const { return count_; }
  std::int64_t min_ns() const { return min_ns_; }  // exact; 0 when empty
  std::int64_t max_ns() const { return max_ns_; }  // exact; 0 when empty
  std::int64_t sum_ns() const { return sum_ns_; }  // exact
  double mean_ns() const;                          // 0 when empty
  // The value that ceil(fraction * count) durations do not exceed (nearest rank), within kRelativeError and
  // within [min, max]; 0 when empty. fraction in [0, 1]. Below kLowestNs the minimum stands for the bucket,
  // above kHighestNs the maximum.
  double quantile_ns(double fraction) const;

  // Of the ceil(fraction * count) longest durations, one at least: their mean. Within kRelativeError and
  // within [min, max]; 0 when empty.
  double mean_of_longest_ns(double fraction) const;
  // Of the fewest longest durations whose sum reaches `fraction` of the sum of all: the shortest. Bounds as
  // above, but for the sums, which are those of the buckets; 0 when empty.
  double time_quantile_ns(double fraction) const;

  // Number of durations up to `duration_ns`; those within 2 * kRelativeError of it may count on either side.
  // Never decreases with duration_ns; all for kHighestNs and more.
  std::int64_t count_up_to_ns(std::int64_t duration_ns) const;

  bool operator==(const LatencyHistogram&) const = default;

 private:
  double value_of_ns(std::size_t bucket) const;

  std::vector<std::int64_t> counts_;  // allocated with the first duration
  std::int64_t count_ = 0, min_ns_ = 0, max_ns_ = 0, sum_ns_ = 0;
};

}  // namespace herr
