// The rotation columns of a map.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sessions/import/map/map_parts.h"

namespace herr {
namespace {

void parse_euler(const JsonObject& entry, HeadColumns& head) {
  head.radians_per_unit = parse_word(entry, "unit", kAngleUnitWords, "deg");
  head.euler_order = entry.text("order");
  std::string letters = head.euler_order;
  std::sort(letters.begin(), letters.end());
  if (letters != "xyz")
    entry.fail("order", "is '" + printable(head.euler_order) + "'",
               "write the axes in the order in which the rotations are applied, such as zxy for Unity");
  if (!entry.has("sense")) return;
  const std::vector<double> sense = entry.numbers("sense", 3, -1, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(sense[i]) != 1)
      entry.fail("sense", "holds a number that is neither 1 nor -1",
                 "write -1 for each angle (about x, y, z) that turns the other way, such as [1, -1, -1]");
    head.euler_sense[i] = sense[i] < 0 ? -1 : 1;
  }
}

// What each kind has besides its columns.
void parse_details(const JsonObject& entry, const RotationWord& word, HeadColumns& head) {
  const RotationKind kind = word.meaning;
  if (kind != RotationKind::euler_xyz) refuse_beside(entry, word.word, {"order", "sense"});
  if (kind != RotationKind::forward_up) refuse_beside(entry, word.word, {"up"});
  if (!is_matrix(kind)) refuse_beside(entry, word.word, {"major"});
  if (kind == RotationKind::fixed || kind == RotationKind::forward_up)
    refuse_beside(entry, word.word, {"inverse"});
  if (kind == RotationKind::euler_xyz) {
    parse_euler(entry, head);
  } else if (kind == RotationKind::rotation_vector) {
    head.radians_per_unit = parse_word(entry, "unit", kAngleUnitWords);
  } else if (holds_position(kind)) {
    head.metres_per_unit = parse_word(entry, "unit", kLengthWords, "m");
  } else {
    refuse_beside(entry, word.word, {"unit"});
  }
  if (is_matrix(kind)) head.column_major = parse_word(entry, "major", kMajorWords);
  if (kind == RotationKind::forward_up) head.up = parse_group(entry, "up", 3);
}

}  // namespace

void parse_orientation(const JsonObject& entry, HeadColumns& head) {
  entry.allow_only({"quaternion_xyzw", "quaternion_wxyz", "quaternion_xyz", "euler_xyz", "matrix_3x3",
                    "matrix_3x4", "matrix_4x4", "rotation_vector", "forward", "up", "fixed", "unit", "order",
                    "sense", "major", "inverse"});
  const std::string key =
      only_one_of(entry,
                  {"quaternion_xyzw", "quaternion_wxyz", "quaternion_xyz", "euler_xyz", "matrix_3x3",
                   "matrix_3x4", "matrix_4x4", "rotation_vector", "forward", "fixed"},
                  "rotation");
  const RotationWord& word = *std::find_if(std::begin(kRotationWords), std::end(kRotationWords),
                                           [&](const RotationWord& known) { return key == known.word; });
  head.rotation_kind = word.meaning;
  if (word.meaning != RotationKind::fixed)
    head.rotation = parse_group(entry, word.word, word.numbers);
  else if (!entry.boolean_or("fixed", true))
    entry.fail("fixed", "is false", "write true, or name the columns of the rotation");
  parse_details(entry, word, head);
  head.head_from_world = entry.boolean_or("inverse", false);
}

}  // namespace herr
