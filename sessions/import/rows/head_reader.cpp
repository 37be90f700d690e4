#include "sessions/import/rows/head_reader.h"

#include <glm/geometric.hpp>

#include "sessions/files/input_error.h"
#include "sessions/import/rows/time_reader.h"

namespace herr {
namespace {

constexpr double kMaxPositionM = 1e9;

}  // namespace

HeadReader::HeadReader(RowSource& rows, const HeadColumns& columns)
    : columns_(columns),
      valid_(rows, columns.valid),
      rotation_(rows, columns),
      position_(rows, columns.position),
      gravity_(rows, columns.gravity) {
  add_columns(columns.position, told_);
  if (columns.rotation_kind != RotationKind::fixed) add_columns(columns.rotation, told_);
  for (const ColumnRef& column : told_) told_places_.push_back(rows.place(column));
  const Pose& body_from_head = columns.body_from_head;
  const AxisDirections& axes = columns.head_axes;
  if (body_from_head.position != glm::dvec3(0) || body_from_head.orientation != glm::dquat(1, 0, 0, 0))
    head_in_body_ =
        Pose{axes.to_ours(body_from_head.position), rotation_to_ours(body_from_head.orientation, axes, axes)};
}

std::optional<Pose> HeadReader::read(const RowSource& rows, ReadingCounts& counts) const {
  Pose recorded;
  if (!valid_.passes(rows) || !rotation_.read(rows, recorded, counts)) return std::nullopt;
  if (!position_.empty() && !position_.read(rows, recorded.position)) return std::nullopt;
  recorded.position *= columns_.metres_per_unit;
  if (!(glm::dot(recorded.position, recorded.position) < kMaxPositionM * kMaxPositionM))
    rows.fail("the position is 1e9 m or more from the origin", "check the unit of the map");
  return to_ours(recorded);
}

std::string HeadReader::absent_column(const RowSource& rows) const {
  for (std::size_t i = 0; i < told_.size(); ++i) {
    if (!rows.absent(told_places_[i])) continue;
    const std::string text(rows.text(told_places_[i]));
    const std::string name =
        told_[i].name.empty() ? "column " + std::to_string(told_[i].number) : printable(told_[i].name);
    return name + (text.empty() ? " is empty" : " is '" + printable(text) + "'");
  }
  return {};
}

Pose HeadReader::to_ours(const Pose& recorded) const {
  const Pose body = columns_.head_from_world ? inverse(recorded) : recorded;
  const Pose ours{columns_.world_axes.to_ours(body.position),
                  rotation_.in_our_axes()
                      ? body.orientation
                      : rotation_to_ours(body.orientation, columns_.world_axes, columns_.head_axes)};
  return head_in_body_ ? ours * *head_in_body_ : ours;
}

std::optional<glm::dvec3> HeadReader::gravity(const RowSource& rows) const {
  glm::dvec3 gravity(0);
  if (gravity_.empty() || !gravity_.read(rows, gravity) || gravity == glm::dvec3(0)) return std::nullopt;
  return columns_.world_axes.to_ours(gravity);
}

std::vector<ColumnRef> columns_of(const HeadColumns& head) {
  std::vector<ColumnRef> columns;
  add_columns(head.time, columns);
  add_columns(head.position, columns);
  if (head.rotation_kind != RotationKind::fixed) add_columns(head.rotation, columns);
  if (head.rotation_kind == RotationKind::forward_up) add_columns(head.up, columns);
  add_columns(head.valid, columns);
  add_columns(head.gravity, columns);
  if (head.part) columns.push_back(*head.part);
  return columns;
}

}  // namespace herr
