// Where the numbers of a foreign recording stand and what they mean: rows, time, units, axes, valid rows.
// Every importer is such a map; the built-in ones are the JSON files of presets/maps/.
// Before: a JSON file (schema in this folder's README.md).
// After: rows/ reads values with it, import_rows streams; column_map_text writes it as JSON again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/map/axis_directions.h"
#include "sessions/import/text/stamp_text.h"

namespace herr {

// A column by the name in the header line, or by its place (1 is the first). Of XML, the path below the row's
// element: "@TimeStamp", "Pose@Position", "Left/GazeDirection@Value", "Left/Pupil" (its text).
struct ColumnRef {
  std::string name;
  std::size_t number = 0;  // 0: by name
  bool operator==(const ColumnRef&) const = default;
};

// Several numbers: one column each, or all in one field, written as "(1, 2, 3)".
struct ColumnGroup {
  std::vector<ColumnRef> columns;
  std::size_t numbers = 3;
  bool operator==(const ColumnGroup&) const = default;
};

struct TableFormat {
  char separator = ',';  // ' ' stands for any run of spaces and tabs; 0: found in the file ("auto")
  char decimal = '.';    // or ','; 0: found in the file ("auto")
  std::string comment;   // lines that start with it are skipped; empty: there are none
  bool header = true;    // a line names the columns
  // header: that many lines come before the rows, blank and comment lines counted; 1: the first that is
  // neither, or a comment just above the rows that names the columns ...
  std::size_t header_lines = 1;
  std::size_t names_line = 1;  // ... and this one of them names the columns, from 1
  bool ragged = false;         // rows may have more or fewer fields beyond the columns in use
  std::string xml_row;         // not empty: an XML file, one element of this name a row
  bool operator==(const TableFormat&) const = default;
};

// A stamp = scale * value + offset.
struct TimeColumns {
  enum class Kind {
    number,               // `column`, in `unit`
    seconds_nanoseconds,  // `column` whole seconds, `nanoseconds` the rest
    date,                 // `column`, text as `date_format` says
    rate                  // none: row / rate_hz, from 0
  };
  Kind kind = Kind::number;
  ColumnRef column, nanoseconds;
  TimeUnit unit = TimeUnit::s;
  std::string date_format;          // as of strptime, "%f" for a fraction of a second; empty: ISO 8601
  std::optional<int> zone_minutes;  // east of Greenwich, of dates that name no zone themselves
  double rate_hz = 0;
  double scale = 1;
  TimeNs offset_ns = 0;
  bool operator==(const TimeColumns&) const = default;
};

// A test on one field.
struct RowCondition {
  enum class Kind { is, is_not, one_of, above, below, has_bits, finite };
  ColumnRef column;
  Kind kind = Kind::is;
  std::vector<std::string> texts;  // is, is_not: one, the whole field as written; one_of
  double limit = 0;                // above, below
  std::uint64_t bits = 0;          // has_bits: all of them are set in the field, a whole number
  bool operator==(const RowCondition&) const = default;
};

// Passes when every condition of `all` and, unless it is empty, one of `any` passes.
struct RowFilter {
  std::vector<RowCondition> all, any;
  bool operator==(const RowFilter&) const = default;
};

enum class RotationKind {
  quaternion_xyzw,
  quaternion_wxyz,
  quaternion_xyz,   // w >= 0 from the norm
  euler_xyz,        // angles about x, y and z
  matrix_3x3,       // 9 numbers
  matrix_3x4,       // 12 numbers, the position in the last column
  matrix_4x4,       // 16 numbers, likewise
  rotation_vector,  // axis times angle
  forward_up,       // `rotation`: the head's forward in the world, `up`: its up
  fixed             // none recorded: the head's axes are the world's
};

// The head's pose.
struct HeadColumns {
  std::string variant;  // of one device or format among its siblings, "gen2"; empty: fits all
  TableFormat table;
  TimeColumns time;
  std::optional<ColumnGroup> position;  // none: the recording has only rotations, or a matrix holds it
  double metres_per_unit = 1;
  RotationKind rotation_kind = RotationKind::quaternion_xyzw;
  ColumnGroup rotation;
  ColumnGroup up;                           // forward_up
  double radians_per_unit = 1;              // euler_xyz, rotation_vector
  std::string euler_order;                  // the axes in the order in which the rotations are applied, "zxy"
  std::array<int, 3> euler_sense{1, 1, 1};  // -1: the file's angle about x, y, z turns the other way
  bool column_major = false;                // matrices
  bool head_from_world = false;             // the file holds the inverse pose; not of forward_up, fixed
  AxisDirections world_axes, head_axes;
  Pose body_from_head;  // in the file's axes; identity where the file records the head itself
  RowFilter valid;      // other rows are lost tracking and left out
  // Acceleration of gravity in the file's world: checks that world_axes' up is against it.
  std::optional<ColumnGroup> gravity;
  std::optional<ColumnRef> part;  // a graph or session id: where it changes, another recording begins
  bool operator==(const HeadColumns&) const = default;
};

// How two angles make a direction (x to the right of the ray's axes, y up, z forward).
enum class AngleKind {
  tangents,   // (tan azimuth, tan elevation, 1)
  spherical,  // (cos el sin az, sin el, cos el cos az): azimuth about the vertical first, after Fick
  helmholtz   // (sin az, cos az sin el, cos az cos el): elevation about the horizontal first
};

enum class GazeSpace { head, eye, world };  // eye: the head's axes, the origin in the eye

// One gaze ray. Exactly one of vector, tangents, angles and point is given.
struct DirectionColumns {
  std::optional<ColumnGroup> vector;
  std::optional<ColumnGroup> tangents;  // 2 numbers: x/z, y/z
  std::optional<ColumnGroup> angles;    // azimuth, elevation
  AngleKind angle_kind = AngleKind::tangents;
  double radians_per_unit = 1;
  std::optional<ColumnGroup> point;  // what is looked at
  // point: of the ray, in the same space; none: the head's (or eye's) origin.
  std::optional<ColumnGroup> origin;
  double metres_per_unit = 1;             // point, origin
  std::optional<glm::dvec3> placeholder;  // what the tracker writes when it has no direction
  RowFilter valid;
  std::optional<ColumnRef> confidence;  // only judged: it should change
  bool operator==(const DirectionColumns&) const = default;
};

struct GazeColumns {
  std::string variant;
  bool in_head_file = false;
  TableFormat table;
  TimeColumns time;
  GazeSpace space = GazeSpace::head;
  std::vector<DirectionColumns> rays;  // one (combined), or left and right
  // Combined, where the file tells which pupils were seen: left and right. One of them suffices for the ray.
  std::vector<RowFilter> pupils;
  AxisDirections axes;  // head, eye: of the head, as the gaze is written in; world: of the world
  bool operator==(const GazeColumns&) const = default;
};

// When pictures were taken.
struct CameraColumns {
  TableFormat table;
  TimeColumns time;
  // The picture's file name (with or without folders, of which only the last part counts), or a number that
  // stands in it. None: rows and pictures in natural order belong together.
  std::optional<ColumnRef> file;
  RowFilter valid;              // other rows are of another camera
  std::vector<ColumnRef> lens;  // fx, fy, cx, cy in pixels, written with every row; or empty
  bool operator==(const CameraColumns&) const = default;
};

// Where a program puts the files of one recording, relative to its folder. Names may hold one * a part.
struct RecordingLayout {
  struct Camera {
    std::string pictures, stamps, calibration;  // empty: none
    // Pattern of stamps in file names, as for --camera-names; the table of stamps then gives the lens alone.
    std::string names;
    bool operator==(const Camera&) const = default;
  };
  std::string head, gaze;  // empty: none
  std::vector<Camera> cameras;
  bool operator==(const RecordingLayout&) const = default;
};

struct ColumnMap {
  std::string name, note;
  // Alternatives: those whose columns are all there; siblings are told apart by the data. Any list may be
  // empty, not both of head and gaze.
  std::vector<HeadColumns> head;
  std::vector<GazeColumns> gaze;
  std::vector<CameraColumns> camera;
  std::vector<RecordingLayout> layouts;
  std::optional<double> vergence_m;
  std::string otherwise;  // the variant that is taken where the data cannot tell; empty: none, it is an error
  bool operator==(const ColumnMap&) const = default;
};

// Throw InputError that names the field, quotes what it holds and says what is legal.
ColumnMap read_column_map(const std::filesystem::path& json_file);
ColumnMap parse_column_map(std::string_view json, const std::filesystem::path& shown_name);

}  // namespace herr
