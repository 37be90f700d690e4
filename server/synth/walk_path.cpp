#include "server/synth/walk_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <numbers>

#include "server/synth/minimum_jerk.h"
#include "server/synth/seeded_random.h"

namespace herr {
namespace {

constexpr std::uint64_t kPathStream = 32;
constexpr std::size_t kPoints = 64;
// A comfortable walk: 1.8 steps of 0.67 m a second (A. Pachi and T. Ji, Frequency and velocity of people
// walking, The Structural Engineer 83, 2005: 1.3 m/s on floors; slower in a room).
constexpr double kWalkingSpeed = 1.2;
constexpr double kRampS = 0.8;  // one or two steps to start and to stop
constexpr double kTurnPeakDegS = 120.0, kShortestWalkTurnS = 0.5;

// Of the way that a ramp of length 1 and final speed 1 covers, up to the share x of its time; 1/2 at its end.
// Its derivative is smoothstep.
double ramp_way(double x) {
  return x * x * x * (1.0 - 0.5 * x);
}

double smoothstep(double x) {
  return x * x * (3.0 - 2.0 * x);
}

std::vector<glm::dvec3> tour(std::uint64_t seed, const WalkArea& area) {
  SeededRandom random(seed, kPathStream);
  // Points that are too near to the one before are drawn again, so that legs have some steps.
  const double shortest_m = 0.4 * std::max(area.half_extent.x, area.half_extent.y);
  std::vector<glm::dvec3> points{area.centre};
  while (points.size() < kPoints) {
    const double x = random.uniform(-area.half_extent.x, area.half_extent.x);
    const double z = random.uniform(-area.half_extent.y, area.half_extent.y);
    const glm::dvec3 point = area.centre + glm::dvec3{x, 0, z};
    const bool last = points.size() + 1 == kPoints;
    if (glm::distance(point, points.back()) < shortest_m) continue;
    if (last && glm::distance(point, points.front()) < shortest_m) continue;
    points.push_back(point);
  }
  return points;
}

double heading_of(const glm::dvec3& direction) {
  return std::atan2(-direction.x, -direction.z);
}

// The shorter way round.
double turn_between(double from_rad, double to_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

}  // namespace

WalkPath::WalkPath(std::uint64_t seed, const WalkArea& area) {
  const std::vector<glm::dvec3> points = tour(seed, area);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 way = points[(i + 1) % points.size()] - points[i];
    const glm::dvec3 next_way = points[(i + 2) % points.size()] - points[(i + 1) % points.size()];
    Leg leg;
    leg.start_s = tour_s_;
    leg.from = points[i];
    leg.length_m = glm::length(way);
    leg.direction = way / leg.length_m;
    leg.speed_m_s = std::min(kWalkingSpeed, leg.length_m / kRampS);  // short legs stay slow
    leg.walk_s = leg.length_m / leg.speed_m_s + kRampS;
    leg.heading_rad = heading_of(way);
    leg.turn_rad = turn_between(leg.heading_rad, heading_of(next_way));
    leg.turn_s =
        std::max(kShortestWalkTurnS, kMinimumJerkPeak * std::abs(glm::degrees(leg.turn_rad)) / kTurnPeakDegS);
    tour_s_ += leg.walk_s + leg.turn_s;
    legs_.push_back(leg);
  }
}

WalkPath::State WalkPath::at(double time_s) const {
  const double tour_time_s = std::fmod(time_s, tour_s_);
  const auto next = std::upper_bound(legs_.begin(), legs_.end(), tour_time_s,
                                     [](double time, const Leg& leg) { return time < leg.start_s; });
  const Leg& leg = *std::prev(next);
  const double t = tour_time_s - leg.start_s;
  const double from_start = std::min(t, kRampS) / kRampS;
  const double to_end = std::clamp(leg.walk_s - t, 0.0, kRampS) / kRampS;
  double way_m = leg.speed_m_s * (t - 0.5 * kRampS);  // at full speed
  if (from_start < 1.0) way_m = leg.speed_m_s * kRampS * ramp_way(from_start);
  if (to_end < 1.0) way_m = leg.length_m - leg.speed_m_s * kRampS * ramp_way(to_end);
  State state;
  state.position = leg.from + way_m * leg.direction;
  state.speed_m_s = leg.speed_m_s * smoothstep(from_start) * smoothstep(to_end);
  state.heading_rad = leg.heading_rad + leg.turn_rad * minimum_jerk((t - leg.walk_s) / leg.turn_s);
  return state;
}

}  // namespace herr
