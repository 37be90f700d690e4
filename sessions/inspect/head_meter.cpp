#include "sessions/inspect/head_meter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "sessions/streams/pose_sampler.h"

namespace herr {
namespace {

// Boxers turn their heads at 1000 degrees a second and sprinters run at 12 m/s.
constexpr double kJumpDegPerS = 2000, kJumpMPerS = 20;
// Four decimals in a file change the norm by less.
constexpr double kNormRounding = 2e-4;

double angle_deg(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat turn = glm::conjugate(a) * b;
  return glm::degrees(2 * std::atan2(std::hypot(turn.x, turn.y, turn.z), std::abs(turn.w)));
}

}  // namespace

void HeadMeter::add(const PoseRow& row, double norm, std::int64_t line) {
  const glm::dvec3& position = row.world_from_head.position;
  if (!window_start_) {
    window_start_ = row;
    lower_m_ = upper_m_ = position;
  }
  median_.add(row.world_from_head, row.stamp_ns);
  lower_m_ = glm::min(lower_m_, position);
  upper_m_ = glm::max(upper_m_, position);
  if (std::abs(norm - 1) > worst_norm_error_) {
    worst_norm_error_ = std::abs(norm - 1);
    worst_norm_line_ = line;
  }
  const TimeNs step_ns = row.stamp_ns - window_start_->stamp_ns;
  if (step_ns < kWindowNs) return;
  if (step_ns <= kMaxPoseGapNs) measure(*window_start_, row, line);
  window_start_ = row;
}

void HeadMeter::measure(const PoseRow& from, const PoseRow& to, std::int64_t line) {
  const double seconds = static_cast<double>(to.stamp_ns - from.stamp_ns) * kSecondsPerNs;
  const double turn_deg = angle_deg(from.world_from_head.orientation, to.world_from_head.orientation);
  const double way_m = glm::distance(from.world_from_head.position, to.world_from_head.position);
  const double deg_s = turn_deg / seconds, m_s = way_m / seconds;
  turned_deg_ += turn_deg;
  path_m_ += way_m;
  turn_deg_s_.add(deg_s);
  move_m_s_.add(m_s);
  turn_profile_.add(to.stamp_ns, deg_s);
  move_profile_.add(to.stamp_ns, m_s);

  const double jump = std::max(deg_s / kJumpDegPerS, m_s / kJumpMPerS);
  if (jump <= 1) return;
  ++jumps_;
  last_jump_line_ = line;
  if (jump <= worst_jump_) return;
  worst_jump_ = jump;
  worst_jump_line_ = line;
  worst_jump_deg_s_ = deg_s;
  worst_jump_m_s_ = m_s;
}

void HeadMeter::judge(const std::filesystem::path& file, FindingList& findings) const {
  if (jumps_ > 0)
    findings.add(
        {Severity::warning,
         InputError(file, worst_jump_line_,
                    "the head jumps here, at " + std::to_string(std::llround(worst_jump_deg_s_)) +
                        " degrees and " + std::to_string(std::llround(worst_jump_m_s_)) + " m a second",
                    "tracking was lost or reset: cut the recording there"),
         false, jumps_, last_jump_line_});
  if (worst_norm_error_ > kNormRounding)
    findings.add(Severity::note, InputError(file, worst_norm_line_,
                                            "the norm of the quaternion is off by " +
                                                std::to_string(std::llround(worst_norm_error_ * 1e6)) + "e-6",
                                            "it is normalised; write more digits"));
}

}  // namespace herr
