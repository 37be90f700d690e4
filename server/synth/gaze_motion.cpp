#include "server/synth/gaze_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "server/synth/seeded_random.h"

namespace herr {
namespace {

constexpr double kWidestYawDeg = 25, kWidestPitchDeg = 15;
constexpr double kNearestM = 1.0, kFarthestM = 5.0;
constexpr double kShortestFixationS = 0.2, kLongestFixationS = 0.5;
constexpr double kBlinkS = 0.15, kBlinkEveryS = 4.0;
constexpr std::uint64_t kTargetStream = 16, kBlinkStream = 17;

// A point of the room in front of the head.
glm::dvec3 choose_target(SeededRandom& random, const Pose& world_from_head) {
  const double yaw = glm::radians(random.uniform(-kWidestYawDeg, kWidestYawDeg));
  const double pitch = glm::radians(random.uniform(-kWidestPitchDeg, kWidestPitchDeg));
  const double distance_m = random.uniform(kNearestM, kFarthestM);
  const glm::dvec3 direction{std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                             -std::cos(yaw) * std::cos(pitch)};
  return world_from_head(direction * distance_m);
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

// Position along a saccade: minimum-jerk, 0 to 1 with zero speed and acceleration at both ends.
double minimum_jerk(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

}  // namespace

double saccade_duration_s(double amplitude_deg) {
  return 0.021 + 0.0022 * amplitude_deg;
}

GazeMotion::GazeMotion(std::uint64_t seed, double duration_s, const HeadMotion& head) : head_(&head) {
  SeededRandom random(seed, kTargetStream);
  double arrival_s = 0;
  glm::dvec3 target = choose_target(random, head.at(0));
  // One fixation more than the recording holds: every time lies before the end of one.
  while (fixations_.empty() || fixations_.back().leave_s <= duration_s) {
    const double leave_s = arrival_s + random.uniform(kShortestFixationS, kLongestFixationS);
    fixations_.push_back({arrival_s, leave_s, target});
    const Pose pose = head.at(leave_s);
    const glm::dvec3 next = choose_target(random, pose);
    arrival_s = leave_s + saccade_duration_s(angle_deg(target - pose.position, next - pose.position));
    target = next;
  }

  SeededRandom blinks(seed, kBlinkStream);
  double blink_s = std::min(kBlinkEveryS, duration_s) * blinks.uniform(0.45, 0.6);
  while (blink_s < duration_s) {
    blink_starts_s_.push_back(blink_s);
    blink_s += kBlinkEveryS * blinks.uniform(0.6, 1.4);
  }
}

glm::dvec3 GazeMotion::target_at(double time_s) const {
  const auto next = std::upper_bound(fixations_.begin(), fixations_.end(), time_s,
                                     [](double time, const Fixation& f) { return time < f.start_s; });
  const Fixation& present = next == fixations_.begin() ? fixations_.front() : *std::prev(next);
  if (time_s <= present.leave_s || next == fixations_.end()) return present.target;
  const double share = minimum_jerk((time_s - present.leave_s) / (next->start_s - present.leave_s));
  // Direction and inverse distance change evenly: the eyes turn and converge at the same time.
  const glm::dvec3 head = head_->at(time_s).position;
  const glm::dvec3 from = present.target - head, to = next->target - head;
  const double from_m = glm::length(from), to_m = glm::length(to);
  const glm::dvec3 direction = glm::normalize(glm::mix(from / from_m, to / to_m, share));
  return head + direction / glm::mix(1.0 / from_m, 1.0 / to_m, share);
}

GazeMotion::Sample GazeMotion::at(double time_s, const std::array<Pose, 2>& head_from_eye) const {
  const glm::dvec3 target = inverse(head_->at(time_s))(target_at(time_s));
  Sample sample;
  for (std::size_t eye = 0; eye < head_from_eye.size(); ++eye) {
    sample.head_direction[eye] = glm::normalize(target - head_from_eye[eye].position);
  }
  for (const double start_s : blink_starts_s_) {
    if (time_s >= start_s && time_s < start_s + kBlinkS) sample.valid = false;
  }
  return sample;
}

}  // namespace herr
