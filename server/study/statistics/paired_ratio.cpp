#include "server/study/statistics/paired_ratio.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "server/check/statistics/signed_rank.h"

namespace herr {
namespace {

constexpr double kTail = 0.025;  // on each side

}  // namespace

Interval paired_ratio(std::span<const double> log_ratios) {
  if (log_ratios.empty()) return {};
  const std::size_t count = std::min(log_ratios.size(), static_cast<std::size_t>(kMostPairs));
  const Shift shift = signed_rank_shift(log_ratios.first(count), kTail);
  Interval ratio;
  ratio.estimate = std::exp(shift.estimate);
  // exp would make a missing lower bound a known one of 0.
  if (std::isfinite(shift.lower)) ratio.lower = std::exp(shift.lower);
  if (std::isfinite(shift.upper)) ratio.upper = std::exp(shift.upper);
  return ratio;
}

}  // namespace herr
