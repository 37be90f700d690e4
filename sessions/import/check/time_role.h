// Which column of an undescribed table is its clock, and in which unit. Before: column_names. After:
// proposed_map.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sessions/import/check/sniffed_table.h"
#include "sessions/import/map/column_map.h"

namespace herr {

struct TimeRole {
  TimeColumns time;
  std::vector<std::size_t> columns;  // that it stands in; empty: none was found
  double step_s = 0;                 // between neighbouring rows
  std::vector<std::string> reasons, questions;
};
// Without a clock, `time` counts rows at a rate that nobody has given, and a question asks for it.
TimeRole find_time(const SniffedTable& table);

}  // namespace herr
