// Which way the axes of a foreign frame point, and vectors and rotations turned from it into ours (x right,
// y up, z back). Left-handed frames need nothing special: they are a mirror image, and two mirrors cancel.
#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace herr {

class AxisDirections {
 public:
  // Ours.
  AxisDirections() = default;
  // Where x, y and z point: right, left, up, down, forward or back. None when a word is unknown or two axes
  // lie on one line.
  static std::optional<AxisDirections> from_words(const std::array<std::string, 3>& words);

  // What from_words was given.
  std::array<std::string, 3> words() const;
  bool operator==(const AxisDirections&) const = default;

  bool left_handed() const { return sign_ < 0; }
  glm::dvec3 to_ours(const glm::dvec3& v) const { return ours_from_theirs_ * v; }

  // `q` turns vectors of a body with axes `body` into a world with axes `world`; the result does the same in
  // our axes. Both must have the same handedness.
  friend glm::dquat rotation_to_ours(const glm::dquat& q, const AxisDirections& world,
                                     const AxisDirections& body);

 private:
  glm::dmat3 ours_from_theirs_{1.0};
  double sign_ = 1;  // determinant
};

glm::dquat rotation_to_ours(const glm::dquat& q, const AxisDirections& world, const AxisDirections& body);

// Rotations about the fixed axes x, y and z by the angles of `radians_xyz`, applied in the order of the
// letters of `order` ("zxy": z first, R = Ry Rx Rz, as Unity's).
glm::dquat euler_rotation(const glm::dvec3& radians_xyz, const std::string& order);

}  // namespace herr
