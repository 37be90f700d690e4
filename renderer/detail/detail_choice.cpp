#include "renderer/detail/detail_choice.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "renderer/foveation/polar_map.h"

namespace herr {
namespace {

// The coarsest level whose error is at most `allowed_m`.
int coarsest_within(std::span<const float> errors_m, double allowed_m) {
  int level = 0;
  for (std::size_t i = 0; i < errors_m.size(); ++i) {
    if (double{errors_m[i]} <= allowed_m) level = static_cast<int>(i) + 1;
  }
  return level;
}

}  // namespace

double samples_per_metre(const DetailEye& eye, const DetailBall& ball) {
  const glm::dvec3 away = ball.centre - eye.position;
  const double distance_m = glm::length(away);
  const double nearest_m = distance_m - ball.radius_m;
  if (!(nearest_m > 0)) return std::numeric_limits<double>::infinity();
  double density = eye.samples_per_deg;
  if (eye.foveated) {
    const double to_centre = std::atan2(glm::length(glm::cross(away, eye.gaze)), glm::dot(away, eye.gaze));
    const double half_angle = std::asin(std::min(ball.radius_m / distance_m, 1.0));
    density /= 1.0 + std::max(to_centre - half_angle, 0.0) * kDegreesPerRadian;
  }
  density = std::min(density, eye.most_samples_per_deg);
  return density * kDegreesPerRadian / nearest_m;
}

int detail_level(std::span<const float> errors_m, std::span<const DetailEye> eyes, const DetailBall& ball,
                 int former, double most_samples) {
  if (!(most_samples > 0)) return 0;  // even a form that lies nowhere off has other normals
  double finest = 0;
  for (const DetailEye& eye : eyes) finest = std::max(finest, samples_per_metre(eye, ball));
  const double samples_per_object_metre = finest * ball.scale;
  // Nothing looks at it, or it has no extent: any form will do.
  if (!(samples_per_object_metre > 0)) return static_cast<int>(errors_m.size());
  const double allowed_m = most_samples / samples_per_object_metre;
  const int finest_needed = coarsest_within(errors_m, allowed_m);
  if (former < 0 || former > finest_needed) return finest_needed;
  return std::max(former, coarsest_within(errors_m, kCoarserShare * allowed_m));
}

}  // namespace herr
