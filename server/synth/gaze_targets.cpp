#include "server/synth/gaze_targets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace herr {
namespace {

constexpr std::uint64_t kTargetStream = 16;
constexpr double kWidestEyeYawDeg = 22, kWidestEyePitchDeg = 13;
constexpr double kNearestM = 1.0, kFarthestM = 5.0;
// Where the head is turning to is known this much ahead: gaze leads.
constexpr double kAnticipationS = 0.1;
// Further off the head's axis the eyes do not stay: they jump on (the fast phase of nystagmus).
constexpr double kNearestSeenM = 0.4;  // nor on what a walker is about to run into
constexpr double kReachDeg = 26.0, kShortestStayS = 0.05, kReachStepS = 0.01;

// Fixations last 0.26-0.33 s in scenes and 0.225-0.25 s in silent reading, where a saccade spans 2 degrees
// and one in ten goes back (K. Rayner, Eye movements and attention in reading, scene perception, and visual
// search, Quarterly J. Experimental Psychology 62, 2009). The mean of a log-normal: median exp(sigma^2 / 2).
constexpr double kSceneMedianS = 0.28, kReadingMedianS = 0.225, kStaySigma = 0.35;
constexpr double kLeastFixationS = 0.1, kMostFixationS = 0.8;

// Below 30 degrees a second the eyes keep up with nine tenths of a target's speed (C. H. Meyer, A. G. Lasker
// and D. A. Robinson, The upper limit of human smooth pursuit velocity, Vision Research 25, 1985: 0.87-0.93);
// a saccade of 1-2 degrees makes up for the rest (S. de Brouwer et al., What triggers catch-up saccades
// during visual tracking?, J. Neurophysiology 87, 2002).
constexpr double kPursuitGain = 0.9, kCatchUpDeg = 1.5;
constexpr double kSlowestTargetDegS = 5.0, kFastestTargetDegS = 30.0;
constexpr double kShortestFlightS = 1.0, kLongestFlightS = 2.5, kLeastFollowedS = 0.1;

constexpr double kPageAwayM = 0.6, kPageDownDeg = 15.0;
constexpr double kLineHalfM = 0.10, kWordM = 0.021, kLineSpacingM = 0.01, kRegressions = 0.1;
constexpr int kLines = 20;

}  // namespace

const std::vector<std::string>& gaze_names() {
  static const std::vector<std::string> kNames{"fixations", "pursuit", "reading", "still", "jumping"};
  return kNames;
}

double saccade_duration_s(double amplitude_deg) {
  return 0.021 + 0.0022 * amplitude_deg;
}

double angle_between_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

GazeTargets::GazeTargets(std::uint64_t seed, GazeKind kind, const HeadMotion& head)
    : random_(seed, kTargetStream), kind_(kind), head_(&head) {}

GazeTarget GazeTargets::first() {
  if (kind_ == GazeKind::pursuit) chase_another(0);
  if (kind_ == GazeKind::reading) turn_page(0);
  GazeTarget target;
  target.point = kind_ == GazeKind::pursuit   ? pursued_.point
                 : kind_ == GazeKind::reading ? place_on_page()
                                              : point_ahead(0);
  if (kind_ == GazeKind::pursuit) target.velocity = kPursuitGain * pursued_.velocity;
  target.leave_s = leave_s(target, stay_s(target));
  return target;
}

GazeTarget GazeTargets::next(const GazeTarget& now) {
  const double time_s = now.leave_s;
  if (kind_ == GazeKind::pursuit) {
    const glm::dvec3 place = pursued_.point + (time_s - pursued_.appears_s) * pursued_.velocity;
    if (time_s + kLeastFollowedS > pursued_.ends_s || !within_reach(place, time_s)) chase_another(time_s);
  }
  GazeTarget target = kind_ == GazeKind::pursuit   ? pursuit(time_s)
                      : kind_ == GazeKind::reading ? word(time_s)
                                                   : fixation(time_s);
  // What moves has moved on when the eyes land: they aim ahead of it.
  const glm::dvec3 head = head_->at(time_s).position;
  const double amplitude_deg = angle_between_deg(now.at(time_s) - head, target.point - head);
  target.start_s = time_s + saccade_duration_s(amplitude_deg);
  if (kind_ == GazeKind::pursuit)
    target.point = pursued_.point + (target.start_s - pursued_.appears_s) * pursued_.velocity;
  target.leave_s = leave_s(target, stay_s(target));
  return target;
}

