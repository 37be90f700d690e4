#include "sessions/import/rows/gaze_reader.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "sessions/import/rows/gaze_direction.h"
#include "sessions/import/rows/time_reader.h"
#include "sessions/import/rows/unit_length.h"

namespace herr {
namespace {

constexpr const char* kZeroGaze =
    "where that means lost gaze, write \"placeholder\": [0, 0, 0] or valid into the gaze of the map";
constexpr double kLeastDistanceM = 1e-9;

bool is_placeholder(const DirectionColumns& columns, std::span<const double> numbers) {
  if (!columns.placeholder) return false;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] != (*columns.placeholder)[static_cast<glm::length_t>(i)]) return false;
  return true;
}

// What the numbers of a vector, tangents or angles say, in the axes of the map.
glm::dvec3 recorded_direction(const RowSource& rows, const DirectionColumns& columns,
                              const std::array<double, 3>& v, ReadingCounts& counts) {
  if (columns.vector) {
    const glm::dvec3 vector(v[0], v[1], v[2]);
    return vector / unit_divisor(rows, glm::length(vector), "the gaze direction", kZeroGaze, counts);
  }
  const double unit = columns.radians_per_unit;
  const auto direction = columns.tangents
                             ? direction_from_tangents(v[0], v[1])
                             : direction_from_angles(columns.angle_kind, v[0] * unit, v[1] * unit);
  if (direction) return *direction;
  const std::string found = "(" + short_number(v[0]) + ", " + short_number(v[1]) + ")";
  if (columns.tangents || columns.angle_kind == AngleKind::tangents)
    rows.fail("the gaze " + found + " is 89 degrees or more off axis",
              columns.tangents ? "check the columns of the map: tangents are x / z and y / z"
                               : "check the unit of the map");
  rows.fail("the gaze angles " + found + " are more than a turn", "check their unit in the map, deg or rad");
}

Places direction_places(RowSource& rows, const DirectionColumns& columns) {
  if (columns.vector) return Places(rows, columns.vector);
  return Places(rows, columns.tangents ? columns.tangents : columns.angles);
}

}  // namespace

GazeReader::GazeReader(RowSource& rows, const GazeColumns& columns) : columns_(columns) {
  for (const DirectionColumns& ray : columns.rays) {
    rays_.push_back({&ray,
                     FilterReader(rows, ray.valid),
                     direction_places(rows, ray),
                     Places(rows, ray.point),
                     Places(rows, ray.origin),
                     {}});
    if (ray.confidence) rays_.back().confidence = rows.place(*ray.confidence);
  }
  for (const RowFilter& pupil : columns.pupils) pupils_.emplace_back(rows, pupil);
}

void GazeReader::read(const RowSource& rows, const Pose* world_from_head,
                      const std::array<glm::dvec3, 2>& eye, GazeRow& row, ReadingCounts& counts) const {
  row.valid = {false, false};
  row.head_direction = {glm::dvec3(0), glm::dvec3(0)};
  if (needs_head() && world_from_head == nullptr) return;
  std::array<bool, 2> seen{true, true};
  for (std::size_t i = 0; i < pupils_.size(); ++i) seen[i] = pupils_[i].passes(rows);
  // Where no pupil was seen, trackers write anything.
  if (!seen[0] && !seen[1]) return;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const auto found = direction(rows, rays_[i], world_from_head, eye[i], counts);
    row.valid[i] = found.has_value();
    if (found) row.head_direction[i] = *found;
  }
  if (!combined()) return;
  row.head_direction[1] = row.head_direction[0];
  row.valid = {row.valid[0] && seen[0], row.valid[0] && seen[1]};
}

std::optional<glm::dvec3> GazeReader::direction(const RowSource& rows, const Ray& ray,
                                                const Pose* world_from_head, const glm::dvec3& eye,
                                                ReadingCounts& counts) const {
  if (!ray.valid.passes(rows)) return std::nullopt;
  if (!ray.point.empty()) return towards_point(rows, ray, world_from_head, eye);
  std::array<double, 3> v{};
  const std::span<double> numbers = std::span(v).first(ray.direction.numbers());
  if (!ray.direction.read(rows, numbers) || is_placeholder(*ray.columns, numbers)) return std::nullopt;
  const glm::dvec3 ours = columns_.axes.to_ours(recorded_direction(rows, *ray.columns, v, counts));
  return needs_head() ? glm::conjugate(world_from_head->orientation) * ours : ours;
}

std::optional<glm::dvec3> GazeReader::towards_point(const RowSource& rows, const Ray& ray,
                                                    const Pose* world_from_head,
                                                    const glm::dvec3& eye) const {
  std::array<double, 3> v{};
  if (!ray.point.read(rows, v) || is_placeholder(*ray.columns, v)) return std::nullopt;
  glm::dvec3 point(v[0], v[1], v[2]), origin(0);
  const bool has_origin = !ray.origin.empty();
  if (has_origin && !ray.origin.read(rows, origin)) return std::nullopt;
  glm::dvec3 way = columns_.axes.to_ours((point - origin) * ray.columns->metres_per_unit);
  if (needs_head()) {
    if (!has_origin) way -= world_from_head->position;
    way = glm::conjugate(world_from_head->orientation) * way;
  }
  if (!has_origin && columns_.space != GazeSpace::eye) way -= eye;
  const double distance = glm::length(way);
  if (!(distance > kLeastDistanceM && std::isfinite(distance)))
    rows.fail("the point looked at is " + short_number(distance) + " m from the eye",
              "where that means lost gaze, write placeholder or valid into the gaze of the map");
  return way / distance;
}

std::optional<std::string_view> GazeReader::confidence(const RowSource& rows, std::size_t ray) const {
  const auto& place = rays_[ray].confidence;
  return place ? std::optional(rows.text(*place)) : std::nullopt;
}

std::vector<ColumnRef> columns_of(const GazeColumns& gaze) {
  std::vector<ColumnRef> columns;
  add_columns(gaze.time, columns);
  for (const DirectionColumns& ray : gaze.rays) {
    for (const auto* group : {&ray.vector, &ray.tangents, &ray.angles, &ray.point, &ray.origin})
      add_columns(*group, columns);
    add_columns(ray.valid, columns);
    if (ray.confidence) columns.push_back(*ray.confidence);
  }
  for (const RowFilter& pupil : gaze.pupils) add_columns(pupil, columns);
  return columns;
}

}  // namespace herr
