#include "sessions/streams/head_speed.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sessions/streams/pose_sampler.h"

namespace herr {
namespace {

// The turn from a to b as axis times angle, the short way round.
glm::dvec3 rotation_vector(const glm::dquat& a, const glm::dquat& b) {
  glm::dquat turn = b * glm::conjugate(a);
  if (turn.w < 0) turn = -turn;
  const glm::dvec3 axis(turn.x, turn.y, turn.z);
  const double sine = glm::length(axis);
  if (sine == 0) return glm::dvec3{0.0};
  return axis * (2 * std::atan2(sine, turn.w) / sine);
}

// Rises at once, falls off with the time constant.
double followed(double held, double speed, double dt_s) {
  const double keep = std::exp(-dt_s / HeadSpeedMeter::kRelease_s);
  return std::max(speed, speed + (held - speed) * keep);
}

}  // namespace

void HeadSpeedMeter::add(TimeNs stamp_ns, const Pose& world_from_head) {
  if (!stamp_ns_) {
    stamp_ns_ = stamp_ns;
    pose_ = world_from_head;
    return;
  }
  const TimeNs step_ns = stamp_ns - *stamp_ns_;
  if (step_ns < kMinPoseStepNs) return;  // the clock's jitter is no velocity
  const double dt_s = static_cast<double>(step_ns) * kSecondsPerNs;
  glm::dvec3 turn{0.0}, move{0.0};
  if (step_ns <= kMaxPoseGapNs) {
    turn = rotation_vector(pose_.orientation, world_from_head.orientation) / dt_s;
    move = (world_from_head.position - pose_.position) / dt_s;
  }
  const double keep = std::exp(-dt_s / kSmoothing_s);
  turn_rad_s_ = turn + (turn_rad_s_ - turn) * keep;
  move_m_s_ = move + (move_m_s_ - move) * keep;
  speed_.turn_rad_s = followed(speed_.turn_rad_s, glm::length(turn_rad_s_), dt_s);
  speed_.move_m_s = followed(speed_.move_m_s, glm::length(move_m_s_), dt_s);
  stamp_ns_ = stamp_ns;
  pose_ = world_from_head;
}

}  // namespace herr
