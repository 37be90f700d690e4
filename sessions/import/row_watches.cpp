#include "sessions/import/row_watches.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sessions/files/input_error.h"
#include "sessions/streams/field_text.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

constexpr double kGravitySlackDeg = 20;
constexpr std::int64_t kManyRows = 100;

// The axis of the file that points most along a direction of ours, "y" or "-y".
std::string file_axis_along(const AxisDirections& axes, const glm::dvec3& ours) {
  std::string best;
  double most = 0;
  for (glm::length_t i = 0; i < 3; ++i) {
    glm::dvec3 unit(0);
    unit[i] = 1;
    const double along = glm::dot(axes.to_ours(unit), ours);
    if (std::abs(along) <= most) continue;
    most = std::abs(along);
    best = std::string(along < 0 ? "-" : "") + "xyz"[i];
  }
  return best;
}

std::string name_of(const ColumnRef& column) {
  return column.number == 0 ? in_quotes(column.name) : std::to_string(column.number);
}

}  // namespace

void GravityWatch::finish(const std::filesystem::path& file, const AxisDirections& world_axes) const {
  const double length = glm::length(sum_);
  if (!(length > 0)) return;
  const glm::dvec3 up = -sum_ / length;
  const double tilt_deg = glm::degrees(std::atan2(std::hypot(up.x, up.z), up.y));
  if (tilt_deg <= kGravitySlackDeg) return;
  const std::string found = file_axis_along(world_axes, up), said = file_axis_along(world_axes, {0, 1, 0});
  if (found == said)
    throw InputError(file, 0,
                     "gravity says that up is " + fixed_text(tilt_deg, 0) + " degrees from the file's " +
                         said + ", which the map calls up",
                     "check 'gravity' and 'world_axes' of the map");
  throw InputError(file, 0, "gravity says that the file's " + found + " points up, the map says " + said,
                   "correct 'world_axes' of the map, or take another variant of the preset");
}

IdWatch::IdWatch(RowSource& rows, const std::optional<ColumnRef>& column) {
  if (!column) return;
  place_ = rows.place(*column);
  column_ = name_of(*column);
}

void IdWatch::see(const RowSource& rows) {
  if (!place_) return;
  const std::string_view id = rows.text(*place_);
  if (!first_ && id == id_) return;
  if (!first_ && changes_++ == 0) {
    line_ = rows.line();
    from_ = id_;
    to_ = id;
  }
  first_ = false;
  id_ = id;
}

void IdWatch::finish(std::vector<std::string>& remarks) const {
  if (changes_ == 0) return;
  remarks.push_back("the id in column " + column_ + " changes at line " + std::to_string(line_) + " from " +
                    in_quotes(from_) + " to " + in_quotes(to_) + ": another recording begins" +
                    (changes_ > 1 ? " (and " + std::to_string(changes_ - 1) + " more times)" : ""));
}

void ConfidenceWatch::see(const GazeReader& reader, const RowSource& rows, const GazeRow& row) {
  const std::size_t rays = reader.combined() ? 1 : 2;
  for (std::size_t i = 0; i < rays; ++i) {
    Ray& ray = rays_[i];
    if (ray.changes || !(row.valid[i] || (rays == 1 && row.valid[1]))) continue;
    const auto text = reader.confidence(rows, i);
    if (!text) continue;
    if (ray.rows++ == 0)
      ray.first = *text;
    else
      ray.changes = *text != ray.first;
  }
}

void ConfidenceWatch::finish(std::vector<std::string>& remarks) const {
  for (const Ray& ray : rays_) {
    if (ray.changes || ray.rows < kManyRows) continue;
    remarks.push_back("the gaze's confidence is " + in_quotes(ray.first) + " in all " +
                      std::to_string(ray.rows) + " valid rows: it was not measured");
    return;
  }
}

}  // namespace herr
