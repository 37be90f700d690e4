// How the head moves: speeds over short windows, the way that it went, jumps. Constant memory.
// Before: pose rows in order. After: findings, the plot of head speed.
#pragma once

#include <cstdint>
#include <optional>

#include "sessions/inspect/findings.h"
#include "sessions/inspect/meters/linear_histogram.h"
#include "sessions/inspect/meters/median_pose.h"
#include "sessions/inspect/time_profile.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

class HeadMeter {
 public:
  // `norm`: length of the quaternion as it was written.
  void add(const PoseRow& row, double norm, std::int64_t line);
  void judge(const std::filesystem::path& file, FindingList& findings) const;

  // Speeds are taken over kWindowNs or the rows' own interval if that is longer, but not across gaps of more
  // than a second.
  static constexpr TimeNs kWindowNs = 20'000'000;
  const LinearHistogram& turn_deg_s() const { return turn_deg_s_; }
  const LinearHistogram& move_m_s() const { return move_m_s_; }
  const TimeProfile& turn_profile() const { return turn_profile_; }
  const TimeProfile& move_profile() const { return move_profile_; }
  double path_m() const { return path_m_; }
  double turned_deg() const { return turned_deg_; }
  const glm::dvec3& lower_m() const { return lower_m_; }  // box of all positions
  const glm::dvec3& upper_m() const { return upper_m_; }
  const MedianPose& median() const { return median_; }
  double worst_norm_error() const { return worst_norm_error_; }

 private:
  void measure(const PoseRow& from, const PoseRow& to, std::int64_t line);

  std::optional<PoseRow> window_start_;
  MedianPose median_;
  LinearHistogram turn_deg_s_{1, 3000}, move_m_s_{0.01, 3000};
  TimeProfile turn_profile_, move_profile_;
  double path_m_ = 0, turned_deg_ = 0, worst_norm_error_ = 0;
  std::int64_t worst_norm_line_ = 0;
  glm::dvec3 lower_m_{0.0}, upper_m_{0.0};
  std::int64_t jumps_ = 0, last_jump_line_ = 0, worst_jump_line_ = 0;
  double worst_jump_ = 0, worst_jump_deg_s_ = 0, worst_jump_m_s_ = 0;
};

}  // namespace herr
