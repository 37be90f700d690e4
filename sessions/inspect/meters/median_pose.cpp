#include "sessions/inspect/meters/median_pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace herr {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <typename Vector>
glm::dvec3 median_of(const std::vector<Pose>& poses, const Vector& vector) {
  glm::dvec3 result(0.0);
  if (poses.empty()) return result;
  std::vector<double> values(poses.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(poses.begin(), poses.end(), values.begin(),
                   [&](const Pose& pose) { return vector(pose)[axis]; });
    result[axis] = median(values);
  }
  return result;
}

template <typename Value>
void keep_every_other(std::vector<Value>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); i += 2) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace

void MedianPose::add(const Pose& world_from_head, TimeNs stamp_ns) {
  if (rows_++ % stride_ != 0) return;
  kept_.push_back(world_from_head);
  kept_ns_.push_back(stamp_ns);
  if (kept_.size() <= kMostKept) return;
  keep_every_other(kept_);
  keep_every_other(kept_ns_);
  stride_ *= 2;
}

glm::dvec3 MedianPose::place_m() const {
  return median_of(kept_, [](const Pose& pose) { return pose.position; });
}

glm::dvec3 MedianPose::forward() const {
  const glm::dvec3 middle =
      median_of(kept_, [](const Pose& pose) { return pose.orientation * glm::dvec3(0, 0, -1); });
  const double length = glm::length(middle);
  return length > 0 ? middle / length : glm::dvec3(0.0);
}

Pose MedianPose::pose() const {
  const glm::dvec3 ahead = forward();
  if (ahead == glm::dvec3(0.0)) return {place_m(), Pose{}.orientation};
  const double yaw = std::atan2(-ahead.x, -ahead.z), pitch = std::asin(std::clamp(ahead.y, -1.0, 1.0));
  return {place_m(), glm::angleAxis(yaw, glm::dvec3(0, 1, 0)) * glm::angleAxis(pitch, glm::dvec3(1, 0, 0))};
}

}  // namespace herr
