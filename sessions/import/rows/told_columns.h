// Whether a line above the rows names numbered columns otherwise than a map takes them: "qx" where it takes
// w. A table of eight bare numbers fits every map that counts eight columns; its header line, where there is
// one, tells them apart. Before: RowSource::told_name, the columns of a map. After: presets/fitting_columns.
#pragma once

#include <optional>
#include <string_view>

#include "sessions/files/input_error.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

// What a name such as "q_RS_x []", "pose.position.y" or "timestamp [ns]" says.
struct ToldColumn {
  enum class Kind { unknown, time, position, rotation, angle, velocity };
  Kind kind = Kind::unknown;
  char letter = 0;        // w, x, y or z; 0: none
  std::string_view unit;  // s, ms, us, ns, m, cm or mm; empty: none
};
ToldColumn told_column(std::string_view name);

// The first contradiction; none where names agree, say nothing, or are not there.
std::optional<InputError> contradicted(const RowSource& rows, const HeadColumns& columns);
std::optional<InputError> contradicted(const RowSource& rows, const GazeColumns& columns);

}  // namespace herr
