#include "server/check/statistics/lasting_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "server/check/statistics/noise.h"

namespace herr {
namespace {

// A value at the very end of a span counts as inside, however ends and values were rounded.
constexpr double kEndSlack = 1e-12;

// The most of the sorted values that lie within a span whose ends have this ratio.
std::size_t most_within(const std::vector<double>& sorted, double ratio) {
  std::size_t most = 0, first = 0;
  for (std::size_t last = 0; last < sorted.size(); ++last) {
    while (sorted[last] > ratio * sorted[first]) ++first;
    most = std::max(most, last + 1 - first);
  }
  return most;
}

}  // namespace

bool speed_stays_restless(std::span<const double> rays_ms, int final_count) {
  std::vector<double> sorted(rays_ms.begin(), rays_ms.end());
  std::sort(sorted.begin(), sorted.end());
  const auto needed = static_cast<std::ptrdiff_t>(sorted.size()) - final_count / 2;
  if (needed <= 0) return false;
  constexpr double c = kMostCalibrationCv / kSigmaPerDeviation;
  constexpr double ratio = (1 + c) / (1 - c) * (1 + kEndSlack);
  return most_within(sorted, ratio) < static_cast<std::size_t>(needed);
}

bool steal_stays_high(std::span<const CpuDemand> runs, int final_count) {
  double asked = 0, stolen = 0, most_asked = 0;
  for (const CpuDemand& run : runs) {
    asked += run.asked, stolen += run.stolen;
    most_asked = std::max(most_asked, run.asked);
  }
  if (std::isnan(stolen)) return true;
  const auto to_come = static_cast<double>(std::max(0, final_count - static_cast<int>(runs.size())));
  return stolen > kMostSteal * (1 + kEndSlack) * (asked + to_come * most_asked);
}

}  // namespace herr
