// What a frame of some quality will take: a fixed part and, for each kind of ray, time per ray x rays per
// unit of work x units. Times are noisy and smoothed exponentially. Counts are exact: more of them are
// believed at once, fewer as times are, since what left the view with a glance comes back with the next.
// Before: FrameCost of finished frames. After: DeadlinePolicy asks what fits.
#pragma once

#include <array>

#include "server/quality/frame_cost.h"

namespace herr {

// No time leaves [0, kLongestMs], whatever is learnt: what is not finite counts as the longest.
inline constexpr double kLongestMs = 1e7;  // 2.8 hours

class CostModel {
 public:
  // keep in [0, 1]: the share of what was known before that stays, exp(-dt / tau) for a time constant tau;
  // 0 takes the frame for the whole truth.
  void learn(const FrameCost& cost, double keep);

  double predict_ms(const FrameQuality& quality) const;
  // The largest width with which a frame of the height, light samples and probes of `quality` takes at most
  // `budget_ms`, as a real number: 0 or less when not even one column fits, 1e9 when columns cost nothing.
  double width_for(double budget_ms, const FrameQuality& quality) const;

 private:
  double per_column_ms(const FrameQuality& quality) const;
  double without_columns_ms(const FrameQuality& quality) const;

  double fixed_ms_ = 0;
  std::array<double, kWorkKinds> ns_per_ray_{};
  std::array<double, kWorkKinds> rays_per_unit_{};
};

}  // namespace herr
