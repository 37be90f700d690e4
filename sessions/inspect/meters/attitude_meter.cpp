#include "sessions/inspect/meters/attitude_meter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace herr {
namespace {

// Slower than this people sway, step back and turn on the spot; a step is taken over a tenth of a second.
constexpr double kWalkingMPerS = 0.5;
// Angles are taken this far apart: fast logs would count the same head over and over.
constexpr TimeNs kAngleSpacingNs = 4'000'000;
constexpr TimeNs kStepNs = 100'000'000, kLongestStepNs = 500'000'000;
const double kSinLevel = std::sin(glm::radians(AttitudeMeter::kLevelDeg));
const double kCosLevel = std::cos(glm::radians(AttitudeMeter::kLevelDeg));
const double kAlongWay = std::cos(glm::radians(45.0));

bool the_same(const glm::dquat& a, const glm::dquat& b) {
  return a == b || a == -b;
}

double arc_deg(double (*arc)(double), double value) {
  return glm::degrees(arc(std::clamp(value, -1.0, 1.0)));
}

}  // namespace

void AttitudeMeter::add(const PoseRow& row) {
  const Pose& pose = row.world_from_head;
  if (rows_++ == 0) {
    first_ = pose;
    step_start_ = row;
  }
  if (!turns_) turns_ = !the_same(pose.orientation, first_.orientation);
  if (!moves_) moves_ = pose.position != first_.position;
  const glm::dquat& q = pose.orientation;
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z,
               wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  const glm::dvec3 right_now{1 - 2 * (yy + zz), 2 * (xy + wz), 2 * (xz - wy)};
  const glm::dvec3 up_now{2 * (xy - wz), 1 - 2 * (xx + zz), 2 * (yz + wx)};
  const glm::dvec3 forward_now{-2 * (xz + wy), -2 * (yz - wx), -1 + 2 * (xx + yy)};
  sums_[right_axis] += right_now;
  sums_[up_axis] += up_now;
  sums_[forward_axis] += forward_now;
  count_stance(up_now, forward_now);
  if (rows_ == 1 || row.stamp_ns - measured_ns_ >= kAngleSpacingNs) {
    measured_ns_ = row.stamp_ns;
    measure(up_now, forward_now, right_now.y);
  }
  walk(row, forward_now);
}

void AttitudeMeter::count_stance(const glm::dvec3& up, const glm::dvec3& forward) {
  ++(up.y > kCosLevel         ? level_
     : forward.y > kSinLevel  ? looks_up_
     : forward.y < -kSinLevel ? looks_down_
     : up.y < -kCosLevel      ? upside_
                              : side_);
}

void AttitudeMeter::measure(const glm::dvec3& up, const glm::dvec3& forward, double right_up) {
  tilt_deg_.add(arc_deg(std::acos, up.y));
  pitch_above_down_deg_.add(90 + arc_deg(std::asin, forward.y));
  if (std::abs(forward.y) <= kSinLevel) roll_deg_.add(glm::degrees(std::atan2(std::abs(right_up), up.y)));
}

void AttitudeMeter::walk(const PoseRow& row, const glm::dvec3& forward) {
  const TimeNs step_ns = row.stamp_ns - step_start_->stamp_ns;
  if (step_ns < kStepNs) return;
  const glm::dvec3 way = row.world_from_head.position - step_start_->world_from_head.position;
  const double way_m = std::hypot(way.x, way.z), ahead = std::hypot(forward.x, forward.z);
  if (step_ns <= kLongestStepNs && way_m > kWalkingMPerS * static_cast<double>(step_ns) * kSecondsPerNs) {
    const double along = (way.x * forward.x + way.z * forward.z) / (way_m * std::max(ahead, 1e-9));
    if (along > kAlongWay) way_forwards_m_ += way_m;
    if (along < -kAlongWay) way_backwards_m_ += way_m;
  }
  step_start_ = row;
}

double AttitudeMeter::share(std::int64_t rows) const {
  return rows_ > 0 ? static_cast<double>(rows) / static_cast<double>(rows_) : 0;
}

double AttitudeMeter::median_pitch_deg() const {
  return rows_ > 0 ? pitch_above_down_deg_.quantile(0.5) - 90 : 0;
}

glm::dvec3 AttitudeMeter::mean_of(Axis axis) const {
  return rows_ > 0 ? sums_[axis] / static_cast<double>(rows_) : glm::dvec3(0.0);
}

double AttitudeMeter::spread_deg(Axis axis) const {
  // The mean square of |axis - mean direction| is 2 - 2 |mean|.
  const double length = std::min(1.0, glm::length(mean_of(axis)));
  return rows_ > 0 ? glm::degrees(std::sqrt(2 * (1 - length))) : 0;
}

}  // namespace herr
