// Where a person looks: fixations on points of the room, saccades between them, blinks.
// Saccade durations follow the main sequence, 21 ms + 2.2 ms per degree (Carpenter 1988); fixations last
// 200-500 ms. Before: HeadMotion. After: gaze/data.csv.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "server/synth/head_motion.h"

namespace herr {

double saccade_duration_s(double amplitude_deg);

class GazeMotion {
 public:
  // Plans the whole recording; directions stay within 25 degrees of straight ahead when a target is chosen.
  GazeMotion(std::uint64_t seed, double duration_s, const HeadMotion& head);

  struct Sample {
    std::array<glm::dvec3, 2> head_direction{};  // per eye, unit, head space
    bool valid = true;                           // false during a blink
  };
  // `head_from_eye`: positions of the eyes in head space.
  Sample at(double time_s, const std::array<Pose, 2>& head_from_eye) const;

 private:
  struct Fixation {
    double start_s = 0;    // the eye arrives
    double leave_s = 0;    // the saccade to the next one starts
    glm::dvec3 target{0};  // world
  };
  glm::dvec3 target_at(double time_s) const;

  const HeadMotion* head_;
  std::vector<Fixation> fixations_;
  std::vector<double> blink_starts_s_;
};

}  // namespace herr
