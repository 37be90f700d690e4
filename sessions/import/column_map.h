// Where the numbers of a foreign table stand and what they mean: separator, units, axes, order of angles,
// which rows count. Every importer is such a map; the built-in ones are the JSON files in maps/.
// Before: a JSON file (schema in this folder's README.md). After: import_rows reads tables with it.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/axis_directions.h"
#include "sessions/import/stamp_text.h"

namespace herr {

// A column by the name in the header line, or by its place (1 is the first).
struct ColumnRef {
  std::string name;
  std::size_t number = 0;  // 0: by name
};

// Several numbers: one column each, or all in one field, written as "(1, 2, 3)".
struct ColumnGroup {
  std::vector<ColumnRef> columns;
  std::size_t numbers = 3;
};

struct TableFormat {
  char separator = ',';  // ' ' stands for any run of spaces and tabs
  std::string comment;   // lines that start with it are skipped; empty: there are none
  bool header = true;    // the first line names the columns
};

struct TimeColumn {
  ColumnRef column;
  TimeUnit unit = TimeUnit::s;
};

// A test on one field.
struct RowCondition {
  enum class Kind { is, is_not, above, below };
  ColumnRef column;
  Kind kind = Kind::is;
  std::string text;  // is, is_not: the whole field, as written
  double limit = 0;  // above, below
};

// Passes when every condition of `all` and, unless it is empty, one of `any` passes.
struct RowFilter {
  std::vector<RowCondition> all, any;
};

enum class RotationKind { quaternion_xyzw, quaternion_wxyz, euler_xyz };

// The head's pose.
struct HeadColumns {
  TableFormat table;
  TimeColumn time;
  std::optional<ColumnGroup> position;  // none: the recording has only rotations
  double metres_per_unit = 1;
  RotationKind rotation_kind = RotationKind::quaternion_xyzw;
  ColumnGroup rotation;
  double radians_per_unit = 1;  // euler_xyz
  std::string euler_order;      // euler_xyz: the axes in the order in which the rotations are applied, "zxy"
  AxisDirections world_axes, head_axes;
  Pose body_from_head;  // in the file's axes; identity where the file records the head itself
  RowFilter valid;      // other rows are lost tracking and left out
};

// One gaze ray.
struct DirectionColumns {
  std::optional<ColumnGroup> vector;
  std::optional<std::array<ColumnRef, 2>> yaw_pitch;  // direction = (tan yaw, tan pitch, 1), normalised
  double radians_per_unit = 1;
  std::optional<glm::dvec3> placeholder;  // what the tracker writes when it has no direction
  RowFilter valid;
};

struct GazeColumns {
  bool in_head_file = false;
  TableFormat table;
  TimeColumn time;
  std::vector<DirectionColumns> rays;  // one (combined), or left and right
  // Combined, where the file tells which pupils were seen: left and right. One of them suffices for the ray.
  std::vector<RowFilter> pupils;
  AxisDirections axes;  // of the head, as the gaze is written in
};

struct ColumnMap {
  std::string name, note;
  std::vector<HeadColumns> head;  // alternatives: the first one whose columns are all there is used
  std::vector<GazeColumns> gaze;  // may be empty
  std::optional<double> vergence_m;
};

// Throw InputError.
ColumnMap read_column_map(const std::filesystem::path& json_file);
ColumnMap parse_column_map(std::string_view json, const std::filesystem::path& shown_name);

}  // namespace herr
