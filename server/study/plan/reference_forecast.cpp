#include "server/study/plan/reference_forecast.h"

#include <cmath>

#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kReferences = 2;  // endless effort and hard light
constexpr double kShare = 0.5;     // of the minutes

}  // namespace

std::string too_long_references(double two_passes_s, double minutes, const RenderSettings& asked,
                                double profile_scale) {
  const double needed_s = kReferences * two_passes_s, needed_minutes = needed_s / 60 / kShare;
  if (needed_minutes <= minutes) return {};
  std::string flags;
  if (asked.probes.on || asked.occlusion_rays > 0) flags += "--preset direct ";
  if (profile_scale > kSmallScale) flags += "--profile-scale " + shortest_text(kSmallScale) + " ";
  return "the references of one frame alone take about " + fixed_text(std::ceil(needed_s), 0) +
         " s, more than half of --minutes " + shortest_text(minutes) +
         ": they have one pass in place of two or more, so that small errors are not told apart; give " +
         (flags.empty() ? "" : flags + "or ") + "--minutes " +
         fixed_text(std::ceil(kReserve * needed_minutes), 0);
}

}  // namespace herr
