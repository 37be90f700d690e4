#include "sessions/import/check/walking_meter.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace herr {
namespace {

constexpr TimeNs kWindowNs = 200'000'000;
// Slower is swaying on the spot; faster is no person.
constexpr double kSlowestMPerS = 0.3, kFastestMPerS = 5;

}  // namespace

void WalkingMeter::add(const PoseRow& row) {
  if (!from_) from_ = row;
  const TimeNs step_ns = row.stamp_ns - from_->stamp_ns;
  if (step_ns < kWindowNs) return;
  const glm::dvec3 way = row.world_from_head.position - from_->world_from_head.position;
  const glm::dvec3 forward = from_->world_from_head.orientation * glm::dvec3(0, 0, -1);
  from_ = row;
  const double length_m = std::hypot(way.x, way.z);
  const double speed_m_s = length_m / (static_cast<double>(step_ns) * kSecondsPerNs);
  const double across = std::hypot(forward.x, forward.z);
  if (step_ns > 2 * kWindowNs || speed_m_s < kSlowestMPerS || speed_m_s > kFastestMPerS || across < 0.1)
    return;
  way_m_ += length_m;
  ahead_m_ += (way.x * forward.x + way.z * forward.z) / across;
}

std::optional<double> WalkingMeter::ahead() const {
  if (way_m_ < kShortestWayM) return std::nullopt;
  return ahead_m_ / way_m_;
}

}  // namespace herr
