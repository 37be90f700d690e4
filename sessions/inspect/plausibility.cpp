#include "sessions/inspect/plausibility.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "sessions/inspect/plausibility_words.h"

namespace herr {
namespace {

constexpr std::int64_t kFewestWindows = 10;
constexpr double kLeastWayM = 1;
constexpr double kFastMps = 10;  // sprinters; a head that turns at leisure is as fast in millimetres

std::optional<double> share_of(std::int64_t part, std::int64_t all, std::int64_t fewest) {
  if (all < fewest) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(all);
}

// Angular velocity in the head's axes, up to its unit: constant where an orientation was interpolated.
glm::dvec3 turn_per_second(const glm::dquat& from, const glm::dquat& to, double per_second) {
  const glm::dquat turn = glm::conjugate(from) * to;
  return glm::dvec3(turn.x, turn.y, turn.z) * (turn.w < 0 ? -per_second : per_second);
}

}  // namespace

void PlausibilityMeter::add(const PoseRow& row) {
  attitude_.add(row);
  countering_.add(row);
  if (last_pose_ && row.stamp_ns > last_pose_->stamp_ns) {
    const TimeNs interval_ns = row.stamp_ns - last_pose_->stamp_ns;
    const double per_second = 1e9 / static_cast<double>(interval_ns);
    const Pose &from = last_pose_->world_from_head, &to = row.world_from_head;
    const glm::dvec3 velocity = (to.position - from.position) * per_second;
    ++intervals_;
    fast_intervals_ += glm::length(velocity) > kFastMps ? 1 : 0;
    way_.add(velocity, interval_ns);
    turn_.add(turn_per_second(from.orientation, to.orientation, per_second), interval_ns);
  }
  last_pose_ = row;
}

void PlausibilityMeter::add(const GazeRow& row, bool per_eye) {
  eyes_.add(row, per_eye);
  countering_.add(row);
  const std::size_t eye = row.valid[0] ? 0 : 1;
  if (!row.valid[eye]) {
    last_gaze_.reset();
    return;
  }
  if (last_gaze_ && last_gaze_->valid[eye] && row.stamp_ns > last_gaze_->stamp_ns) {
    const TimeNs interval_ns = row.stamp_ns - last_gaze_->stamp_ns;
    const double per_second = 1e9 / static_cast<double>(interval_ns);
    const glm::dvec3 velocity = (row.head_direction[eye] - last_gaze_->head_direction[eye]) * per_second;
    gaze_turn_.add(velocity, interval_ns);
    jumps_.add(velocity, interval_ns);
  }
  last_gaze_ = row;
}

PlausibilityFigures PlausibilityMeter::figures() const {
  PlausibilityFigures figures;
  figures.pose_rows = attitude_.rows();
  figures.gaze_rows = eyes_.rows();
  if (attitude_.rows() >= kFewestRows) figures.level_share = attitude_.level_share();
  figures.median_tilt_deg = attitude_.tilt_deg().quantile(0.5);
  figures.median_roll_deg = attitude_.roll_deg().quantile(0.5);
  figures.median_pitch_deg = attitude_.median_pitch_deg();
  figures.up_spread_deg = attitude_.spread_deg(AttitudeMeter::up_axis);
  figures.right_spread_deg = attitude_.spread_deg(AttitudeMeter::right_axis);
  figures.forward_spread_deg = attitude_.spread_deg(AttitudeMeter::forward_axis);
  figures.mean_up = attitude_.mean_of(AttitudeMeter::up_axis);
  figures.mean_right = attitude_.mean_of(AttitudeMeter::right_axis);
  figures.mean_forward = attitude_.mean_of(AttitudeMeter::forward_axis);
  figures.head_turns = attitude_.turns();
  figures.head_moves = attitude_.moves();
  figures.fast_share = share_of(fast_intervals_, intervals_, kFewestRows);
  const double way_m = attitude_.way_forwards_m() + attitude_.way_backwards_m();
  if (way_m >= kLeastWayM) figures.forwards_share = attitude_.way_forwards_m() / way_m;

  figures.diverging_share = share_of(eyes_.diverging_rows(), eyes_.judged_rows(), kFewestRows);
  figures.same_ray_share = share_of(eyes_.same_ray_rows(), eyes_.paired_rows(), kFewestRows);
  figures.off_axis_share = share_of(eyes_.off_axis_rows(), eyes_.rows_with_gaze(), kFewestRows);
  figures.median_gaze_deg = eyes_.off_axis_deg().quantile(0.5);
  const GazeCountering::Axis &x = countering_.horizontal(), &y = countering_.vertical();
  figures.countering_x = share_of(x.against, x.telling(), kFewestWindows);
  figures.countering_y = share_of(y.against, y.telling(), kFewestWindows);
  figures.countering_windows = x.telling() + y.telling();
  figures.evidence_x = x.evidence();
  figures.evidence_y = y.evidence();
  figures.stop_share = jumps_.stop_share();
  figures.evidence_not_exchanged = countering_.evidence_not_exchanged();
  return figures;
}

std::string PlausibilityMeter::words() const {
  if (attitude_.rows() == 0) return "";
  const std::string degrees = " (" + whole(attitude_.tilt_deg().quantile(0.5)) + " degrees of tilt and " +
                              whole(attitude_.roll_deg().quantile(0.5)) + " of roll in the median)";
  return "the head looks " + where_it_looks(attitude_) + "; it is " + which_way_is_up(attitude_) + degrees;
}

std::string PlausibilityMeter::gaze_words() const {
  if (eyes_.rows_with_gaze() == 0 || still_gaze_meant_) return "";
  const PlausibilityFigures known = figures();
  std::string text;
  const auto say = [&](const std::optional<double>& share, std::int64_t windows, const char* way) {
    if (!share) return;
    text += (text.empty() ? "while the head turns, the eyes turn against it in " : ", ") + percents(*share) +
            " of " + std::to_string(windows) + " windows " + way;
  };
  say(known.countering_x, countering_.horizontal().telling(), "sideways");
  say(known.countering_y, countering_.vertical().telling(), "up and down");
  if (text.empty()) text = "too few turns of head and eyes to tell whether these counter those";
  return text;
}

}  // namespace herr
