#include "server/statistics/frame_pace.h"

#include <cmath>

namespace herr {
namespace {

constexpr double kLow = 0.01;

double per_second(double ns) {
  return ns > 0 ? 1e9 / ns : 0;
}

}  // namespace

void Stutter::add_ms(double frame_ms) {
  if (mean_ms_ > 0 && frame_ms > kFactor * mean_ms_) {
    ++frames_;
    stuttered_ms_ += frame_ms;
  }
  all_ms_ += frame_ms;
  const double keep = mean_ms_ > 0 ? std::exp(-frame_ms * 1e-3 / kMean_s) : 0.0;
  mean_ms_ = frame_ms + (mean_ms_ - frame_ms) * keep;
}

void Stutter::merge(const Stutter& other) {
  frames_ += other.frames_;
  stuttered_ms_ += other.stuttered_ms_;
  all_ms_ += other.all_ms_;
  if (other.mean_ms_ > 0) mean_ms_ = other.mean_ms_;
}

double Stutter::share_of_time() const {
  return all_ms_ > 0 ? stuttered_ms_ / all_ms_ : 0;
}

OnePercentLows one_percent_lows(const LatencyHistogram& frame_times) {
  return {per_second(frame_times.quantile_ns(1 - kLow)), per_second(frame_times.mean_of_longest_ns(kLow)),
          per_second(frame_times.time_quantile_ns(kLow))};
}

}  // namespace herr
