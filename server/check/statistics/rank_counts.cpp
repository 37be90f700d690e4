#include "server/check/statistics/rank_counts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace herr {

std::vector<int> doubled_midranks(std::span<const double> values) {
  for (const double value : values) {
    if (!std::isfinite(value)) throw std::invalid_argument("a value without a rank: it is not finite");
  }
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<int> ranks(values.size());
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && values[order[last]] == values[order[first]]) ++last;
    // Ranks first + 1 ... last, on average (first + 1 + last) / 2.
    for (std::size_t i = first; i < last; ++i) ranks[order[i]] = static_cast<int>(first + 1 + last);
  }
  return ranks;
}

RankCounts::RankCounts(std::vector<double> counts) : counts_(std::move(counts)) {
  total_ = std::accumulate(counts_.begin(), counts_.end(), 0.0);
}

RankCounts RankCounts::of_subsets(std::span<const int> ranks) {
  if (ranks.size() > 52) throw std::invalid_argument("more than 52 ranks have no exact counts here");
  const int most = std::accumulate(ranks.begin(), ranks.end(), 0);
  std::vector<double> counts(static_cast<std::size_t>(most) + 1);
  counts[0] = 1;
  int reached = 0;
  for (const int rank : ranks) {
    // Downwards, so that each rank is taken once at most.
    for (int sum = reached; sum >= 0; --sum) {
      counts[static_cast<std::size_t>(sum + rank)] += counts[static_cast<std::size_t>(sum)];
    }
    reached += rank;
  }
  return RankCounts(std::move(counts));
}

RankCounts RankCounts::of_subsets(std::span<const int> ranks, std::size_t size) {
  if (ranks.size() > 52 || size > ranks.size()) {
    throw std::invalid_argument("no exact counts for so many ranks, or a subset larger than the whole");
  }
  const int most = std::accumulate(ranks.begin(), ranks.end(), 0);
  std::vector<std::vector<double>> counts(size + 1, std::vector<double>(static_cast<std::size_t>(most) + 1));
  counts[0][0] = 1;
  for (const int rank : ranks) {
    for (std::size_t taken = size; taken > 0; --taken) {
      for (int sum = most; sum >= rank; --sum) {
        counts[taken][static_cast<std::size_t>(sum)] +=
            counts[taken - 1][static_cast<std::size_t>(sum - rank)];
      }
    }
  }
  return RankCounts(std::move(counts[size]));
}

double RankCounts::share_from(int value) const {
  double outcomes = 0;
  for (std::size_t i = static_cast<std::size_t>(std::max(value, 0)); i < counts_.size(); ++i)
    outcomes += counts_[i];
  return outcomes / total_;
}

double RankCounts::share_to(int value) const {
  double outcomes = 0;
  for (std::size_t i = 0; i < counts_.size() && static_cast<int>(i) <= value; ++i) outcomes += counts_[i];
  return outcomes / total_;
}

int RankCounts::quantile(double tail) const {
  double outcomes = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    outcomes += counts_[i];
    if (outcomes >= tail * total_) return static_cast<int>(i);
  }
  return static_cast<int>(counts_.size());
}

}  // namespace herr
