#include "sessions/inspect/plausibility_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace herr {
namespace {

constexpr double kMost = 0.5;
// A steady axis strays from its mean by less than this, and by less than half of what the others do.
constexpr double kSteadyDeg = 35, kSteadier = 0.5;
constexpr double kPointsThere = 0.8;  // cosine: within 37 degrees

struct NamedAxis {
  const char* positive;
  const char* negative;
};
constexpr std::array<NamedAxis, 3> kWorldAxes{
    {{"right (+x)", "left (-x)"}, {"up (+y)", "down (-y)"}, {"back (+z)", "forward (-z)"}}};
constexpr std::array<NamedAxis, 3> kHeadAxes{{{"right", "left"}, {"up", "down"}, {"forward", "back"}}};

// The world's axis that `mean` points along, or null.
const char* axis_along(const glm::dvec3& mean) {
  for (glm::length_t i = 0; i < 3; ++i) {
    const NamedAxis& axis = kWorldAxes[static_cast<std::size_t>(i)];
    if (mean[i] > kPointsThere) return axis.positive;
    if (mean[i] < -kPointsThere) return axis.negative;
  }
  return nullptr;
}

// The head's axis that points up in the world most of the time, or null.
const char* axis_that_is_up(const AttitudeMeter& head) {
  for (const auto axis : {AttitudeMeter::right_axis, AttitudeMeter::up_axis, AttitudeMeter::forward_axis}) {
    const double up = head.mean_of(axis).y;
    if (up > kPointsThere) return kHeadAxes[axis].positive;
    if (up < -kPointsThere) return kHeadAxes[axis].negative;
  }
  return nullptr;
}

}  // namespace

std::string whole(double value) {
  return std::to_string(std::lround(value));
}

std::string percents(double share) {
  return whole(100 * share) + " %";
}

std::string where_it_looks(const AttitudeMeter& head) {
  if (head.looks_up_share() >= kMost)
    return "straight up in " + percents(head.looks_up_share()) + " of the rows";
  if (head.looks_down_share() >= kMost)
    return "straight down in " + percents(head.looks_down_share()) + " of the rows";
  const double pitch = head.median_pitch_deg();
  if (std::abs(pitch) < 5) return "level (pitch " + whole(pitch) + " degrees in the median)";
  return whole(std::abs(pitch)) + " degrees " + (pitch > 0 ? "up" : "down") + " (in the median)";
}

std::string which_way_is_up(const AttitudeMeter& head) {
  if (head.upside_share() >= kMost) return "upside down in " + percents(head.upside_share()) + " of the rows";
  if (head.side_share() >= kMost) return "on its side in " + percents(head.side_share()) + " of the rows";
  return "upright in " + percents(head.level_share()) + " of the rows";
}

std::string likely_wrong_axis(const AttitudeMeter& head) {
  const double up = head.spread_deg(AttitudeMeter::up_axis),
               right = head.spread_deg(AttitudeMeter::right_axis),
               forward = head.spread_deg(AttitudeMeter::forward_axis);
  const char* up_axis = axis_along(head.mean_of(AttitudeMeter::up_axis));
  const char* true_up = axis_that_is_up(head);
  if (up < kSteadyDeg && up < kSteadier * std::min(right, forward) && up_axis)
    return std::string("its up is steady, but along the world's ") + up_axis + ": world axes?";
  if (head.upside_share() >= kMost) return "its down is what points up: head or world axes?";
  if (true_up && up > right && up > forward)
    return std::string("the head's ") + true_up + " is what points up: head axes?";
  if (true_up) return std::string("the head's ") + true_up + " is what points up: head or world axes?";
  return "head or world axes?";
}

}  // namespace herr
