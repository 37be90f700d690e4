#include "server/study/rate/rate_search.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

std::vector<double> sorted_p95(const std::vector<RateTrial>& trials) {
  std::vector<double> sorted;
  for (const RateTrial& trial : trials) sorted.push_back(trial.p95_ms);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

}  // namespace

double median_p95_ms(const std::vector<RateTrial>& trials) {
  return sorted_p95(trials)[(trials.size() - 1) / 2];
}

const RateTrial& median_trial(const std::vector<RateTrial>& trials) {
  const double median_ms = median_p95_ms(trials);
  return *std::find_if(trials.begin(), trials.end(),
                       [&](const RateTrial& trial) { return trial.p95_ms == median_ms; });
}

double spread_of(const std::vector<RateTrial>& trials) {
  const std::vector<double> sorted = sorted_p95(trials);
  return sorted.size() < 2 ? 0.0 : (sorted.back() - sorted.front()) / median_p95_ms(trials);
}

RateSearch::RateSearch(std::size_t settings, double period_ms, const RateSearchConfig& config)
    : period_ms_(period_ms), config_(config), trials_(settings), holds_(settings), refused_(settings) {
  choose_next();
}

double RateSearch::p95_ms(std::size_t setting) const {
  return median_p95_ms(trials_[setting]);
}

bool RateSearch::decided(std::size_t setting) const {
  const std::vector<RateTrial>& trials = trials_[setting];
  if (trials.empty()) return false;
  const auto count = static_cast<int>(trials.size());
  const bool near = std::abs(p95_ms(setting) / period_ms_ - 1) <= config_.near_share;
  const auto in_time = std::count_if(trials.begin(), trials.end(),
                                     [&](const RateTrial& trial) { return trial.p95_ms <= period_ms_; });
  const bool last_hope = setting == 0 && p95_ms(setting) > period_ms_ && !trials.back().hopeless;
  const bool disputed = in_time > 0 && in_time < count;
  const int wanted = disputed && count >= config_.trials_near ? config_.trials_disputed
                     : near || disputed || last_hope          ? config_.trials_near
                                                              : 1;
  return count >= wanted;
}

std::optional<std::size_t> RateSearch::held() const {
  for (std::size_t setting = refused_; setting-- > 0;) {
    if (holds_[setting]) return setting;
  }
  return std::nullopt;
}

std::optional<std::size_t> RateSearch::refused() const {
  if (refused_ == trials_.size()) return std::nullopt;
  return refused_;
}

void RateSearch::choose_next() {
  const std::optional<std::size_t> held = this->held();
  const std::size_t first = held ? *held + 1 : 0;
  next_.reset();
  if (first < refused_) {
    next_ = first + (refused_ - first - 1) / 2;
  } else if (held && static_cast<int>(trials_[*held].size()) < config_.trials_near) {
    next_ = held;
  }
}

void RateSearch::observe(const RateTrial& trial) {
  const std::size_t setting = *next_;
  trials_[setting].push_back(trial);
  if (!decided(setting)) return;
  holds_[setting] = p95_ms(setting) <= period_ms_;
  if (!holds_[setting]) refused_ = setting;
  choose_next();
}

}  // namespace herr
