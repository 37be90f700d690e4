#include "sessions/import/map/axis_directions.h"

#include <cmath>
#include <cstddef>
#include <glm/matrix.hpp>
#include <utility>

namespace herr {
namespace {

const std::pair<const char*, glm::dvec3> kDirections[] = {{"right", {1, 0, 0}}, {"left", {-1, 0, 0}},
                                                          {"up", {0, 1, 0}},    {"down", {0, -1, 0}},
                                                          {"back", {0, 0, 1}},  {"forward", {0, 0, -1}}};

std::optional<glm::dvec3> direction_of(const std::string& word) {
  for (const auto& [name, direction] : kDirections)
    if (word == name) return direction;
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

std::array<std::string, 3> AxisDirections::words() const {
  std::array<std::string, 3> words;
  for (int i = 0; i < 3; ++i)
    for (const auto& [name, direction] : kDirections)
      if (ours_from_theirs_[i] == direction) words[static_cast<std::size_t>(i)] = name;
  return words;
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
