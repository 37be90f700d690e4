// Wilcoxon's signed-rank test for pairs, exact, with the Hodges-Lehmann estimate that belongs to it.
// Before: one difference for each pair of runs. After: verdict.
#pragma once

#include <span>

#include "server/check/statistics/shift.h"

namespace herr {

inline constexpr int kMostPairs = 50;

// Is the middle of `differences` above 0? p is P(W+ >= observed) when each difference is as likely to be
// negative; differences of exactly 0 are left out of the test, not of the estimate. The bounds hold with
// confidence 1 - tail each. 1 ... 50 finite differences; throws std::invalid_argument otherwise.
Shift signed_rank_shift(std::span<const double> differences, double tail);

}  // namespace herr
