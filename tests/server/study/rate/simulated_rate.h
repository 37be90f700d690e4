// A machine whose frames cost what a formula says, for the search of `herr study --hz`: nobody waits.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>

#include "server/study/rate/rate_ladder.h"
#include "server/study/rate/rate_trial.h"

namespace herr::test {

// Milliseconds of both eyes at the paper's size, one light sample, and all pixels of the profile.
struct RateCost {
  double fixed_ms = 1, samples_ms = 50, light_ms = 20, pixels_ms = 30;
};

inline double cost_ms(const RateCost& cost, const RateSetting& setting) {
  const double samples = setting.polar_width / 788.0 * setting.polar_height / 768.0;
  return cost.fixed_ms + samples * (cost.samples_ms + cost.light_ms * setting.light_samples) +
         setting.profile_scale * setting.profile_scale * cost.pixels_ms;
}

inline RateTrial trial_of(double p95_ms, int frames = 100) {
  RateTrial trial;
  trial.frames = frames;
  trial.p95_ms = p95_ms;
  trial.frame_ms = 0.9 * p95_ms;
  return trial;
}

}  // namespace herr::test
