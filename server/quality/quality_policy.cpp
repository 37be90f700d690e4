#include "server/quality/quality_policy.h"

#include <algorithm>

namespace herr {
namespace {

constexpr int kNarrowestShare = 8;  // 98 of the paper's 788 columns: a blur, yet every pixel has data
constexpr int kLowestShare = 4;     // 192 of the paper's 768 rows
constexpr int kMostTurns = 16;      // of probes

}  // namespace

const char* name_of(QualityPolicy policy) {
  if (policy.motion) return policy.deadline ? "motion+deadline" : "motion";
  return policy.deadline ? "deadline" : "fixed";
}

int default_narrowest(int full_width) {
  return std::max(1, full_width / kNarrowestShare);
}

int default_lowest(int full_height) {
  return std::max(2, full_height / kLowestShare / 2 * 2);
}

QualityLimits quality_limits(const FrameQuality& full, int narrowest) {
  return quality_limits(full, narrowest, full.polar_height);
}

QualityLimits quality_limits(const FrameQuality& full, int narrowest, int lowest) {
  QualityLimits limits;
  limits.full = full;
  limits.narrowest = std::clamp(narrowest, 1, full.polar_width);
  limits.lowest = std::min(std::max(2, lowest / 2 * 2), full.polar_height);
  limits.fewest_probes = (full.probes + kMostTurns - 1) / kMostTurns;
  return limits;
}

const char* name_of(QualityReason reason) {
  switch (reason) {
    case QualityReason::fixed:
      return "fixed";
    case QualityReason::head_still:
      return "head_still";
    case QualityReason::head_moving:
      return "head_moving";
    case QualityReason::start:
      return "start";
    case QualityReason::full:
      return "full";
    case QualityReason::steady:
      return "steady";
    case QualityReason::grow:
      return "grow";
    case QualityReason::grow_limited:
      return "grow_limited";
    case QualityReason::hold:
      return "hold";
    case QualityReason::shrink:
      return "shrink";
    case QualityReason::overload:
      return "overload";
    case QualityReason::less_light:
      return "less_light";
    case QualityReason::more_light:
      return "more_light";
    case QualityReason::floor:
      return "floor";
    case QualityReason::floor_too_slow:
      return "floor_too_slow";
  }
  return "unknown";
}

}  // namespace herr
