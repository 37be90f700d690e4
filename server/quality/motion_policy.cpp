#include "server/quality/motion_policy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace herr {
namespace {

// Powers of two have strata that are nearly square on any light.
int light_samples_for(int full, double share) {
  const double wanted = std::pow(static_cast<double>(full), 1 - share);
  // A hair above: the power is inexact where it should give a whole number.
  const auto whole = static_cast<unsigned>(std::max(1.0, std::floor(wanted * (1 + 1e-12))));
  return std::min(full, static_cast<int>(std::bit_floor(whole)));
}

}  // namespace

double motion_deg_s(const HeadSpeed& motion, const MotionConfig& config) {
  return glm::degrees(motion.turn_rad_s + motion.move_m_s / config.seen_from_m);
}

double motion_share(double deg_s, const MotionConfig& config) {
  if (!(deg_s > config.still_deg_s)) return 0;
  return std::min(1.0,
                  std::log(deg_s / config.still_deg_s) / std::log(config.fast_deg_s / config.still_deg_s));
}

QualityDecision quality_for_motion(const HeadSpeed& motion, const QualityLimits& limits,
                                   const MotionConfig& config) {
  QualityDecision decision{limits.full, QualityReason::head_still, {}, {}};
  const double share = motion_share(motion_deg_s(motion, config), config);
  if (share == 0) return decision;
  const double width = limits.full.polar_width * std::pow(config.narrow_share, share);
  decision.quality.polar_width =
      std::clamp(static_cast<int>(std::lround(width)), limits.narrowest, limits.full.polar_width);
  decision.quality.light_samples = light_samples_for(limits.full.light_samples, share);
  decision.reason = QualityReason::head_moving;
  return decision;
}

}  // namespace herr
