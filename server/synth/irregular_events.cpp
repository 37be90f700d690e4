#include "server/synth/irregular_events.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace herr {
namespace {

constexpr std::uint64_t kBlinkStream = 17, kHitchStream = 48;
constexpr double kLidsDown = 1.0 / 3.0, kLidsRise = 0.5;  // shares of a blink

}  // namespace

IrregularEvents::IrregularEvents(const Config& config, std::uint64_t seed, std::uint64_t stream)
    : config_(config), random_(seed, stream) {
  plan_next(config.quiet_start_s);
}

void IrregularEvents::plan_next(double after_s) {
  met_ = false;
  start_s_ = std::numeric_limits<double>::infinity();
  if (config_.per_minute <= 0) return;
  const double ratio = config_.longest_s / config_.shortest_s;
  const double mean_length_s = (config_.longest_s - config_.shortest_s) / std::log(ratio);
  const double mean_pause_s = 60.0 / config_.per_minute - mean_length_s - config_.least_pause_s;
  start_s_ = after_s + config_.least_pause_s + random_.exponential(std::max(mean_pause_s, 0.0));
  length_s_ = config_.shortest_s * std::pow(ratio, random_.uniform(0, 1));
}

std::optional<double> IrregularEvents::share_at(double time_s) {
  while (time_s >= start_s_ + length_s_) plan_next(start_s_ + length_s_);
  if (time_s < start_s_) return std::nullopt;
  if (!met_) ++count_;
  met_ = true;
  return (time_s - start_s_) / length_s_;
}

IrregularEvents blinks(std::uint64_t seed, double per_minute) {
  return {{per_minute, 0.15, 0.3, 0.0, 0.3}, seed, kBlinkStream};
}

double lid_openness(std::optional<double> blink_share) {
  if (!blink_share) return 1.0;
  if (*blink_share < kLidsDown) return 1.0 - *blink_share / kLidsDown;
  return std::max(0.0, (*blink_share - kLidsRise) / (1.0 - kLidsRise));
}

IrregularEvents hitches(std::uint64_t seed, double per_minute) {
  return {{per_minute, 0.04, 0.35, 1.0, 0.2}, seed, kHitchStream};
}

}  // namespace herr
