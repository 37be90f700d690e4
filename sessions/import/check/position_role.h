// Which columns of an undescribed table are where the head is, and in which unit. Before: rotation_roles.
// After: proposed_map.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/check/rotation_roles.h"
#include "sessions/import/check/sniffed_table.h"

namespace herr {

struct PositionRole {
  std::vector<std::size_t> columns;  // empty: the matrix holds it, or nothing does
  double metres_per_unit = 1;
  std::vector<std::string> reasons, questions;
};
PositionRole find_position(const SniffedTable& table, const RotationRole& rotation, const TimeRole& time);

}  // namespace herr
