#include "server/frames/frame_quality.h"

#include "server/text/number_text.h"

namespace herr {

double quality_target_ms(const ReplayOptions& options, const FrameRange& range) {
  return options.target_ms.value_or(range.period_ms());
}

int narrowest_width(const ReplayOptions& options, const RenderSettings& settings) {
  return options.narrowest_width.value_or(default_narrowest(settings.polar_width));
}

QualityController quality_controller(const ReplayOptions& options, const SessionReport& report,
                                     const Renderer& renderer) {
  return {options.policy, quality_limits(renderer.full_quality(), narrowest_width(options, report.settings)),
          quality_target_ms(options, report.range)};
}

FrameCost cost_of_frame(const RenderedFrame& frame, TimeNs started_ns, TimeNs finished_ns, bool missed) {
  constexpr double kMsPerNs = 1e-6;
  return frame_cost(frame, static_cast<double>(finished_ns - started_ns) * kMsPerNs, missed, finished_ns);
}

bool is_reproducible(const ReplayOptions& options) {
  return options.clock != ReplayClock::realtime && !options.policy.deadline;
}

std::string floor_warning(const SessionReport& report, const ReplayOptions& options) {
  const std::int64_t frames =
      report.statistics.reasons[static_cast<std::size_t>(QualityReason::floor_too_slow)];
  if (frames == 0) return {};
  return "the target of " + fixed_text(quality_target_ms(options, report.range), 2) +
         " ms was out of reach in " + std::to_string(frames) + " of " +
         std::to_string(report.statistics.frames) +
         " frames with the least quality allowed; give a lower --polar-floor, fewer pixels (--profile) or a "
         "higher --target-ms";
}

}  // namespace herr
