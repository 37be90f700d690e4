#include "sessions/import/map/column_map.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

using nlohmann::json;

constexpr std::int64_t kMostColumns = 4096;

ColumnRef parse_ref(const JsonObject& entry, const char* key, const json& value) {
  ColumnRef ref;
  if (value.is_string()) ref.name = value.get<std::string>();
  if (value.is_number_integer() && value >= 1 && value <= kMostColumns) ref.number = value.get<std::size_t>();
  if (ref.name.empty() && ref.number == 0)
    entry.fail(key, "names no column", "write the column's name, or its number where 1 is the first");
  return ref;
}

ColumnRef parse_ref(const JsonObject& entry, const char* key) {
  return parse_ref(entry, key, entry.value(key));
}

// "HMDPosition" (all numbers in one field) or ["px", "py", "pz"].
ColumnGroup parse_group(const JsonObject& entry, const char* key, std::size_t numbers) {
  const json& value = entry.value(key);
  ColumnGroup group;
  group.numbers = numbers;
  if (!value.is_array()) {
    group.columns.push_back(parse_ref(entry, key, value));
    return group;
  }
  if (value.size() != numbers)
    entry.fail(key, "has " + std::to_string(value.size()) + " columns",
               "name " + std::to_string(numbers) + " columns, or one whose field holds all numbers");
  for (const json& element : value) group.columns.push_back(parse_ref(entry, key, element));
  return group;
}

double parse_scale(const JsonObject& entry, const std::vector<std::pair<std::string, double>>& units) {
  const std::string word = entry.text_or("unit", units.front().first);
  std::string known;
  for (const auto& [name, scale] : units) {
    if (name == word) return scale;
    known += (known.empty() ? "" : ", ") + name;
  }
  entry.fail("unit", "is '" + printable(word) + "'", "write one of " + known);
}

double metres_per_unit(const JsonObject& entry) {
  return parse_scale(entry, {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}});
}

double radians_per_unit(const JsonObject& entry) {
  return parse_scale(entry, {{"deg", glm::radians(1.0)}, {"rad", 1}});
}

TableFormat parse_table(const JsonObject& entry) {
  TableFormat table;
  const std::string word = entry.text_or("separator", ",");
  if (word == "tab" || word == "\t")
    table.separator = '\t';
  else if (word == "spaces" || word == " ")
    table.separator = ' ';
  else if (word == "," || word == ";")
    table.separator = word.front();
  else
    entry.fail("separator", "is '" + printable(word) + "'", "write \",\", \";\", \"tab\" or \"spaces\"");
  table.comment = entry.text_or("comment", "");
  table.header = entry.boolean_or("header", true);
  return table;
}

TimeColumn parse_time(const JsonObject& parent) {
  const JsonObject entry = parent.object("time");
  entry.allow_only({"column", "unit"});
  const auto unit = time_unit(entry.text("unit"));
  if (!unit)
    entry.fail("unit", "is '" + printable(entry.text("unit")) + "'",
               "write s, ms, us, ns or dotnet-ticks (100 ns since the year 1)");
  return {parse_ref(entry, "column"), *unit};
}

AxisDirections parse_axes(const JsonObject& entry, const char* key) {
  const json& value = entry.value(key);
  std::array<std::string, 3> words;
  bool good = value.is_array() && value.size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) {
    good = value[i].is_string();
    if (good) words[i] = value[i].get<std::string>();
  }
  const auto axes = good ? AxisDirections::from_words(words) : std::nullopt;
  if (!axes)
    entry.fail(key, "does not say where x, y and z point",
               "write three of right, left, up, down, forward, back, such as [\"right\", \"up\", \"back\"]");
  return *axes;
}

