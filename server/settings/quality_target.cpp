#include "server/settings/quality_target.h"

#include <cmath>

#include "server/text/number_text.h"

namespace herr {

double quality_target_ms(const ReplayOptions& options, const FrameRange& range) {
  return options.target_ms.value_or(range.period_ms());
}

std::string target_text(double target_ms) {
  return shortest_text(std::round(100 * target_ms) / 100);
}

int narrowest_width(const ReplayOptions& options, const RenderSettings& settings) {
  return options.narrowest_width.value_or(default_narrowest(settings.polar_width));
}

int lowest_height(const ReplayOptions& options, const RenderSettings& settings) {
  return options.lowest_height.value_or(default_lowest(settings.polar_height));
}

bool is_reproducible(const ReplayOptions& options) {
  return options.clock != ReplayClock::realtime && !options.policy.deadline;
}

}  // namespace herr
