#include "server/statistics/frame_pace.h"

#include <cmath>

namespace herr {
namespace {

constexpr double kLow = 0.01;

double per_second(double ns) {
  return ns > 0 ? 1e9 / ns : 0;
}

}  // namespace

bool StutterWatch::next_ms(double frame_ms) {
  const bool stutters = mean_ms_ > 0 && frame_ms > kFactor * mean_ms_;
  const double keep = mean_ms_ > 0 ? std::exp(-frame_ms * 1e-3 / kMean_s) : 0.0;
  mean_ms_ = frame_ms + (mean_ms_ - frame_ms) * keep;
  return stutters;
}

OnePercentLows one_percent_lows(const LatencyHistogram& frame_times) {
  return {per_second(frame_times.quantile_ns(1 - kLow)), per_second(frame_times.mean_of_longest_ns(kLow)),
          per_second(frame_times.time_quantile_ns(kLow))};
}

}  // namespace herr
