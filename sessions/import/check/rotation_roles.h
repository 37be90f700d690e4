// Which columns of an undescribed table hold how the head is turned, and as what. Before: column_names,
// time_role. After: proposed_map tries all of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sessions/import/check/sniffed_table.h"
#include "sessions/import/check/time_role.h"
#include "sessions/import/map/column_map.h"

namespace herr {

struct RotationRole {
  RotationKind kind = RotationKind::quaternion_xyzw;
  std::vector<std::size_t> columns, up;  // in the order of the kind; up: of forward_up
  double radians_per_unit = 1;           // Euler angles
  bool column_major = false;             // matrices
  // Euler angles: by letters, whose order and sense are those of an engine; or called roll, pitch and yaw.
  bool turns_named = false;
  bool full_circle = false;  // all angles lie from 0 to 360 degrees, as Unity writes them
  std::string reason;
};

struct RotationRoles {
  std::vector<RotationRole> roles;     // all that could be, to be told apart by their data
  std::vector<std::string> questions;  // what even the data cannot tell
};
RotationRoles find_rotations(const SniffedTable& table, const TimeRole& time);

// Share of the rows in which the columns are a unit vector; rows that are all zero or no numbers do not
// count.
double unit_share(const SniffedTable& table, const std::vector<std::size_t>& columns);

}  // namespace herr
