// Holds the frame time at a target by polar width and height, light samples and probes. A controller without
// a clock: it is told what finished frames cost and says what the next one may have. The size of the polar
// buffer is one number, its samples as columns of full height; width and height follow from it together, from
// the whole to the least of both. So whatever holds that number (growth, dead band, holds) holds both. The
// aim is target / (1 + head-room): of frames that scatter around it like a normal distribution, 2 % miss the
// target when the head-room is 2.06 standard deviations. A frame far from its forecast replaces what the cost
// model knows, until the next one proves it a hiccup; others only move it, towards "slower" twice as fast as
// towards "faster". Before: FrameCost of each frame. After: QualityController.
#pragma once

#include <optional>
#include <vector>

#include "server/quality/cost_model.h"
#include "server/quality/quality_policy.h"

namespace herr {

struct DeadlineConfig {
  double target_ms = 1000.0 / 60;
  QualityLimits limits;

  double headroom_deviations = 2.06;  // of the relative deviation of frames from their forecasts: 2 % miss
  double least_headroom = 0.03;       // also where frames never deviate
  double largest_deviation =
      0.5;                     // what scatters more is no noise around a forecast: the aim stays above half
  double noise_frames = 50;    // memory of that deviation; noise is a matter of frames, not of seconds
  double jump_deviations = 4;  // farther from its forecast a frame is a change, not noise
  double rise_tau_s = 0.25, fall_tau_s = 0.5;  // of the smoothing of costs, where a frame was slower, faster

  double growth = 2;                // size of a frame over that of the one before, at most
  double keep_below = 1.02;         // dead band: the size stays where up to 2 % more
  double keep_above = 0.99;         // or 1 % less would fit
  int hold_frames = 2;              // after a missed frame the size does not grow for so long
  double overload_share = 0.8;      // of the size, at most, after two missed frames in a row
  double less_light_below = 0.5;    // of the full size: rather fewer light samples and probes
  double more_light_above = 0.7;    // of the full size: more of them again, after a wait
  double more_light_after_s = 0.5;  // that much later; twice as long each time that it had to be taken back
  double longest_wait_s = 60;
};

// Not thread-safe. Any times and counts are taken: the state stays finite, the size within its limits.
class DeadlinePolicy {
 public:
  explicit DeadlinePolicy(const DeadlineConfig& config);

  // The quality of the next frame: nothing in it exceeds `wish` or falls below the limits.
  QualityDecision decide(const FrameQuality& wish);
  // Each finished frame, and one that was given up with the time until then.
  void observe(const FrameCost& cost);

  double headroom() const;
  double deviation() const;  // measured, relative to the forecasts

 private:
  struct Effort {
    int light_samples, probes;
  };
  FrameQuality with_effort(std::size_t level, const FrameQuality& wish) const;
  bool fits(std::size_t level, double share, const FrameQuality& wish, double aim_ms) const;
  // True when the level of effort has changed.
  bool choose_effort(const FrameQuality& wish, double aim_ms);
  struct PolarSize {
    int width, height;
    double columns;  // of full height that it has, before rounding: what is kept is the same size again
  };
  double columns_of(const PolarSize& size) const;
  PolarSize least_size(int narrowest) const;
  PolarSize size_of(double columns, int narrowest, int widest) const;
  // How many columns of full height the next frame may have, before limits; the reason by how they change.
  double wanted_columns(double fitting, QualityReason& reason) const;
  PolarSize choose_size(const FrameQuality& quality, double aim_ms, QualityReason& reason) const;
  void learn_noise(double ratio, double band);

  const DeadlineConfig config_;
  std::vector<Effort> efforts_;  // from everything down to the least; each about half of the one before
  CostModel model_;
  std::optional<CostModel> before_jump_;  // what was known before a slow frame that was believed
  bool knows_ = false;                    // a frame was observed
  TimeNs observed_ns_ = 0;                // when
  double variance_ = 0;                   // of frames relative to their forecasts
  int missed_in_row_ = 0, hold_ = 0;
  PolarSize size_;           // of the frame decided last
  std::size_t effort_;       // index of efforts_
  double ready_s_ = 0;       // for how long more light would have fitted
  double since_more_s_ = 0;  // since there was more light
  double wait_s_;
};

}  // namespace herr
