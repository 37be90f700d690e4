// How often each value of a rank statistic arises when chance alone decides: counted, not approximated.
// Wilcoxon, "Individual comparisons by ranking methods", 1945; ties by midranks (Lehmann, Nonparametrics,
// 1975, chapters 1 and 3). Before: differences of measured runs. After: signed_rank, rank_sum.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace herr {

// Ranks of the values in ascending order, doubled: tied values share the mean of their ranks, and twice
// that is a whole number. Throws std::invalid_argument for a value that is not finite: a missing
// measurement has no rank.
std::vector<int> doubled_midranks(std::span<const double> values);

// The number of outcomes for each value of a statistic of whole numbers, from 0 on. Exact up to 2^53.
class RankCounts {
 public:
  // Sums of every subset of `ranks` (2^n outcomes).
  static RankCounts of_subsets(std::span<const int> ranks);
  // Sums of every subset of exactly `size` of them.
  static RankCounts of_subsets(std::span<const int> ranks, std::size_t size);

  // Share of outcomes with a value of at least (at most) `value`.
  double share_from(int value) const;
  double share_to(int value) const;
  // The smallest value with share_to(value) >= tail; below it lies less than `tail`.
  int quantile(double tail) const;

 private:
  explicit RankCounts(std::vector<double> counts);

  std::vector<double> counts_;
  double total_ = 0;
};

}  // namespace herr
