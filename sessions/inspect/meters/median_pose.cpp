#include "sessions/inspect/meters/median_pose.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace herr {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

glm::dvec3 median_of(const std::vector<glm::dvec3>& vectors) {
  glm::dvec3 result(0.0);
  if (vectors.empty()) return result;
  std::vector<double> values(vectors.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(vectors.begin(), vectors.end(), values.begin(),
                   [axis](const glm::dvec3& v) { return v[axis]; });
    result[axis] = median(values);
  }
  return result;
}

void keep_every_other(std::vector<glm::dvec3>& vectors) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < vectors.size(); i += 2) vectors[kept++] = vectors[i];
  vectors.resize(kept);
}

}  // namespace

void MedianPose::add(const Pose& world_from_head) {
  if (rows_++ % stride_ != 0) return;
  places_.push_back(world_from_head.position);
  forwards_.push_back(world_from_head.orientation * glm::dvec3(0, 0, -1));
  if (places_.size() <= kMostKept) return;
  keep_every_other(places_);
  keep_every_other(forwards_);
  stride_ *= 2;
}

glm::dvec3 MedianPose::place_m() const {
  return median_of(places_);
}

glm::dvec3 MedianPose::forward() const {
  const glm::dvec3 middle = median_of(forwards_);
  const double length = glm::length(middle);
  return length > 0 ? middle / length : glm::dvec3(0.0);
}

}  // namespace herr
