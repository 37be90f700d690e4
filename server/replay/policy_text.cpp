#include "server/replay/policy_text.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace herr {
namespace {

// Of values that the histogram keeps as milliseconds; told `times` as large.
std::string range_text(const std::string& name, const LatencyHistogram& values, int times = 1) {
  const auto whole = [times](double value) { return std::to_string(std::llround(times * value * 1e-6)); };
  const std::string least = whole(static_cast<double>(values.min_ns())),
                    most = whole(static_cast<double>(values.max_ns()));
  if (least == most) return name + " " + least;
  return name + " " + least + " ... " + most + " (mean " + whole(values.mean_ns()) + ")";
}

}  // namespace

std::string policy_text(const RunStatistics& statistics, QualityPolicy policy) {
  if (policy == QualityPolicy{} || statistics.frames == 0) return {};
  std::string text = std::string(name_of(policy)) + ": " +
                     range_text("polar width", statistics.polar_width, 2) + ", " +
                     range_text("height", statistics.polar_height) + ", " +
                     range_text("light samples", statistics.light_samples);
  if (statistics.allowed_probes.max_ns() > 0) text += ", " + range_text("probes", statistics.allowed_probes);
  const auto frames_for = [&](QualityReason reason) {
    return statistics.reasons[static_cast<std::size_t>(reason)];
  };
  const std::int64_t floor = frames_for(QualityReason::floor_too_slow) + frames_for(QualityReason::floor);
  if (floor > 0) {
    text +=
        ", " + std::to_string(floor) + " of " + std::to_string(statistics.frames) + " frames at the floor";
  }
  if (statistics.floor_over_target > 0)
    text += ", " + std::to_string(statistics.floor_over_target) + " of them over the target";
  if (frames_for(QualityReason::start) > 0) text += "; its first tens of frames are a warm-up from the floor";
  return text;
}

}  // namespace herr
