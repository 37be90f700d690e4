#include "server/results/session_report.h"

#include "server/settings/quality_target.h"
#include "server/text/number_text.h"
#include "sessions/inspect/number_words.h"

namespace herr {

std::string floor_warning(const SessionReport& report, const ReplayOptions& options) {
  const std::int64_t frames =
      report.statistics.reasons[static_cast<std::size_t>(QualityReason::floor_too_slow)];
  if (frames == 0) return {};
  return "the target of " + fixed_text(quality_target_ms(options, report.range), 2) +
         " ms was out of reach in " + std::to_string(frames) + " of " +
         counted(report.statistics.frames, "frame", "frames") +
         " with the least quality allowed; give a lower --polar-floor or --polar-floor-height, fewer pixels "
         "(--profile, --profile-scale) or a higher --target-ms";
}

}  // namespace herr
