#include "server/synth/head_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "server/synth/minimum_jerk.h"
#include "server/synth/seeded_random.h"

namespace herr {
namespace {

constexpr std::uint64_t kStepStream = 6, kYawStream = 40, kPitchStream = 41, kPeakStream = 42,
                        kStartStream = 43;

// How far and how fast a standing head wobbles.
struct Wobble {
  glm::dvec3 sway_m{0.0};    // x, y, z
  glm::dvec3 turn_deg{0.0};  // yaw, pitch, roll
  double sway_low_hz = 0.1, sway_high_hz = 1.0, turn_low_hz = 0.1, turn_high_hz = 1.0;
};

Wobble wobble_of(MotionKind kind) {
  switch (kind) {
    case MotionKind::desk:
      return {{0.15, 0.03, 0.20}, {8.0, 4.0, 1.5}, 0.1, 0.6, 0.15, 1.5};
    case MotionKind::standing:
    case MotionKind::turning:
      // Quiet standing: a centimetre forwards and back, less sideways, below 1 Hz (D. A. Winter, Human
      // balance and posture control during standing and walking, Gait & Posture 3, 1995).
      return {{0.008, 0.002, 0.012}, {1.5, 1.0, 0.5}, 0.1, 1.0, 0.1, 1.0};
    case MotionKind::walking:
      return {{0.02, 0.002, 0.02}, {12.0, 4.0, 1.5}, 0.1, 0.6, 0.1, 0.6};
    case MotionKind::still:
      break;
  }
  return {};
}

// Steps: 1.8 a second (Pachi and Ji 2005).
constexpr double kStepHz = 1.8;
constexpr double kDeskLookingDownDeg = 12.0;                        // towards things on tables and floor
constexpr double kDeskStepHeightM = 0.015, kDeskStepWidthM = 0.01;  // treading from foot to foot
// At 1.2 m/s the head goes up and down by 4 cm with each step and the nose down when the head is high,
// so that it keeps pointing at a place ahead (E. Hirasaki et al., Effects of walking velocity on
// vertical head and body movements during locomotion, Experimental Brain Research 127, 1999); sideways 4
// cm with each pair of steps.
constexpr double kWalkHeightM = 0.02, kWalkWidthM = 0.02, kWalkPitchDeg = 1.2, kWalkLookingDownDeg = 5.0;
constexpr double kFullStepSpeed = 1.2;  // m/s

// Head turns: one in each slot, minimum-jerk, 100-200 degrees a second at their fastest.
constexpr double kTurnSlotS = 2.8, kLatestTurnStartS = 0.4, kShortestTurnS = 0.35;
constexpr double kSlowestPeakDegS = 100.0, kFastestPeakDegS = 200.0;
constexpr double kWidestHeadYawDeg = 60.0, kWidestHeadPitchDeg = 15.0;

}  // namespace

const std::vector<std::string>& motion_names() {
  static const std::vector<std::string> kNames{"desk", "standing", "turning", "walking", "still"};
  return kNames;
}

HeadMotion::HeadMotion(const HeadMotionOptions& options) : options_(options) {
  const Wobble wobble = wobble_of(options.kind);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<glm::length_t>(axis);
    sway_[axis] = SmoothNoise(options.seed, axis, wobble.sway_m[i], wobble.sway_low_hz, wobble.sway_high_hz);
    turn_[axis] =
        SmoothNoise(options.seed, axis + 3, wobble.turn_deg[i], wobble.turn_low_hz, wobble.turn_high_hz);
  }
  step_phase_rad_ = SeededRandom(options.seed, kStepStream).uniform(0, kTwoPi);
  if (options.kind == MotionKind::walking) path_.emplace(options.seed, options.area);
}

HeadMotion::Posture HeadMotion::walking(double time_s) const {
  const WalkPath::State walk = path_->at(time_s);
  const double step_rad = kTwoPi * kStepHz * time_s + step_phase_rad_;
  const double strength = walk.speed_m_s / kFullStepSpeed;
  const glm::dvec3 right{std::cos(walk.heading_rad), 0, -std::sin(walk.heading_rad)};
  Posture posture;
  posture.position = walk.position + strength * (kWalkWidthM * std::sin(step_rad / 2) * right +
                                                 glm::dvec3{0, kWalkHeightM * std::sin(step_rad), 0});
  posture.turn_deg = {glm::degrees(walk.heading_rad),
                      -kWalkLookingDownDeg - strength * kWalkPitchDeg * std::sin(step_rad), 0};
  return posture;
}

// Yaw and pitch. Each slot turns from the direction of the one before to its own.
glm::dvec2 HeadMotion::head_turn_deg(double time_s) const {
  const auto slot = static_cast<std::uint64_t>(time_s / kTurnSlotS);
  const auto direction = [&](std::uint64_t index) {
    if (index == 0) return glm::dvec2(0.0);  // of slot -1: straight ahead
    return glm::dvec2(
        keyed_uniform(options_.seed, kYawStream, index, -kWidestHeadYawDeg, kWidestHeadYawDeg),
        keyed_uniform(options_.seed, kPitchStream, index, -kWidestHeadPitchDeg, kWidestHeadPitchDeg));
  };
  const glm::dvec2 from = direction(slot), to = direction(slot + 1);
  const double peak_deg_s =
      keyed_uniform(options_.seed, kPeakStream, slot, kSlowestPeakDegS, kFastestPeakDegS);
  const double turn_s =
      std::max(kShortestTurnS, kMinimumJerkPeak * std::hypot(to.x - from.x, to.y - from.y) / peak_deg_s);
  const double start_s = keyed_uniform(options_.seed, kStartStream, slot, 0, kLatestTurnStartS);
  const double since_s = time_s - static_cast<double>(slot) * kTurnSlotS - start_s;
  return from + minimum_jerk(since_s / turn_s) * (to - from);
}

Pose HeadMotion::at(double time_s) const {
  Posture posture;
  posture.position = options_.area.centre;
  if (options_.kind == MotionKind::desk) {
    const double step_rad = kTwoPi * kStepHz * time_s + step_phase_rad_;
    posture.position +=
        glm::dvec3{kDeskStepWidthM * std::sin(step_rad / 2), kDeskStepHeightM * std::sin(step_rad), 0};
    posture.turn_deg.y = -kDeskLookingDownDeg;
  } else if (options_.kind == MotionKind::turning) {
    posture.turn_deg = glm::dvec3(head_turn_deg(time_s), 0);
  } else if (options_.kind == MotionKind::walking) {
    posture = walking(time_s);
  }
  Pose pose;
  pose.position = posture.position + glm::dvec3{sway_[0](time_s), sway_[1](time_s), sway_[2](time_s)};
  const glm::dvec3 turn_rad =
      glm::radians(posture.turn_deg + glm::dvec3{turn_[0](time_s), turn_[1](time_s), turn_[2](time_s)});
  const glm::dquat yaw = glm::angleAxis(turn_rad.x, glm::dvec3{0, 1, 0});
  const glm::dquat pitch = glm::angleAxis(turn_rad.y, glm::dvec3{1, 0, 0});
  const glm::dquat roll = glm::angleAxis(turn_rad.z, glm::dvec3{0, 0, 1});
  pose.orientation = glm::normalize(yaw * pitch * roll);
  return pose;
}

}  // namespace herr
