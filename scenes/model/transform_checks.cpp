#include "scenes/model/transform_checks.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace herr {

double determinant(const glm::dmat4x3& transform) {
  return glm::determinant(glm::dmat3(transform[0], transform[1], transform[2]));
}

std::optional<std::string> transform_problem(const glm::dmat4x3& transform) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      const double value = transform[column][row];
      if (!std::isfinite(value)) return "holds a number that is not finite";
      if (std::abs(value) > kFarthest_m) return "holds a number beyond 1e12";
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (glm::length(transform[axis]) < kMinAxisScale) {
      return std::string("has a scale of 0 on the ") + "xyz"[axis] + " axis";
    }
  }
  const double volume = std::abs(determinant(transform));
  const double box = glm::length(transform[0]) * glm::length(transform[1]) * glm::length(transform[2]);
  if (volume < kMinVolumeShare * box) {
    return "shears its axes into a plane (volume below 1e-6 of the axes' box)";
  }
  // A rotated scale of exactly 1e-12 may round to just below the limit; a billionth of slack takes it in.
  if (volume < kMinDeterminant * (1 - 1e-9)) {
    return "flattens or shrinks to almost nothing (determinant below 1e-36)";
  }
  return std::nullopt;
}

glm::dmat4x3 compose(const glm::dmat4x3& a_from_b, const glm::dmat4x3& b_from_c) {
  const glm::dmat3 linear(a_from_b[0], a_from_b[1], a_from_b[2]);
  return {linear * b_from_c[0], linear * b_from_c[1], linear * b_from_c[2],
          linear * b_from_c[3] + a_from_b[3]};
}

glm::dmat4x3 in_units(const glm::dmat4x3& a_from_b, double unit) {
  return {a_from_b[0] * unit, a_from_b[1] * unit, a_from_b[2] * unit, a_from_b[3]};
}

}  // namespace herr
