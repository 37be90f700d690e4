// The rank-sum test of Wilcoxon, Mann and Whitney for two sets of runs, exact, with the Hodges-Lehmann
// estimate of the shift. Before: runs now and runs of a stored baseline. After: verdict.
#pragma once

#include <span>

#include "server/check/statistics/shift.h"

namespace herr {

// Is `now` above `before`? p is P(rank sum of `now` >= observed) when all runs are alike; bounds as in
// signed_rank. Both sets hold 1 ... 26 finite values; throws std::invalid_argument otherwise.
Shift rank_sum_shift(std::span<const double> now, std::span<const double> before, double tail);

}  // namespace herr
