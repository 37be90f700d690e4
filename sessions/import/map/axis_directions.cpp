#include "sessions/import/map/axis_directions.h"

#include <cmath>
#include <cstddef>
#include <glm/matrix.hpp>

namespace herr {
namespace {

std::optional<glm::dvec3> direction_of(const std::string& word) {
  if (word == "right") return glm::dvec3(1, 0, 0);
  if (word == "left") return glm::dvec3(-1, 0, 0);
  if (word == "up") return glm::dvec3(0, 1, 0);
  if (word == "down") return glm::dvec3(0, -1, 0);
  if (word == "back") return glm::dvec3(0, 0, 1);
  if (word == "forward") return glm::dvec3(0, 0, -1);
  return std::nullopt;
}

}  // namespace

std::optional<AxisDirections> AxisDirections::from_words(const std::array<std::string, 3>& words) {
  AxisDirections axes;
  for (int i = 0; i < 3; ++i) {
    const auto direction = direction_of(words[static_cast<std::size_t>(i)]);
    if (!direction) return std::nullopt;
    axes.ours_from_theirs_[i] = *direction;
  }
  axes.sign_ = glm::determinant(axes.ours_from_theirs_);
  if (axes.sign_ == 0) return std::nullopt;  // exact: the columns are unit vectors along axes
  return axes;
}

glm::dquat rotation_to_ours(const glm::dquat& q, const AxisDirections& world, const AxisDirections& body) {
  // W R B' = (W R W') (W B'): the first factor turns by the same angle about the turned axis (the other way
  // where W mirrors), the second is a fixed rotation. So no digit of q is lost.
  const glm::dvec3 axis = world.sign_ * (world.ours_from_theirs_ * glm::dvec3(q.x, q.y, q.z));
  const glm::dquat turned(q.w, axis.x, axis.y, axis.z);
  const glm::dmat3 fixed = world.ours_from_theirs_ * glm::transpose(body.ours_from_theirs_);
  return fixed == glm::dmat3(1.0) ? turned : turned * glm::quat_cast(fixed);
}

glm::dquat euler_rotation(const glm::dvec3& radians_xyz, const std::string& order) {
  glm::dquat rotation(1, 0, 0, 0);
  for (const char letter : order) {
    const int axis = letter - 'x';
    glm::dvec3 v(0);
    v[axis] = std::sin(radians_xyz[axis] / 2);
    rotation = glm::dquat(std::cos(radians_xyz[axis] / 2), v.x, v.y, v.z) * rotation;
  }
  return rotation;
}

}  // namespace herr
