#include "server/quality/quality_controller.h"

#include <algorithm>

#include "server/quality/motion_policy.h"

namespace herr {

QualityController::QualityController(QualityPolicy policy, const QualityLimits& limits, double target_ms)
    : policy_(policy), limits_(limits) {
  if (!policy.deadline) return;
  DeadlineConfig config;
  config.target_ms = target_ms;
  config.limits = limits;
  deadline_.emplace(config);
}

QualityDecision QualityController::decide(const HeadSpeed& motion, int widest) {
  QualityLimits limits = limits_;
  limits.full.polar_width = std::min(widest, limits.full.polar_width);
  limits.narrowest = std::min(limits.narrowest, limits.full.polar_width);
  QualityDecision wish{limits.full, QualityReason::fixed, {}, {}};
  if (policy_.motion) wish = quality_for_motion(motion, limits);
  if (!deadline_) return wish;
  QualityDecision decision = deadline_->decide(wish.quality);
  // All of a wish for less was granted: it is motion that decided.
  if (decision.reason == QualityReason::full && policy_.motion) decision.reason = wish.reason;
  return decision;
}

void QualityController::observe(const FrameCost& cost) {
  if (deadline_) deadline_->observe(cost);
}

}  // namespace herr
