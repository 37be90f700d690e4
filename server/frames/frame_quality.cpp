#include "server/frames/frame_quality.h"

#include "server/settings/quality_target.h"

namespace herr {

QualityController quality_controller(const ReplayOptions& options, const SessionReport& report,
                                     const Renderer& renderer) {
  const QualityLimits limits =
      quality_limits(renderer.full_quality(), narrowest_width(options, report.settings),
                     lowest_height(options, report.settings));
  return {options.policy, limits, quality_target_ms(options, report.range)};
}

FrameCost cost_of_frame(const RenderedFrame& frame, TimeNs started_ns, TimeNs finished_ns, bool missed) {
  constexpr double kMsPerNs = 1e-6;
  return frame_cost(frame, static_cast<double>(finished_ns - started_ns) * kMsPerNs, missed, finished_ns);
}

}  // namespace herr
