// The largest of ordered settings whose 95th percentile holds a period, by bisection over measurements that
// scatter. A setting is decided by the median of its trials: one where it is far from the period, three where
// it is near, five where three disagree. The answer has three at least, and so has
// the smallest before it is said not to hold, unless its trial was hopeless. Pure: no clock, no machine.
// Before: rate_ladder. After: run_rate_study measures what next() asks for.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "server/study/rate/rate_trial.h"

namespace herr {

struct RateSearchConfig {
  // Of the period: a percentile within it could come out on the other side the next time.
  double near_share = 0.1;
  int trials_near = 3, trials_disputed = 5;
};

// Not thread-safe.
class RateSearch {
 public:
  // `settings`: how many, 1 or more.
  RateSearch(std::size_t settings, double period_ms, const RateSearchConfig& config = {});

  // The setting to be measured next; none once the search is over.
  std::optional<std::size_t> next() const { return next_; }
  // A trial of next().
  void observe(const RateTrial& trial);

  // Once it is over: the largest that holds, and the smallest above it, which does not. None of the first:
  // not even the smallest holds. None of the second: all hold.
  std::optional<std::size_t> held() const;
  std::optional<std::size_t> refused() const;

  const std::vector<RateTrial>& trials(std::size_t setting) const { return trials_[setting]; }
  double p95_ms(std::size_t setting) const;  // the median of its trials; of at least one

 private:
  bool decided(std::size_t setting) const;
  void choose_next();

  const double period_ms_;
  const RateSearchConfig config_;
  std::vector<std::vector<RateTrial>> trials_;
  std::vector<bool> holds_;  // of settings that were decided so
  std::size_t refused_;      // all from here on do not hold
  std::optional<std::size_t> next_;
};

// Largest less smallest percentile of the trials, over their median; 0 of one trial.
double spread_of(const std::vector<RateTrial>& trials);
// The trial whose percentile is the median; the lower of the two in the middle of an even number. Of at least
// one.
const RateTrial& median_trial(const std::vector<RateTrial>& trials);
// Its percentile: the lower of the two in the middle of an even number. Of at least one.
double median_p95_ms(const std::vector<RateTrial>& trials);

}  // namespace herr
