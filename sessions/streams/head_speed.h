// How fast the head moves, from recorded poses alone: it depends on no clock, frame rate or first frame.
// Velocities are smoothed as vectors, so that a tracker's noise cancels, and their lengths fall off slowly: a
// turn counts at once, its end only after a while. Before: PoseSampler, row by row. After: FrameSample.
#pragma once

#include <optional>

#include "sessions/format/pose.h"

namespace herr {

// Not thread-safe. Steps of the smoothing are exact, exp(-dt / tau), for any dt.
class HeadSpeedMeter {
 public:
  static constexpr double kSmoothing_s = 0.02;  // time constant of the velocities
  static constexpr double kRelease_s = 0.25;    // time constant with which a speed falls off

  // Poses with stamps that grow.
  void add(TimeNs stamp_ns, const Pose& world_from_head);
  // As of the pose added last; 0 before the second one. After a gap of more than a second (kMaxPoseGapNs) the
  // head is taken to have come to rest.
  const HeadSpeed& speed() const { return speed_; }

 private:
  std::optional<TimeNs> stamp_ns_;  // of the last pose that was taken
  Pose pose_;
  glm::dvec3 turn_rad_s_{0.0}, move_m_s_{0.0};
  HeadSpeed speed_;
};

}  // namespace herr
