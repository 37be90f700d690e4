// How a limb, a head or an eye goes from one place to another: the smoothest way, with the least jerk (T.
// Flash and N. Hogan, The coordination of arm movements, J. Neuroscience 5, 1985). Before: where and when.
// After: head turns and saccades.
#pragma once

#include <algorithm>

namespace herr {

// The highest speed of a movement over its mean speed: 30 t^2 (1 - t)^2 at t = 1/2.
inline constexpr double kMinimumJerkPeak = 1.875;

// Share of the way after the share `x` of the time: 0 to 1, speed and acceleration 0 at both ends.
inline double minimum_jerk(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

}  // namespace herr
