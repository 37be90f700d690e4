#include "sessions/import/rows/rotation_reader.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "sessions/import/rows/rotation_matrix.h"
#include "sessions/import/rows/unit_length.h"

namespace herr {
namespace {

using Numbers = std::array<double, Places::kMost>;

constexpr const char* kZeroRotation =
    "where that means lost tracking, leave such rows out by valid in the map";
constexpr double kMostTurnRad = 4 * std::numbers::pi;
// Sine of the angle between forward and up below which rounding decides where up is.
constexpr double kLeastSine = 0.01;

glm::dquat unit_quaternion(const RowSource& rows, const glm::dquat& q, ReadingCounts& counts) {
  const double length = std::sqrt(q.x * q.x + q.y * q.y + (q.z * q.z + q.w * q.w));
  return q / unit_divisor(rows, length, "the quaternion", kZeroRotation, counts);
}

glm::dquat completed_quaternion(const RowSource& rows, const Numbers& v) {
  const double squares = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  if (!(squares <= 1 + 2 * kUnitSlack))
    rows.fail("x, y and z of the quaternion have the length " + short_number(std::sqrt(squares)) +
                  ", more than 1, and leave no w",
              "check the columns of the map: are they angles or a rotation vector?");
  if (squares > 1) return glm::dquat(0, v[0], v[1], v[2]) / std::sqrt(squares);
  return {std::sqrt(1 - squares), v[0], v[1], v[2]};
}

glm::dquat vector_rotation(const RowSource& rows, const glm::dvec3& vector) {
  const double angle = glm::length(vector);
  if (!(angle <= kMostTurnRad))
    rows.fail("the rotation vector turns by " + short_number(angle / (2 * std::numbers::pi)) + " turns",
              "check its unit in the map, deg or rad");
  // sin(a / 2) / a goes to 1/2 - a^2 / 48.
  const double factor = angle > 1e-4 ? std::sin(angle / 2) / angle : 0.5 - angle * angle / 48;
  return {std::cos(angle / 2), vector.x * factor, vector.y * factor, vector.z * factor};
}

std::size_t numbers_in(const HeadColumns& columns) {
  switch (columns.rotation_kind) {
    case RotationKind::quaternion_xyzw:
    case RotationKind::quaternion_wxyz:
      return 4;
    case RotationKind::matrix_3x3:
      return 9;
    case RotationKind::matrix_3x4:
      return 12;
    case RotationKind::matrix_4x4:
      return 16;
    case RotationKind::fixed:
      return 0;
    default:
      return 3;
  }
}

}  // namespace

RotationReader::RotationReader(RowSource& rows, const HeadColumns& columns)
    : columns_(columns), rotation_(rows, columns.rotation) {
  const bool fixed = columns.rotation_kind == RotationKind::fixed;
  if (fixed) rotation_ = Places();
  if (rotation_.numbers() != numbers_in(columns))
    rows.fail("the map has " + std::to_string(rotation_.numbers()) + " numbers for a rotation of " +
                  std::to_string(numbers_in(columns)),
              "check the orientation of the map");
  if (columns.rotation_kind == RotationKind::forward_up) up_ = Places(rows, columns.up);
}

bool RotationReader::in_our_axes() const {
  return columns_.rotation_kind == RotationKind::fixed || columns_.rotation_kind == RotationKind::forward_up;
}

bool RotationReader::read(const RowSource& rows, Pose& body, ReadingCounts& counts) const {
  const RotationKind kind = columns_.rotation_kind;
  if (kind == RotationKind::fixed) return true;
  if (kind == RotationKind::forward_up) return read_forward_up(rows, body.orientation, counts);
  Numbers v{};
  const std::span<double> numbers = std::span(v).first(rotation_.numbers());
  if (!rotation_.read(rows, numbers)) return false;
  const glm::dvec3 three(v[0], v[1], v[2]);
  switch (kind) {
    case RotationKind::quaternion_xyzw:
      body.orientation = unit_quaternion(rows, {v[3], v[0], v[1], v[2]}, counts);
      break;
    case RotationKind::quaternion_wxyz:
      body.orientation = unit_quaternion(rows, {v[0], v[1], v[2], v[3]}, counts);
      break;
    case RotationKind::quaternion_xyz:
      body.orientation = completed_quaternion(rows, v);
      break;
    case RotationKind::euler_xyz: {
      const glm::dvec3 sense(columns_.euler_sense[0], columns_.euler_sense[1], columns_.euler_sense[2]);
      body.orientation = euler_rotation(three * sense * columns_.radians_per_unit, columns_.euler_order);
      break;
    }
    case RotationKind::rotation_vector:
      body.orientation = vector_rotation(rows, three * columns_.radians_per_unit);
      break;
    default:
      body = matrix_pose(rows, kind, columns_.column_major, numbers, counts);
  }
  return true;
}

bool RotationReader::read_forward_up(const RowSource& rows, glm::dquat& orientation,
                                     ReadingCounts& counts) const {
  glm::dvec3 forward, up;
  if (!rotation_.read(rows, forward) || !up_.read(rows, up)) return false;
  forward /= unit_divisor(rows, glm::length(forward), "the forward direction", kZeroRotation, counts);
  up /= unit_divisor(rows, glm::length(up), "the up direction", kZeroRotation, counts);
  forward = columns_.world_axes.to_ours(forward);
  up = columns_.world_axes.to_ours(up);
  const glm::dvec3 across = glm::cross(forward, up);
  const double sine = glm::length(across);
  if (sine < kLeastSine)
    rows.fail("forward and up of the head lie on one line",
              "check the columns of the map, or remove the line");
  if (std::abs(glm::dot(forward, up)) > kUnitSlack) ++counts.normalised;
  const glm::dvec3 ahead = glm::normalize(forward), right = across / sine;
  const glm::dmat3 ours(right, glm::cross(right, ahead), -ahead);
  orientation = glm::normalize(glm::quat_cast(ours));
  return true;
}

}  // namespace herr