std::vector<RowCondition> parse_conditions(const JsonObject& filter, const char* key) {
  std::vector<RowCondition> conditions;
  for (const JsonObject& entry : filter.objects(key)) {
    entry.allow_only({"column", "is", "is_not", "above", "below"});
    RowCondition condition;
    condition.column = parse_ref(entry, "column");
    const int tests = entry.has("is") + entry.has("is_not") + entry.has("above") + entry.has("below");
    if (tests != 1) entry.fail(nullptr, "needs one test", "give one of is, is_not, above, below");
    if (entry.has("is") || entry.has("is_not")) {
      condition.kind = entry.has("is") ? RowCondition::Kind::is : RowCondition::Kind::is_not;
      condition.text = entry.text(entry.has("is") ? "is" : "is_not");
    } else {
      condition.kind = entry.has("above") ? RowCondition::Kind::above : RowCondition::Kind::below;
      condition.limit = entry.number(entry.has("above") ? "above" : "below", -1e300, 1e300);
    }
    conditions.push_back(condition);
  }
  return conditions;
}

RowFilter parse_filter(const JsonObject& parent, const char* key = "valid") {
  if (!parent.has(key)) return {};
  const JsonObject entry = parent.object(key);
  entry.allow_only({"all", "any"});
  return {parse_conditions(entry, "all"), parse_conditions(entry, "any")};
}

void parse_orientation(const JsonObject& entry, HeadColumns& head) {
  entry.allow_only({"quaternion_xyzw", "quaternion_wxyz", "euler_xyz", "unit", "order"});
  const int kinds = entry.has("quaternion_xyzw") + entry.has("quaternion_wxyz") + entry.has("euler_xyz");
  if (kinds != 1)
    entry.fail(nullptr, "needs one of quaternion_xyzw, quaternion_wxyz and euler_xyz", "give one of them");
  if (!entry.has("euler_xyz")) {
    const bool xyzw = entry.has("quaternion_xyzw");
    head.rotation_kind = xyzw ? RotationKind::quaternion_xyzw : RotationKind::quaternion_wxyz;
    head.rotation = parse_group(entry, xyzw ? "quaternion_xyzw" : "quaternion_wxyz", 4);
    return;
  }
  head.rotation_kind = RotationKind::euler_xyz;
  head.rotation = parse_group(entry, "euler_xyz", 3);
  head.radians_per_unit = radians_per_unit(entry);
  head.euler_order = entry.text("order");
  std::string letters = head.euler_order;
  std::sort(letters.begin(), letters.end());
  if (letters != "xyz")
    entry.fail("order", "is '" + printable(head.euler_order) + "'",
               "write the axes in the order in which the rotations are applied, such as zxy for Unity");
}

Pose parse_fixed_pose(const JsonObject& parent, const char* key) {
  if (!parent.has(key)) return {};
  const JsonObject entry = parent.object(key);
  entry.allow_only({"position", "orientation_xyzw"});
  const std::vector<double> q = entry.numbers("orientation_xyzw", 4, -1.001, 1.001);
  const glm::dquat orientation(q[3], q[0], q[1], q[2]);
  if (!(std::abs(glm::length(orientation) - 1) <= 1e-3))
    entry.fail("orientation_xyzw", "is not a unit quaternion", "write x, y, z, w");
  return {entry.vec3("position", -10, 10), glm::normalize(orientation)};
}

HeadColumns parse_head(const JsonObject& entry) {
  entry.allow_only({"separator", "comment", "header", "time", "position", "orientation", "world_axes",
                    "head_axes", "handedness", "body_from_head", "valid"});
  HeadColumns head;
  head.table = parse_table(entry);
  head.time = parse_time(entry);
  if (entry.has("position")) {
    const JsonObject position = entry.object("position");
    position.allow_only({"columns", "unit"});
    head.position = parse_group(position, "columns", 3);
    head.metres_per_unit = metres_per_unit(position);
  }
  parse_orientation(entry.object("orientation"), head);
  head.world_axes = parse_axes(entry, "world_axes");
  head.head_axes = parse_axes(entry, "head_axes");
  if (head.world_axes.left_handed() != head.head_axes.left_handed())
    entry.fail("head_axes", "and world_axes are not of the same handedness", "check both");
  const std::string hand = entry.text_or("handedness", head.world_axes.left_handed() ? "left" : "right");
  if (hand != (head.world_axes.left_handed() ? "left" : "right"))
    entry.fail("handedness", "is '" + printable(hand) + "', and the axes say otherwise", "check the axes");
  head.body_from_head = parse_fixed_pose(entry, "body_from_head");
  head.valid = parse_filter(entry);
  return head;
}

