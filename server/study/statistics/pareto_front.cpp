#include "server/study/statistics/pareto_front.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>

namespace herr {
namespace {

// A number below `count`, each as likely (Lemire, "Fast random integer generation in an interval", 2019).
std::size_t drawn_below(std::mt19937_64& random, std::size_t count) {
  const auto draw = [&] { return (random() >> 32) * count; };
  constexpr std::uint64_t kAll = std::uint64_t{1} << 32;
  std::uint64_t product = draw();
  if (product % kAll < count) {
    const std::uint64_t surplus = kAll % count;
    while (product % kAll < surplus) product = draw();
  }
  return static_cast<std::size_t>(product / kAll);
}

// How often each of so many values comes up when as many are drawn.
void draw_counts(std::mt19937_64& random, std::vector<int>& counts) {
  std::fill(counts.begin(), counts.end(), 0);
  for (std::size_t i = 0; i < counts.size(); ++i) ++counts[drawn_below(random, counts.size())];
}

// The median of ascending values that come up so often, as many in all as there are values.
double median_of(const std::vector<double>& values, const std::vector<int>& counts) {
  const std::size_t size = values.size();
  std::size_t at = 0, up_to = 0;
  const auto ranked = [&](std::size_t rank) {
    while (up_to <= rank) up_to += static_cast<std::size_t>(counts[at++]);
    return values[at - 1];
  };
  const double lower = ranked((size - 1) / 2);
  return 0.5 * (lower + ranked(size / 2));
}

struct Place {
  double time = 0, error = 0;
  std::size_t candidate = 0;
};

// Calls `found` for each candidate that no other one beats; sorts the places.
template <typename Found>
void sweep_front(std::vector<Place>& places, Found found) {
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.time != b.time ? a.time < b.time : a.error < b.error;
  });
  double best = std::numeric_limits<double>::infinity();  // error of all that are faster
  for (std::size_t first = 0, next = 0; first < places.size(); first = next) {
    const Place& leader = places[first];
    while (next < places.size() && places[next].time == leader.time) {
      if (leader.error < best && places[next].error == leader.error) found(places[next].candidate);
      ++next;
    }
    best = std::min(best, leader.error);
  }
}

// The candidates that have errors and ratios.
class Field {
 public:
  explicit Field(std::span<const FrontCandidate> candidates) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const FrontCandidate& candidate = candidates[i];
      if (candidate.frame_errors.empty() || candidate.log_ratios.empty()) continue;
      require(candidate);
      add(candidate);
      candidate_of_.push_back(i);
    }
    places_.resize(candidate_of_.size());
    error_sums_.resize(candidate_of_.size());
  }

  // Each value once.
  std::vector<Place>& observed() {
    for (std::vector<int>& counts : ratio_counts_) std::fill(counts.begin(), counts.end(), 1);
    std::fill(frame_counts_.begin(), frame_counts_.end(), 1);
    return placed();
  }

  std::vector<Place>& drawn(std::mt19937_64& random) {
    draw_counts(random, frame_counts_);
    for (std::vector<int>& counts : ratio_counts_) draw_counts(random, counts);
    return placed();
  }

 private:
  void require(const FrontCandidate& candidate) const {
    if (!candidate_of_.empty() && candidate.frame_errors.size() != squares_.size()) {
      throw std::invalid_argument("candidates of a front have errors of different frames");
    }
    const auto finite = [](double x) { return std::isfinite(x); };
    if (!std::all_of(candidate.frame_errors.begin(), candidate.frame_errors.end(), finite) ||
        !std::all_of(candidate.log_ratios.begin(), candidate.log_ratios.end(), finite)) {
      throw std::invalid_argument("a candidate of a front has a value that is not finite");
    }
  }

  void add(const FrontCandidate& candidate) {
    squares_.resize(candidate.frame_errors.size());
    frame_counts_.resize(squares_.size());
    for (std::size_t f = 0; f < squares_.size(); ++f) {
      squares_[f].push_back(candidate.frame_errors[f] * candidate.frame_errors[f]);
    }
    ratios_.push_back(candidate.log_ratios);
    std::sort(ratios_.back().begin(), ratios_.back().end());
    ratio_counts_.emplace_back(ratios_.back().size());
  }

  // Sums of squared errors rank like their root means.
  std::vector<Place>& placed() {
    std::fill(error_sums_.begin(), error_sums_.end(), 0.0);
    for (std::size_t f = 0; f < squares_.size(); ++f) {
      if (frame_counts_[f] == 0) continue;
      const double count = frame_counts_[f];
      for (std::size_t i = 0; i < error_sums_.size(); ++i) error_sums_[i] += count * squares_[f][i];
    }
    for (std::size_t i = 0; i < places_.size(); ++i) {
      places_[i] = {median_of(ratios_[i], ratio_counts_[i]), error_sums_[i], candidate_of_[i]};
    }
    return places_;
  }

  std::vector<std::size_t> candidate_of_;
  std::vector<std::vector<double>> squares_;  // of a frame's errors, candidates side by side
  std::vector<std::vector<double>> ratios_;   // of a candidate, ascending
  std::vector<int> frame_counts_;
  std::vector<std::vector<int>> ratio_counts_;
  std::vector<double> error_sums_;
  std::vector<Place> places_;
};

}  // namespace

std::vector<FrontPlace> pareto_front(std::span<const FrontCandidate> candidates, int draws,
                                     std::uint64_t seed) {
  if (draws < 1) throw std::invalid_argument("the confidence of a front takes a draw at least");
  std::vector<FrontPlace> result(candidates.size());
  std::vector<int> wins(candidates.size());
  Field field(candidates);
  sweep_front(field.observed(), [&](std::size_t candidate) { result[candidate].on_front = true; });
  std::mt19937_64 random(seed);
  for (int i = 0; i < draws; ++i) {
    sweep_front(field.drawn(random), [&](std::size_t candidate) { ++wins[candidate]; });
  }
  for (std::size_t i = 0; i < result.size(); ++i) result[i].confidence = static_cast<double>(wins[i]) / draws;
  return result;
}

}  // namespace herr
