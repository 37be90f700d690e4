// How much longer one thing takes than another, from pairs timed side by side. Before: log ratios of pairs.
// After: time axis of the work-precision diagram.
#pragma once

#include <span>

#include "server/study/statistics/interval.h"

namespace herr {

// The ratio and its 95 % interval, of natural logarithms of ratios: exp of the Hodges-Lehmann estimate with
// the bounds of the exact signed-rank test (check/statistics/signed_rank.h). Of more than kMostPairs the
// first kMostPairs count. NaN and infinite bounds for none; below 6 pairs the bounds are infinite, the lower
// one too. Throws std::invalid_argument for a ratio that is not finite.
Interval paired_ratio(std::span<const double> log_ratios);

}  // namespace herr
