#include "server/check/statistics/rank_sum.h"

#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "server/check/statistics/rank_counts.h"

namespace herr {
namespace {

constexpr std::size_t kMostRuns = 26;  // of a set: C(52, 26) < 2^53

}  // namespace

Shift rank_sum_shift(std::span<const double> now, std::span<const double> before, double tail) {
  if (now.empty() || before.empty() || now.size() > kMostRuns || before.size() > kMostRuns) {
    throw std::invalid_argument("a rank-sum test takes 1 ... 26 runs of each kind");
  }
  std::vector<double> all(now.begin(), now.end());
  all.insert(all.end(), before.begin(), before.end());
  const std::vector<int> midranks = doubled_midranks(all);
  const int observed =
      std::accumulate(midranks.begin(), midranks.begin() + static_cast<std::ptrdiff_t>(now.size()), 0);

  std::vector<double> comparisons;
  comparisons.reserve(now.size() * before.size());
  for (const double x : now) {
    for (const double y : before) comparisons.push_back(x - y);
  }
  // As many comparisons lie above the true shift as Mann and Whitney's U counts: the rank sum less its
  // smallest value.
  std::vector<int> ranks(all.size());
  std::iota(ranks.begin(), ranks.end(), 1);
  const int smallest = static_cast<int>(now.size() * (now.size() + 1) / 2);
  const int outside = RankCounts::of_subsets(ranks, now.size()).quantile(tail) - smallest;
  Shift shift = shift_of(comparisons, outside);
  shift.p = RankCounts::of_subsets(midranks, now.size()).share_from(observed);
  return shift;
}

}  // namespace herr
