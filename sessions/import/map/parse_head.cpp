// The head's columns of a map.
#include <cmath>
#include <nlohmann/json.hpp>

#include "sessions/import/map/map_parts.h"

namespace herr {
namespace {

Pose parse_fixed_pose(const JsonObject& parent, const char* key) {
  if (!parent.has(key)) return {};
  const JsonObject entry = parent.object(key);
  entry.allow_only({"position", "orientation_xyzw"});
  const std::array<double, 4> q = entry.unit_quaternion("orientation_xyzw");
  glm::dquat orientation(q[3], q[0], q[1], q[2]);
  // One that is normalised to rounding stays as it is, digit by digit.
  if (std::abs(glm::dot(orientation, orientation) - 1) > 1e-15) orientation = glm::normalize(orientation);
  return {entry.vec3("position", -10, 10), orientation};
}

void parse_position(const JsonObject& entry, HeadColumns& head) {
  if (!entry.has("position")) return;
  if (holds_position(head.rotation_kind))
    entry.fail("position", "is given, and the matrix of orientation holds it too",
               "remove it, or write the rotation's nine columns as matrix_3x3");
  const JsonObject position = entry.object("position");
  position.allow_only({"columns", "unit"});
  head.position = parse_group(position, "columns", 3);
  head.metres_per_unit = parse_word(position, "unit", kLengthWords, "m");
}

void parse_head_axes(const JsonObject& entry, HeadColumns& head) {
  head.world_axes = parse_axes(entry, "world_axes");
  head.head_axes = parse_axes(entry, "head_axes");
  const bool left = head.world_axes.left_handed();
  const auto hand = [](const AxisDirections& axes) { return word_of(kHandWords, axes.left_handed()); };
  if (left != head.head_axes.left_handed())
    entry.fail("head_axes",
               std::string("and world_axes are not of the same handedness: ") + hand(head.head_axes) +
                   " and " + hand(head.world_axes),
               "turn one axis of one of them around");
  if (entry.has("handedness") && parse_word(entry, "handedness", kHandWords) != left)
    entry.fail("handedness", "is '" + entry.text("handedness") + "', and the axes say otherwise",
               "check the axes");
}

}  // namespace

HeadColumns parse_head(const JsonObject& entry) {
  entry.allow_only({"separator", "decimal", "comment", "header", "header_lines", "names_line", "ragged",
                    "xml", "variant", "time", "position", "orientation", "world_axes", "head_axes",
                    "handedness", "body_from_head", "gravity", "part", "valid"});
  HeadColumns head;
  head.variant = entry.text_or("variant", "");
  head.table = parse_table(entry);
  head.time = parse_time(entry);
  parse_orientation(entry.object("orientation"), head);
  parse_position(entry, head);
  parse_head_axes(entry, head);
  head.body_from_head = parse_fixed_pose(entry, "body_from_head");
  if (entry.has("gravity")) head.gravity = parse_group(entry, "gravity", 3);
  if (entry.has("part")) head.part = parse_ref(entry, "part");
  head.valid = parse_filter(entry);
  return head;
}

}  // namespace herr
