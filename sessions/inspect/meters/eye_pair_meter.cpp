#include "sessions/inspect/meters/eye_pair_meter.h"

#include <cmath>
#include <glm/trigonometric.hpp>

namespace herr {
namespace {

// Angles are taken this far apart: fast logs would count the same gaze over and over.
constexpr TimeNs kGazeSpacingNs = 4'000'000;
const double kTrustedCos = std::cos(glm::radians(EyePairMeter::kTrustedDeg));
const double kDivergingSin = std::sin(glm::radians(EyePairMeter::kDivergingDeg));

// Lost eyes have no direction; an eye that looks too far off the axis has one, though it is not valid.
bool has_direction(const glm::dvec3& d) {
  return d.x != 0 || d.y != 0 || d.z != 0;
}

}  // namespace

void EyePairMeter::add(const GazeRow& row, bool per_eye) {
  ++rows_;
  const auto& [left, right] = row.head_direction;
  const bool sees_left = has_direction(left), sees_right = has_direction(right);
  if (!sees_left && !sees_right) return;
  const std::size_t one = sees_left ? 0 : 1, other = sees_right ? 1 : 0;
  const glm::dvec3 mean = row.head_direction[one] + row.head_direction[other];
  ++rows_with_gaze_;
  for (std::size_t eye = 0; eye < 2; ++eye)
    if (!has_direction(first_[eye])) first_[eye] = row.head_direction[eye];
  if (!changes_) changes_ = (sees_left && first_[0] != left) || (sees_right && first_[1] != right);
  if (!row.valid[0] && !row.valid[1]) ++off_axis_rows_;
  if (rows_with_gaze_ == 1 || row.stamp_ns - measured_ns_ >= kGazeSpacingNs) {
    measured_ns_ = row.stamp_ns;
    off_axis_deg_.add(glm::degrees(std::atan2(std::sqrt(mean.x * mean.x + mean.y * mean.y), -mean.z)));
  }
  if (per_eye && sees_left && sees_right) compare(left, right);
}

void EyePairMeter::compare(const glm::dvec3& left, const glm::dvec3& right) {
  ++paired_rows_;
  if (left == right) {
    ++same_ray_rows_;
    return;
  }
  if (-left.z < kTrustedCos || -right.z < kTrustedCos) return;
  ++judged_rows_;
  // Sine of the angle from the left eye's ray to the right eye's, clockwise from above, in the horizontal
  // plane.
  const double across = right.x * left.z - left.x * right.z;
  const double lengths = (left.x * left.x + left.z * left.z) * (right.x * right.x + right.z * right.z);
  if (-across > kDivergingSin * std::sqrt(lengths)) ++diverging_rows_;
}

}  // namespace herr
