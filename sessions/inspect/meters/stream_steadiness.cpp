#include "sessions/inspect/meters/stream_steadiness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace herr {
namespace {

constexpr double kStraight = 1e-3;
constexpr double kStraightShare = 0.4, kAlikeShare = 0.8;
constexpr std::int64_t kFewestRuns = 12;
constexpr TimeNs kLongestIntervalNs = 200'000'000;

}  // namespace

void StreamSteadiness::add(const glm::dvec3& velocity, TimeNs interval_ns) {
  const double size = glm::dot(velocity, velocity);
  if (size == 0) return;
  if (!last_ || interval_ns > kLongestIntervalNs) {
    last_ = velocity;
    inside_ = false;
    return;
  }
  const glm::dvec3 change = velocity - *last_;
  const double change_squared = glm::dot(change, change);
  last_ = velocity;
  span_ns_ += interval_ns;
  if (change_squared < kStraight * kStraight * size) {
    ++straight_;
    ++run_;
    return;
  }
  ++bends_;
  if (inside_) {
    ++runs_of_[std::min<std::size_t>(static_cast<std::size_t>(run_), kLongest - 1)];
    ++runs_;
  }
  inside_ = true;
  run_ = 0;
}

std::optional<double> StreamSteadiness::knots_hz() const {
  if (runs_ < kFewestRuns) return std::nullopt;
  std::int64_t alike = 0;
  for (std::size_t i = 1; i + 1 < kLongest; ++i)
    alike = std::max<std::int64_t>(alike, runs_of_[i] + runs_of_[i + 1]);
  const auto all = static_cast<double>(straight_ + bends_);
  if (static_cast<double>(alike) < kAlikeShare * static_cast<double>(runs_) ||
      static_cast<double>(straight_) < kStraightShare * all)
    return std::nullopt;
  return static_cast<double>(bends_) / (static_cast<double>(span_ns_) * kSecondsPerNs);
}

}  // namespace herr
