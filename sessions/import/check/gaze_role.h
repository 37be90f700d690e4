// Which columns of an undescribed table are the gaze, and as what. Before: column_names. After: proposed_map.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sessions/import/check/sniffed_table.h"
#include "sessions/import/check/time_role.h"
#include "sessions/import/map/column_map.h"

namespace herr {

struct GazeRole {
  std::vector<DirectionColumns> rays;  // one, or left and right
  bool angles = false;                 // two numbers: their sense and formula are for the user to say
  std::optional<GazeSpace> space;      // where the names tell
  std::vector<std::string> reasons, questions;
};
// None: nothing is called so. A question without rays: there is gaze, and nobody can say where.
std::optional<GazeRole> find_gaze(const SniffedTable& table);

// The rows that a column of flags calls good, for the head's columns or those of an eye; passes all where
// there is none. A column that speaks of validity otherwise than by 0 and 1 is asked for.
enum class FlagOf { head, gaze, left_eye, right_eye };
RowFilter find_flags(const SniffedTable& table, FlagOf of, std::vector<std::string>& reasons,
                     std::vector<std::string>& questions);

}  // namespace herr
