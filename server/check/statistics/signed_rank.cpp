#include "server/check/statistics/signed_rank.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "server/check/statistics/rank_counts.h"

namespace herr {
namespace {

double p_of(std::span<const double> differences) {
  std::vector<double> sizes;
  std::vector<bool> positive;
  for (const double difference : differences) {
    if (difference == 0) continue;
    sizes.push_back(std::abs(difference));
    positive.push_back(difference > 0);
  }
  const std::vector<int> ranks = doubled_midranks(sizes);
  int observed = 0;
  for (std::size_t i = 0; i < ranks.size(); ++i) observed += positive[i] ? ranks[i] : 0;
  return RankCounts::of_subsets(ranks).share_from(observed);
}

}  // namespace

Shift signed_rank_shift(std::span<const double> differences, double tail) {
  const std::size_t count = differences.size();
  if (count < 1 || count > kMostPairs) throw std::invalid_argument("a signed-rank test takes 1 ... 50 pairs");
  for (const double difference : differences) {
    if (!std::isfinite(difference)) throw std::invalid_argument("the difference of a pair is not finite");
  }
  std::vector<double> walsh_averages;
  walsh_averages.reserve(count * (count + 1) / 2);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i; j < count; ++j) walsh_averages.push_back(0.5 * (differences[i] + differences[j]));
  }
  // As many averages lie above the true middle as W+ counts: fewer than the quantile
  // happens with less than `tail`.
  std::vector<int> ranks(count);
  std::iota(ranks.begin(), ranks.end(), 1);
  Shift shift = shift_of(walsh_averages, RankCounts::of_subsets(ranks).quantile(tail));
  shift.p = p_of(differences);
  return shift;
}

}  // namespace herr
