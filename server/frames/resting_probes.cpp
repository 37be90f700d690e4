#include "server/frames/resting_probes.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

// First in long steps, to gather light of many bounces, then at the display's rate, for the noise that its
// frames have. Of the long steps' noise, whose variance is six times that, e^-4 = 2 % is left.
constexpr int kLongSteps = 16;
constexpr double kLongStep_s = 0.15, kTimeConstantsAtRate = 2;
constexpr TimeNs kFewestAtRate = 8;

}  // namespace

void let_probes_rest(Renderer& renderer, const FrameSample& at, const SceneState& state, double display_hz) {
  if (!renderer.plan().probes) return;
  const double tau_s = renderer.settings().probes.hysteresis_tau_s;
  const double period_s = 1.0 / display_hz;
  const auto at_rate =
      std::max(kFewestAtRate, static_cast<TimeNs>(std::ceil(kTimeConstantsAtRate * tau_s / period_s)));
  const double rate_s = static_cast<double>(at_rate) * period_s;
  FrameSample sample = at;
  const auto gather_at = [&](double before_s) {
    sample.t_ns = at.t_ns - static_cast<TimeNs>(std::llround(before_s * 1e9));
    renderer.skip_frame(sample, state);
  };
  for (int k = kLongSteps; k > 0; --k) gather_at(rate_s + k * kLongStep_s);
  for (TimeNs k = at_rate; k > 0; --k) gather_at(static_cast<double>(k) * period_s);
}

}  // namespace herr
