#include "sessions/inspect/meters/gaze_jumps.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace herr {
namespace {

constexpr double kFastRadS = 1.745;  // 100 degrees a second
constexpr double kStopped = 0.4;
constexpr TimeNs kLeastIntervalNs = 6'000'000, kMostIntervalNs = 25'000'000;
constexpr std::int64_t kFewestFast = 60;
constexpr double kDulledShare = 0.06;

}  // namespace

void GazeJumps::add(const glm::dvec3& velocity, TimeNs interval_ns) {
  const double speed = glm::length(velocity);
  if (interval_ns < kLeastIntervalNs || interval_ns > kMostIntervalNs) {
    last_speed_.reset();
    return;
  }
  if (speed == 0) return;
  if (last_speed_ && *last_speed_ >= kFastRadS) {
    ++fast_;
    stops_ += speed < kStopped * *last_speed_ ? 1 : 0;
  }
  last_speed_ = speed;
}

std::optional<double> GazeJumps::stop_share() const {
  if (fast_ < kFewestFast) return std::nullopt;
  return static_cast<double>(stops_) / static_cast<double>(fast_);
}

bool GazeJumps::dulled() const {
  const auto stops = static_cast<double>(stops_);
  return fast_ >= kFewestFast && stops + 2 * std::sqrt(stops + 1) < kDulledShare * static_cast<double>(fast_);
}

}  // namespace herr
