#include "scenes/samples/generator/shapes/blobs.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace herr::samples {

float tapered_capsule(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, float radius_a,
                      float radius_b) {
  const glm::vec3 axis = b - a;
  const float along = glm::clamp(glm::dot(p - a, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
  return glm::distance(p, a + along * axis) - glm::mix(radius_a, radius_b, along);
}

float ellipsoid(const glm::vec3& p, const glm::vec3& centre, const glm::vec3& semi_axes) {
  const glm::vec3 q = p - centre;
  const float scaled = glm::length(q / semi_axes);
  const float gradient = glm::length(q / (semi_axes * semi_axes));
  // At the centre the gradient vanishes; the distance there is the shortest semi-axis.
  if (gradient < 1e-6f) return -std::min({semi_axes.x, semi_axes.y, semi_axes.z});
  return scaled * (scaled - 1.0f) / gradient;
}

float smooth_union(float a, float b, float fillet) {
  const float overlap = std::max(fillet - std::abs(a - b), 0.0f) / fillet;
  return std::min(a, b) - 0.25f * fillet * overlap * overlap;
}

float smooth_difference(float a, float b, float fillet) {
  return -smooth_union(-a, b, fillet);
}

}  // namespace herr::samples
