// A head: somebody who stands, turns about, walks, or works at a desk. Smooth, a pure function of seed and
// time. Before: the seed. After: pose/data.csv, the camera that looks from there, and the eyes (gaze_motion).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/synth/smooth_noise.h"
#include "server/synth/walk_path.h"
#include "sessions/format/pose.h"

namespace herr {

enum class MotionKind {
  desk,      // shifts about before a table and looks down at it: 15-20 cm, 8 degrees
  standing,  // quiet standing: 1 cm of sway
  turning,   // stands and turns the head to one thing after another, up to 200 degrees a second
  walking,   // walks up and down
  still,     // does not move at all
};
const std::vector<std::string>& motion_names();  // in the order of MotionKind

struct HeadMotionOptions {
  std::uint64_t seed = 1;
  MotionKind kind = MotionKind::desk;
  WalkArea area;  // its centre is where all but walkers stay
};

// Thread-safe.
class HeadMotion {
 public:
  explicit HeadMotion(const HeadMotionOptions& options);
  // World from head at `time_s` >= 0. Standing people face -Z.
  Pose at(double time_s) const;

 private:
  // Where the head is before it looks anywhere, and where it looks: yaw, pitch, roll.
  struct Posture {
    glm::dvec3 position{0.0};
    glm::dvec3 turn_deg{0.0};
  };
  Posture walking(double time_s) const;
  glm::dvec2 head_turn_deg(double time_s) const;

  HeadMotionOptions options_;
  std::optional<WalkPath> path_;
  std::array<SmoothNoise, 3> sway_;  // metres
  std::array<SmoothNoise, 3> turn_;  // degrees: yaw, pitch, roll
  double step_phase_rad_ = 0;
};

}  // namespace herr
