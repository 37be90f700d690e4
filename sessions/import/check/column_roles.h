// What the columns of an undescribed table seem to hold, from their names and numbers: time and its unit,
// position, rotation, gaze. Before: sniffed_table. After: proposal tries the axes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/check/sniffed_table.h"
#include "sessions/import/map/column_map.h"

namespace herr {

struct TimeRole {
  TimeColumns time;
  std::string reason;
};
// None: no column grows from row to row. `equal`: all are the same (single precision).
std::optional<TimeRole> find_time(const SniffedTable& table);

struct RotationRole {
  RotationKind kind = RotationKind::quaternion_xyzw;
  std::vector<std::size_t> columns;  // in the order of the kind
  double radians_per_unit = 1;       // Euler angles
  bool unreal_names = false;         // Roll, Pitch, Yaw
  std::string reason;
};
// All that could be: a table without names may hold either order of a quaternion.
std::vector<RotationRole> find_rotations(const SniffedTable& table);

struct PositionRole {
  std::vector<std::size_t> columns;
  std::string reason;
};
// `rotation`: columns that are taken.
std::optional<PositionRole> find_position(const SniffedTable& table, const RotationRole& rotation,
                                          std::size_t time_column);

struct GazeRole {
  std::vector<std::vector<std::size_t>> rays;  // one, or left and right: three columns each
  std::string reason;
};
// Unit vectors by names that speak of gaze or eyes.
std::optional<GazeRole> find_gaze(const SniffedTable& table);

}  // namespace herr
