// The policies together: motion says what a frame may have at most, the deadline what of it fits in time.
// Before: the replay loop brings the head's motion, and what frames cost. After: Renderer::render_frame.
#pragma once

#include <optional>

#include "server/quality/deadline_policy.h"

namespace herr {

// Not thread-safe; no clock, no allocation after construction.
class QualityController {
 public:
  QualityController(QualityPolicy policy, const QualityLimits& limits, double target_ms);

  QualityDecision decide(const HeadSpeed& motion) { return decide(motion, limits_.full.polar_width); }
  // Of a frame that can use no more than `widest` columns.
  QualityDecision decide(const HeadSpeed& motion, int widest);
  // Of the frame decided last. Without a deadline it changes nothing.
  void observe(const FrameCost& cost);

 private:
  const QualityPolicy policy_;
  const QualityLimits limits_;
  std::optional<DeadlinePolicy> deadline_;
};

}  // namespace herr
