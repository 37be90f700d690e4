// A shift between two sets of measurements with its bounds; an estimate that a few wild runs cannot move far.
// Hodges & Lehmann, "Estimates of location based on rank tests", 1963. Before: signed_rank, rank_sum.
// After: verdict.
#pragma once

#include <vector>

namespace herr {

struct Shift {
  double p = 1;         // of so large a shift upwards by chance alone, one-sided, exact
  double estimate = 0;  // the median of all single comparisons
  // One-sided bounds; infinite where there are too few measurements for the confidence asked for.
  double lower = 0, upper = 0;
};

// The median of `comparisons`, and its values from below and above which no more than `outside` lie.
// `comparisons` is not empty; it is sorted on return.
Shift shift_of(std::vector<double>& comparisons, int outside);

}  // namespace herr
