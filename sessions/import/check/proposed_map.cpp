#include "sessions/import/check/proposed_map.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sessions/import/check/axis_trials.h"
#include "sessions/import/check/roles/column_names.h"
#include "sessions/import/check/roles/gaze_role.h"
#include "sessions/import/check/roles/position_role.h"
#include "sessions/import/check/roles/rotation_roles.h"
#include "sessions/import/check/roles/sniffed_table.h"
#include "sessions/import/check/roles/time_role.h"

namespace herr {
namespace {

using Names = std::vector<std::string>;

void append(const Names& more, Names& all) {
  for (const std::string& text : more)
    if (std::find(all.begin(), all.end(), text) == all.end()) all.push_back(text);
}

ColumnGroup group_of(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  ColumnGroup group;
  group.numbers = columns.size();
  for (const std::size_t column : columns) group.columns.push_back(table.ref(column));
  return group;
}

constexpr const char* kUnreadable =
    "What the file is: it is no table of separated numbers (of XML, name the element of a row under \"xml\" "
    "in a "
    "map).";

// Columns of the acceleration of gravity: as long as gravity, in m/s2 or in g.
std::optional<ColumnGroup> gravity_of(const SniffedTable& table, Names& reasons) {
  for (const LetterGroup& group : letter_groups(table)) {
    if (!group.name.has_start({"grav"}) || !table.numbers(group.xyz[0])) continue;
    const double x = table.values[group.xyz[0]].front(), y = table.values[group.xyz[1]].front(),
                 z = table.values[group.xyz[2]].front();
    const double length = std::sqrt(x * x + y * y + z * z);
    if (std::abs(length - 9.81) > 0.2 && std::abs(length - 1) > 0.02) continue;
    reasons.push_back("Gravity stands in " + table.called(group.xyz[0]) +
                      " and its neighbours and decides which way is up.");
    return group_of(table, group.columns());
  }
  return std::nullopt;
}

// What is known before the axes are.
struct FoundColumns {
  SniffedTable head_table;
  TimeRole time;
  RotationRoles rotations;
  std::optional<GazeColumns> gaze;
  std::optional<GazeSpace> space;
  bool gaze_by_angles = false;
};

HeadColumns head_columns(const FoundColumns& found, const RotationRole& rotation, ProposedMap& proposed,
                         bool& centimetres) {
  const SniffedTable& table = found.head_table;
  HeadColumns head;
  head.table = table.format;
  head.time = found.time.time;
  head.rotation_kind = rotation.kind;
  head.rotation = group_of(table, rotation.columns);
  if (!rotation.up.empty()) head.up = group_of(table, rotation.up);
  head.radians_per_unit = rotation.radians_per_unit;
  head.column_major = rotation.column_major;
  const PositionRole position = find_position(table, rotation, found.time);
  if (!position.columns.empty()) head.position = group_of(table, position.columns);
  head.metres_per_unit = position.metres_per_unit;
  centimetres = position.metres_per_unit == 0.01;
  append(position.reasons, proposed.reasons);
  append(position.questions, proposed.questions);
  head.valid = find_flags(table, FlagOf::head, proposed.reasons, proposed.questions);
  head.gravity = gravity_of(table, proposed.reasons);
  return head;
}

// The conventions that this kind of rotation may have, and the ways to apply angles.
void add_readings(const RotationRole& rotation, ColumnMap map, bool centimetres, bool gaze,
                  const std::optional<GazeSpace>& space, std::vector<AxisReading>& readings) {
  using Axes = AxisConvention;
  HeadColumns& head = map.head.front();
  AxisReading reading;
  reading.space = gaze ? space : std::nullopt;
  reading.reason = rotation.reason;
  if (rotation.kind != RotationKind::euler_xyz) {
    // Which way the hand goes shows in no data: centimetres are Unreal's.
    if (rotation.kind == RotationKind::forward_up)
      reading.conventions = {Axes::unity, Axes::openxr, Axes::ros, Axes::unreal};
    if (centimetres) reading.only_one = Axes::unreal;
    reading.map = std::move(map);
    readings.push_back(std::move(reading));
    return;
  }
  const auto add = [&](const char* order, std::vector<std::size_t> conventions,
                       std::optional<std::size_t> only) {
    head.euler_order = order;
    reading.conventions = std::move(conventions);
    reading.only_one = only;
    reading.map = map;
    readings.push_back(reading);
  };
  if (rotation.turns_named && centimetres) {
    head.euler_sense = {-1, -1, 1};
    add("xyz", {Axes::unreal}, Axes::unreal);
  } else if (rotation.turns_named) {
    add("xyz", {Axes::ros}, {});
  } else {
    // Degrees about x, y and z beside metres with y up are what Unity's loggers write.
    const bool usual = rotation.radians_per_unit != 1;
    add("zxy", {Axes::unity, Axes::openxr}, usual ? std::optional(std::size_t{Axes::unity}) : std::nullopt);
    add("xyz", {Axes::ros, Axes::y_forward}, {});
  }
}

// Order and sense of angles show in no data; an engine's names, units and ranges tell, where the data agree.
void judge_angles(const RotationRole& rotation, bool centimetres, const AxisVerdict& verdict,
                  ProposedMap& proposed) {
  if (rotation.kind != RotationKind::euler_xyz) return;
  const auto is = [&](std::size_t convention) { return verdict.axes == &axis_conventions()[convention]; };
  if (rotation.turns_named && centimetres && is(AxisConvention::unreal)) {
    proposed.reasons.push_back(
        "Roll, pitch and yaw in degrees beside centimetres with z up are a rotator of Unreal: "
        "positive pitch looks up, positive yaw turns right, positive roll leans right.");
    return;
  }
  if (!rotation.turns_named && is(AxisConvention::unity) && rotation.radians_per_unit != 1 &&
      (rotation.full_circle || verdict.walks_ahead || verdict.eyes_tell || verdict.map)) {
    proposed.reasons.push_back(
        std::string("Angles about x, y and z in degrees are those of Unity, applied about z, then "
                    "x, then y") +
        (rotation.full_circle ? ": they lie from 0 to 360."
         : verdict.walks_ahead || verdict.eyes_tell
             ? "."
             : ". That is told by names and units alone: a right-handed program's would look the same, "
               "mirrored."));
    return;
  }
  proposed.questions.push_back(
      "In which order and sense the angles turn, and where the axes point: nothing in the "
      "data tells Unity from other programs (\"order\", \"sense\", \"world_axes\" and "
      "\"head_axes\" in the map).");
}

std::optional<GazeColumns> gaze_columns(const RecordingFiles& files, FoundColumns& found,
                                        ProposedMap& proposed) {
  const bool own_file = files.gaze.has_value();
  const bool beside_head = !own_file && !found.rotations.roles.empty();
  const std::optional<SniffedTable> table = own_file ? sniff_table(*files.gaze) : found.head_table;
  const std::optional<GazeRole> role = table ? find_gaze(*table, beside_head) : std::nullopt;
  if (!role) {
    if (own_file)
      proposed.questions.push_back(table
                                       ? "Where the gaze stands: no columns of the gaze's file are called so "
                                         "(\"gaze\" of the map)."
                                       : kUnreadable);
    return std::nullopt;
  }
  append(role->reasons, proposed.reasons);
  append(role->questions, proposed.questions);
  if (role->rays.empty()) return std::nullopt;
  const TimeRole time = own_file ? find_time(*table) : found.time;
  if (own_file) {
    append(time.reasons, proposed.reasons);
    append(time.questions, proposed.questions);
  }
  found.space = role->space;
  found.gaze_by_angles = role->angles;
  GazeColumns gaze;
  gaze.in_head_file = !own_file;
  gaze.table = table->format;
  gaze.time = time.time;
  gaze.rays = role->rays;
  gaze.axes = directions({"right", "up", "forward"});
  return gaze;
}

// Unit vectors in columns without names beside the head's could be the gaze.
void ask_unnamed(const FoundColumns& found, ProposedMap& proposed) {
  const SniffedTable& table = found.head_table;
  if (!table.names.empty() || found.rotations.roles.empty()) return;
  const std::vector<std::size_t>& taken = found.rotations.roles.front().columns;
  for (std::size_t first = 0; first + 3 <= table.columns(); ++first) {
    const std::vector<std::size_t> columns{first, first + 1, first + 2};
    const bool free = std::none_of(columns.begin(), columns.end(), [&](std::size_t column) {
      return std::find(taken.begin(), taken.end(), column) != taken.end();
    });
    if (!free || unit_share(table, columns) < 0.9) continue;
    proposed.questions.push_back("What " + table.called(first) +
                                 " and the next two are, unit vectors without a name: the "
                                 "gaze? (\"gaze\" of the map)");
    return;
  }
}

ColumnMap empty_map(const std::filesystem::path& file) {
  ColumnMap map;
  map.name = file.stem().string();
  map.note = "proposed from the data of " + file.filename().string();
  return map;
}

// A log of gaze alone: which way its axes point shows only against a head.
ProposedMap propose_gaze(const std::filesystem::path& file, FoundColumns& found, ProposedMap proposed) {
  const RecordingFiles files{{}, file};
  proposed.still.head = true;
  auto gaze = gaze_columns(files, found, proposed);
  if (!gaze) return proposed;
  ColumnMap map = empty_map(file);
  gaze->in_head_file = false;
  map.gaze.push_back(std::move(*gaze));
  proposed.map = std::move(map);
  proposed.questions.push_back(
      "Where the axes of the gaze point: without a head nothing tells (\"axes\" of the gaze in "
      "the map).");
  return proposed;
}

void settle(const RecordingFiles& files, const FoundColumns& found, ProposedMap& proposed) {
  std::vector<AxisReading> readings;
  bool centimetres = false;
  for (const RotationRole& rotation : found.rotations.roles) {
    ColumnMap map = empty_map(files.head);
    map.head.push_back(head_columns(found, rotation, proposed, centimetres));
    if (found.gaze && !found.gaze_by_angles) map.gaze.push_back(*found.gaze);
    add_readings(rotation, std::move(map), centimetres, found.gaze.has_value(), found.space, readings);
  }
  const AxisVerdict verdict = settle_axes(files, readings);
  append({readings[verdict.reading].reason}, proposed.reasons);
  append(verdict.reasons, proposed.reasons);
  append(verdict.questions, proposed.questions);
  for (const RotationRole& rotation : found.rotations.roles)
    if (rotation.reason == readings[verdict.reading].reason)
      judge_angles(rotation, centimetres, verdict, proposed);
  append(verdict.trial.remarks, proposed.reasons);
  proposed.map = verdict.map ? verdict.map : verdict.draft;
  if (found.gaze && found.gaze_by_angles) proposed.map->gaze.push_back(*found.gaze);
}

}  // namespace

ProposedMap propose_map(const RecordingFiles& files, const StillParts& still) {
  ProposedMap proposed;
  proposed.still = still;
  FoundColumns found;
  if (files.head.empty()) return propose_gaze(*files.gaze, found, std::move(proposed));
  auto table = sniff_table(files.head);
  if (!table) {
    proposed.questions.push_back(kUnreadable);
    return proposed;
  }
  found.head_table = std::move(*table);
  found.time = find_time(found.head_table);
  found.rotations = find_rotations(found.head_table, found.time);
  if (found.rotations.roles.empty() && !files.gaze && find_gaze(found.head_table, false)) {
    proposed.reasons.push_back("No columns are the rotation of a head: it is a log of gaze alone.");
    return propose_gaze(files.head, found, std::move(proposed));
  }
  append(found.time.reasons, proposed.reasons);
  append(found.time.questions, proposed.questions);
  append(found.rotations.questions, proposed.questions);
  ask_unnamed(found, proposed);
  if (found.rotations.roles.empty()) {
    proposed.questions.push_back(
        "Where the head's rotation stands: no columns are a unit quaternion, a matrix, "
        "forward and up, or angles by their names (\"orientation\" of a map).");
    return proposed;
  }
  if (!still.gaze) found.gaze = gaze_columns(files, found, proposed);
  settle(files, found, proposed);
  return proposed;
}

}  // namespace herr