// A point of the room in front of the head.
glm::dvec3 GazeTargets::point_ahead(double time_s) {
  const double yaw = glm::radians(random_.uniform(-kWidestEyeYawDeg, kWidestEyeYawDeg));
  const double pitch = glm::radians(random_.uniform(-kWidestEyePitchDeg, kWidestEyePitchDeg));
  const double distance_m = random_.uniform(kNearestM, kFarthestM);
  const glm::dvec3 direction{std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                             -std::cos(yaw) * std::cos(pitch)};
  return head_->at(time_s + kAnticipationS)(direction * distance_m);
}

GazeTarget GazeTargets::fixation(double time_s) {
  GazeTarget target;
  target.point = point_ahead(time_s);
  return target;
}

GazeTarget GazeTargets::pursuit(double time_s) {
  GazeTarget target;
  target.point = pursued_.point + (time_s - pursued_.appears_s) * pursued_.velocity;
  target.velocity = kPursuitGain * pursued_.velocity;
  return target;
}

GazeTarget GazeTargets::word(double time_s) {
  const bool back = random_.uniform(0, 1) < kRegressions && page_.column_m > -kLineHalfM + kWordM;
  page_.column_m += (back ? -1.0 : random_.uniform(0.8, 1.2)) * kWordM;
  if (page_.column_m > kLineHalfM) {
    page_.column_m = -kLineHalfM;
    ++page_.line;
  }
  if (page_.line >= kLines || !within_reach(place_on_page(), time_s)) turn_page(time_s);
  GazeTarget target;
  target.point = place_on_page();
  return target;
}

void GazeTargets::chase_another(double time_s) {
  pursued_.appears_s = time_s;
  pursued_.ends_s = time_s + random_.uniform(kShortestFlightS, kLongestFlightS);
  pursued_.point = point_ahead(time_s);
  // Across the line of sight, any way round.
  const glm::dvec3 sight = pursued_.point - head_->at(time_s).position;
  const glm::dvec3 side = glm::normalize(glm::cross(sight, glm::dvec3{0, 1, 0}));
  const glm::dvec3 up = glm::normalize(glm::cross(side, sight));
  const double around_rad = glm::radians(random_.uniform(0, 360));
  const double speed_deg_s = random_.uniform(kSlowestTargetDegS, kFastestTargetDegS);
  pursued_.velocity = glm::radians(speed_deg_s) * glm::length(sight) *
                      (std::cos(around_rad) * side + std::sin(around_rad) * up);
}

// A page before the head, a little below, facing it.
void GazeTargets::turn_page(double time_s) {
  const Pose head = head_->at(time_s + kAnticipationS);
  const glm::dquat down = glm::angleAxis(glm::radians(-kPageDownDeg), glm::dvec3{1, 0, 0});
  page_.world_from_page = head * Pose{down * glm::dvec3{0, 0, -kPageAwayM}, down};
  page_.column_m = -kLineHalfM;
  page_.line = 0;
}

glm::dvec3 GazeTargets::place_on_page() const {
  const double row_m = (0.5 * (kLines - 1) - page_.line) * kLineSpacingM;
  return page_.world_from_page(glm::dvec3{page_.column_m, row_m, 0});
}

bool GazeTargets::within_reach(const glm::dvec3& point, double time_s) const {
  const glm::dvec3 in_head = inverse(head_->at(time_s))(point);
  return glm::length(in_head) >= kNearestSeenM && angle_between_deg(in_head, {0, 0, -1}) <= kReachDeg;
}

double GazeTargets::stay_s(const GazeTarget& target) {
  if (kind_ != GazeKind::pursuit) {
    const double median_s = kind_ == GazeKind::reading ? kReadingMedianS : kSceneMedianS;
    return std::clamp(random_.log_normal(median_s, kStaySigma), kLeastFixationS, kMostFixationS);
  }
  // Until the target has run away from the eyes, or is gone.
  const double distance_m = glm::distance(target.point, head_->at(target.start_s).position);
  const double slip_m_s = (1.0 - kPursuitGain) * glm::length(pursued_.velocity);
  return std::min(pursued_.ends_s - target.start_s, glm::radians(kCatchUpDeg) * distance_m / slip_m_s);
}

// After `stay_s`, or earlier where the head turns away from the target.
double GazeTargets::leave_s(const GazeTarget& target, double stay_s) const {
  double stay = kShortestStayS;
  while (stay < stay_s && within_reach(target.at(target.start_s + stay), target.start_s + stay))
    stay += kReachStepS;
  return target.start_s + std::max(std::min(stay, stay_s), kShortestStayS);
}

}  // namespace herr
