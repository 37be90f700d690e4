#include "server/synth/gaze_motion.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "server/synth/minimum_jerk.h"

namespace herr {
namespace {

constexpr std::uint64_t kNoiseStream = 18;
constexpr double kStillAwayM = 2.0;
constexpr double kWidestJumpDeg = 40.0;

glm::dvec3 direction_of(double yaw_deg, double pitch_deg) {
  const double yaw = glm::radians(yaw_deg), pitch = glm::radians(pitch_deg);
  return {std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

// From one unit vector to another that is not opposite, at even angular speed.
glm::dvec3 along_arc(const glm::dvec3& from, const glm::dvec3& to, double share) {
  const double angle_rad = glm::radians(angle_between_deg(from, to));
  if (angle_rad < 1e-9) return from;
  return (std::sin((1.0 - share) * angle_rad) * from + std::sin(share * angle_rad) * to) /
         std::sin(angle_rad);
}

bool looks_at_targets(GazeKind kind) {
  return kind != GazeKind::still && kind != GazeKind::jumping;
}

}  // namespace

GazeMotion::GazeMotion(const GazeMotionOptions& options, const HeadMotion& head)
    : options_(options),
      head_(&head),
      targets_(options.seed, options.kind, head),
      noise_(options.seed, kNoiseStream) {
  if (looks_at_targets(options.kind)) present_ = targets_.first();
}

glm::dvec3 GazeMotion::aim_in_world(double time_s) {
  while (time_s > present_.leave_s) {
    if (!next_) {
      next_ = targets_.next(present_);
      ++saccades_;
    }
    if (time_s < next_->start_s) break;
    present_ = *next_;
    next_.reset();
  }
  if (!next_) return present_.at(time_s);
  // Within a saccade. Direction and inverse distance change evenly: the eyes turn and
  // converge at the same time.
  const double share = minimum_jerk((time_s - present_.leave_s) / (next_->start_s - present_.leave_s));
  const glm::dvec3 head = head_->at(time_s).position;
  const glm::dvec3 from = present_.at(present_.leave_s) - head, to = next_->point - head;
  const double from_m = glm::length(from), to_m = glm::length(to);
  return head + along_arc(from / from_m, to / to_m, share) / glm::mix(1.0 / from_m, 1.0 / to_m, share);
}

glm::dvec3 GazeMotion::aim_in_head(double time_s) {
  if (options_.kind == GazeKind::still) return {0, 0, -kStillAwayM};
  if (options_.kind == GazeKind::jumping) {
    const double yaw_deg = noise_.uniform(-kWidestJumpDeg, kWidestJumpDeg);
    return kStillAwayM * direction_of(yaw_deg, noise_.uniform(-kWidestJumpDeg, kWidestJumpDeg));
  }
  return inverse(head_->at(time_s))(aim_in_world(time_s));
}

std::array<glm::dvec3, 2> GazeMotion::at(double time_s, const std::array<Pose, 2>& head_from_eye) {
  const glm::dvec3 aim = aim_in_head(time_s);
  std::array<glm::dvec3, 2> directions;
  for (std::size_t eye = 0; eye < directions.size(); ++eye) {
    const glm::dvec3 sight = aim - head_from_eye[eye].position;
    glm::dvec3 blur(0.0);
    if (options_.noise_deg > 0) {
      const double x = noise_.normal(), y = noise_.normal(), z = noise_.normal();
      blur = glm::length(sight) * glm::radians(options_.noise_deg) * glm::dvec3{x, y, z};
    }
    directions[eye] = glm::normalize(sight + blur);
  }
  return directions;
}

}  // namespace herr
