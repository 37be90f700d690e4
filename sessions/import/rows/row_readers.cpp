#include "sessions/import/rows/row_readers.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace herr {
namespace {

constexpr double kMaxPositionM = 1e9;
// Three decimals, as some loggers write them, move the length of a quaternion by up to 1e-3 and that of a
// direction by 9e-4; twice that is still rounding, more is another quantity.
constexpr double kLengthSlack = 2e-3;
// Further off than this, it is no unit vector at all.
constexpr double kLengthLimit = 0.1;
// A length off by less than this is taken as it is: normalising would only change the last digits.
constexpr double kUnitRounding = 1e-6;
constexpr double kWidestAngleRad = 1.55;  // 88.8 degrees: beyond it the tangent says nothing

// What to divide by. Counts a length that rounding does not explain.
double checked_length(const ForeignTable& table, double length, const std::string& what,
                      ImportedStream& stream) {
  if (!(std::abs(length - 1) <= kLengthLimit))
    table.fail("the " + what + " has the length " + std::to_string(length) + ", not 1",
               "check the columns of the map, or remove the line");
  if (std::abs(length - 1) > kLengthSlack) ++stream.normalised_rows;
  return std::abs(length - 1) <= kUnitRounding ? 1 : length;
}

void add_columns(const RowFilter& filter, std::vector<ColumnRef>& columns) {
  for (const auto* conditions : {&filter.all, &filter.any})
    for (const RowCondition& condition : *conditions) columns.push_back(condition.column);
}

}  // namespace

Places::Places(const ForeignTable& table, const ColumnGroup& group) : numbers_(group.numbers) {
  for (const ColumnRef& column : group.columns) places_.push_back(table.place(column));
}

std::vector<double> Places::read(const ForeignTable& table) const {
  if (places_.size() == 1 && numbers_ > 1) return table.numbers(places_.front(), numbers_);
  std::vector<double> values;
  for (const std::size_t place : places_) values.push_back(table.number(place));
  return values;
}

FilterReader::FilterReader(const ForeignTable& table, const RowFilter& filter) {
  for (const RowCondition& condition : filter.all) all_.push_back({condition, table.place(condition.column)});
  for (const RowCondition& condition : filter.any) any_.push_back({condition, table.place(condition.column)});
}

bool FilterReader::Test::passes(const ForeignTable& table) const {
  switch (condition.kind) {
    case RowCondition::Kind::is:
      return table.text(place) == condition.text;
    case RowCondition::Kind::is_not:
      return table.text(place) != condition.text;
    case RowCondition::Kind::above:
      return table.number(place) > condition.limit;
    case RowCondition::Kind::below:
      return table.number(place) < condition.limit;
  }
  return false;
}

bool FilterReader::passes(const ForeignTable& table) const {
  for (const Test& test : all_)
    if (!test.passes(table)) return false;
  for (const Test& test : any_)
    if (test.passes(table)) return true;
  return any_.empty();
}

HeadReader::HeadReader(const ForeignTable& table, const HeadColumns& columns)
    : columns_(columns), valid_(table, columns.valid), rotation_(table, columns.rotation) {
  if (columns.position) position_ = Places(table, *columns.position);
}

std::optional<Pose> HeadReader::read(const ForeignTable& table, ImportedStream& stream) const {
  if (!valid_.passes(table)) return std::nullopt;
  Pose body;
  if (columns_.position) {
    const std::vector<double> p = position_.read(table);
    body.position = glm::dvec3(p[0], p[1], p[2]) * columns_.metres_per_unit;
    if (!(std::hypot(body.position.x, body.position.y, body.position.z) < kMaxPositionM))
      table.fail("the position is 1e9 m or more from the origin", "check the unit of the map");
  }
  body.orientation = orientation(table, stream);
  const glm::dvec3 position = body(columns_.body_from_head.position);
  const glm::dquat& fixed = columns_.body_from_head.orientation;
  const bool is_head = fixed == glm::dquat(1, 0, 0, 0);
  return Pose{columns_.world_axes.to_ours(position),
              rotation_to_ours(is_head ? body.orientation : glm::normalize(body.orientation * fixed),
                               columns_.world_axes, columns_.head_axes)};
}

glm::dquat HeadReader::orientation(const ForeignTable& table, ImportedStream& stream) const {
  const std::vector<double> v = rotation_.read(table);
  if (columns_.rotation_kind == RotationKind::euler_xyz)
    return euler_rotation(glm::dvec3(v[0], v[1], v[2]) * columns_.radians_per_unit, columns_.euler_order);
  const bool xyzw = columns_.rotation_kind == RotationKind::quaternion_xyzw;
  const glm::dquat q = xyzw ? glm::dquat(v[3], v[0], v[1], v[2]) : glm::dquat(v[0], v[1], v[2], v[3]);
  const double length = std::hypot(std::hypot(q.x, q.y), std::hypot(q.z, q.w));
  return q / checked_length(table, length, "quaternion", stream);
}

RayReader::RayReader(const ForeignTable& table, const DirectionColumns& columns)
    : columns_(columns), valid_(table, columns.valid) {
  if (columns.vector) vector_ = Places(table, *columns.vector);
  if (columns.yaw_pitch) angles_ = Places(table, {{(*columns.yaw_pitch)[0], (*columns.yaw_pitch)[1]}, 2});
}

std::optional<glm::dvec3> RayReader::read(const ForeignTable& table, ImportedStream& stream) const {
  if (!valid_.passes(table)) return std::nullopt;
  if (!columns_.vector) return from_angles(table);
  const std::vector<double> v = vector_.read(table);
  const glm::dvec3 direction(v[0], v[1], v[2]);
  if (columns_.placeholder && direction == *columns_.placeholder) return std::nullopt;
  const double length = std::hypot(direction.x, direction.y, direction.z);
  return direction / checked_length(table, length, "gaze direction", stream);
}

glm::dvec3 RayReader::from_angles(const ForeignTable& table) const {
  const std::vector<double> v = angles_.read(table);
  const double yaw = v[0] * columns_.radians_per_unit, pitch = v[1] * columns_.radians_per_unit;
  if (!(std::abs(yaw) < kWidestAngleRad && std::abs(pitch) < kWidestAngleRad))
    table.fail("the gaze is 89 degrees or more off axis", "check the unit of the map");
  return glm::normalize(glm::dvec3(std::tan(yaw), std::tan(pitch), 1));
}

std::vector<ColumnRef> columns_of(const HeadColumns& head) {
  std::vector<ColumnRef> columns{head.time.column};
  if (head.position)
    columns.insert(columns.end(), head.position->columns.begin(), head.position->columns.end());
  columns.insert(columns.end(), head.rotation.columns.begin(), head.rotation.columns.end());
  add_columns(head.valid, columns);
  return columns;
}

std::vector<ColumnRef> columns_of(const GazeColumns& gaze) {
  std::vector<ColumnRef> columns{gaze.time.column};
  for (const DirectionColumns& ray : gaze.rays) {
    if (ray.vector) columns.insert(columns.end(), ray.vector->columns.begin(), ray.vector->columns.end());
    if (ray.yaw_pitch) columns.insert(columns.end(), ray.yaw_pitch->begin(), ray.yaw_pitch->end());
    add_columns(ray.valid, columns);
  }
  for (const RowFilter& pupil : gaze.pupils) add_columns(pupil, columns);
  return columns;
}

}  // namespace herr