// Its keys: vector, or yaw, pitch and unit; placeholder; valid.
DirectionColumns parse_ray(const JsonObject& entry) {
  DirectionColumns ray;
  if (entry.has("vector") == entry.has("yaw"))
    entry.fail(nullptr, "needs a direction", "give either vector, or yaw and pitch");
  if (entry.has("vector")) {
    ray.vector = parse_group(entry, "vector", 3);
  } else {
    ray.yaw_pitch = {parse_ref(entry, "yaw"), parse_ref(entry, "pitch")};
    ray.radians_per_unit = radians_per_unit(entry);
  }
  if (entry.has("placeholder")) ray.placeholder = entry.vec3("placeholder", -1e9, 1e9);
  ray.valid = parse_filter(entry);
  return ray;
}

// One ray for both eyes, and where the file tells it, which pupils it was made from.
void parse_combined(const JsonObject& entry, GazeColumns& gaze) {
  entry.allow_only({"vector", "yaw", "pitch", "unit", "placeholder", "valid", "valid_left", "valid_right"});
  gaze.rays = {parse_ray(entry)};
  if (entry.has("valid_left") != entry.has("valid_right"))
    entry.fail(nullptr, "has one of valid_left and valid_right", "give both or neither");
  if (entry.has("valid_left"))
    gaze.pupils = {parse_filter(entry, "valid_left"), parse_filter(entry, "valid_right")};
}

GazeColumns parse_gaze(const JsonObject& entry) {
  entry.allow_only(
      {"in_head_file", "separator", "comment", "header", "time", "combined", "left", "right", "axes"});
  GazeColumns gaze;
  gaze.in_head_file = entry.boolean_or("in_head_file", false);
  gaze.table = parse_table(entry);
  gaze.time = parse_time(entry);
  gaze.axes = parse_axes(entry, "axes");
  if (entry.has("combined") == (entry.has("left") && entry.has("right")))
    entry.fail(nullptr, "needs its rays", "give either combined, or left and right");
  if (entry.has("combined"))
    parse_combined(entry.object("combined"), gaze);
  else
    for (const char* eye : {"left", "right"}) {
      const JsonObject ray = entry.object(eye);
      ray.allow_only({"vector", "yaw", "pitch", "unit", "placeholder", "valid"});
      gaze.rays.push_back(parse_ray(ray));
    }
  return gaze;
}

ColumnMap parse_map(const json& document, const std::filesystem::path& file) {
  const JsonObject root(document, file, "");
  root.allow_only({"format_version", "name", "note", "head", "gaze", "vergence_m"});
  root.integer("format_version", 1, 1);
  ColumnMap map;
  map.name = root.text("name");
  map.note = root.text_or("note", "");
  for (const JsonObject& entry : root.objects("head")) map.head.push_back(parse_head(entry));
  if (map.head.empty()) root.fail("head", "is missing or empty", "say where the head's pose stands");
  for (const JsonObject& entry : root.objects("gaze")) map.gaze.push_back(parse_gaze(entry));
  if (root.has("vergence_m")) map.vergence_m = root.number("vergence_m", 0.05, 10000);
  return map;
}

constexpr JsonLimits kLimits{1 << 20, 16, 10000};

}  // namespace

ColumnMap read_column_map(const std::filesystem::path& json_file) {
  return parse_map(parse_json_file(json_file, kLimits), json_file);
}

ColumnMap parse_column_map(std::string_view json_text, const std::filesystem::path& shown_name) {
  return parse_map(parse_json_text(json_text, shown_name, 1, kLimits), shown_name);
}

}  // namespace herr
