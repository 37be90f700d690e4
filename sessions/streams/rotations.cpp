#include "sessions/streams/rotations.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace herr {

glm::dquat turn_from_to(const glm::dquat& a, const glm::dquat& b, double share) {
  glm::dquat turn =
      b * glm::conjugate(a);  // a and -a are the same orientation: take the turn of at most 180 degrees
  if (turn.w < 0) turn = -turn;
  const glm::dvec3 axis(turn.x, turn.y, turn.z);
  const double sine = glm::length(axis);
  if (sine == 0) return b;
  const double half_angle = share * std::atan2(sine, turn.w);
  const glm::dvec3 part = axis * (std::sin(half_angle) / sine);
  return glm::normalize(glm::dquat(std::cos(half_angle), part.x, part.y, part.z) * a);
}

glm::dvec3 turn_from_to(const glm::dvec3& a, const glm::dvec3& b, double share) {
  const glm::dvec3 normal = glm::cross(a, b);
  const double sine = glm::length(normal), cosine = glm::dot(a, b);
  if (sine == 0 && cosine > 0) return b;
  glm::dvec3 side(0);  // unit, at right angles to a, in the plane of the turn
  if (sine > 0) {
    side = glm::normalize(glm::cross(normal, a));
  } else {
    side = glm::normalize(glm::cross(a, std::abs(a.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  }
  const double angle = share * std::atan2(sine, cosine);
  return glm::normalize(a * std::cos(angle) + side * std::sin(angle));
}

}  // namespace herr
