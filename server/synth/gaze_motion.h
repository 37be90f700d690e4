// Where a person looks at each moment: the eyes rest on targets while the head moves (vestibulo-ocular reflex
// of gain 1), and jump between them. Before: GazeTargets. After: gaze/data.csv.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "server/synth/gaze_targets.h"
#include "server/synth/head_motion.h"
#include "server/synth/seeded_random.h"

namespace herr {

struct GazeMotionOptions {
  std::uint64_t seed = 1;
  GazeKind kind = GazeKind::fixations;
  double noise_deg = 0;  // deviation of each eye's direction on each axis, drawn anew for each sample
};

// Not thread-safe: times never decrease. Memory does not grow with time.
class GazeMotion {
 public:
  // `head` must outlive it.
  GazeMotion(const GazeMotionOptions& options, const HeadMotion& head);

  // Unit directions in head space, one for each eye at `head_from_eye`.
  std::array<glm::dvec3, 2> at(double time_s, const std::array<Pose, 2>& head_from_eye);
  // Begun so far, catch-up saccades included.
  std::int64_t saccades() const { return saccades_; }
  // What the eyes rest on or came from.
  const GazeTarget& target() const { return present_; }

 private:
  glm::dvec3 aim_in_head(double time_s);
  glm::dvec3 aim_in_world(double time_s);

  GazeMotionOptions options_;
  const HeadMotion* head_;
  GazeTargets targets_;
  GazeTarget present_;
  std::optional<GazeTarget> next_;  // known from when the eyes leave
  SeededRandom noise_;
  std::int64_t saccades_ = 0;
};

}  // namespace herr
