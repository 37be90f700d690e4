#include "sessions/import/check/roles/gaze_role.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <set>
#include <utility>

#include "sessions/import/check/roles/column_names.h"
#include "sessions/import/check/roles/rotation_roles.h"

namespace herr {
namespace {

constexpr double kMostRowsUnit = 0.9;

ColumnGroup refs_of(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  ColumnGroup group;
  group.numbers = columns.size();
  for (const std::size_t column : columns) group.columns.push_back(table.ref(column));
  return group;
}

bool any_zero_rows(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  for (std::size_t row = 0; row < table.fields.size(); ++row)
    if (std::all_of(columns.begin(), columns.end(),
                    [&](std::size_t column) { return table.values[column][row] == 0; }))
      return true;
  return false;
}

// The ray of each side, left and right or one for both.
struct Sides {
  std::array<std::optional<std::vector<std::size_t>>, 3> columns;  // none, left, right
  std::optional<GazeSpace> space;
  bool both_spaces = false;

  std::optional<std::vector<std::size_t>>& of(Side side) { return columns[static_cast<std::size_t>(side)]; }
  bool per_eye() const { return columns[1] && columns[2]; }
  bool any() const { return per_eye() || columns[0]; }
};

std::optional<GazeSpace> named_space(const NameWords& name) {
  if (name.has({"world", "global", "w"})) return GazeSpace::world;
  if (name.has({"local", "head", "cpf", "hmd"})) return GazeSpace::head;
  return std::nullopt;
}

Sides vectors_of(const SniffedTable& table, bool only_gaze) {
  Sides sides;
  for (const LetterGroup& group : letter_groups(table)) {
    const NameWords& name = group.name;
    const bool of_gaze = is_of_eyes(name) || (only_gaze && name.has_start({"dir", "forward", "d", "ray"}));
    if (group.w || !of_gaze || name.has_start({"origin", "point", "pos", "hit", "rot"}) ||
        unit_share(table, group.columns()) < kMostRowsUnit)
      continue;
    auto& place = sides.of(side_of(name));
    const auto space = named_space(name);
    if (place) {
      // The same ray in two spaces: the head's is taken.
      if (space == GazeSpace::head && sides.space != GazeSpace::head) {
        place = group.columns();
        sides.space = space;
      }
      continue;
    }
    place = group.columns();
    if (space) sides.space = space;
  }
  return sides;
}

// Azimuth (or yaw) and elevation (or pitch) of each side, or two tangents.
struct AnglePair {
  std::optional<std::size_t> across, upwards;
  std::string unit;
};

std::array<AnglePair, 3> angles_of(const SniffedTable& table, bool only_gaze) {
  std::array<AnglePair, 3> pairs;
  for (std::size_t column = 0; column < table.names.size(); ++column) {
    const NameWords name = words_of(table.names[column]);
    const bool across =
        name.has_start({"azimuth", "yaw", "horizontal"}) || (name.unit == "tan" && name.has({"x"}));
    const bool upwards =
        name.has_start({"elevation", "pitch", "vertical"}) || (name.unit == "tan" && name.has({"y"}));
    if (!(across || upwards) || !table.numbers(column)) continue;
    if (!(is_of_eyes(name) || only_gaze || name.has_start({"azimuth", "elevation"}) || name.unit == "tan"))
      continue;
    AnglePair& pair = pairs[static_cast<std::size_t>(side_of(name))];
    (across ? pair.across : pair.upwards) = column;
    pair.unit = name.unit;
  }
  return pairs;
}

std::optional<DirectionColumns> angle_ray(const SniffedTable& table, const AnglePair& pair) {
  if (!pair.across || !pair.upwards) return std::nullopt;
  DirectionColumns ray;
  const ColumnGroup group = refs_of(table, {*pair.across, *pair.upwards});
  if (pair.unit == "tan") {
    ray.tangents = group;
    return ray;
  }
  double largest = 0;
  for (const std::size_t column : {*pair.across, *pair.upwards})
    for (const double value : table.values[column])
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  ray.angles = group;
  ray.angle_kind = AngleKind::spherical;
  const bool degrees = pair.unit == "deg" || (pair.unit != "rad" && largest > 1.6);
  ray.radians_per_unit = degrees ? glm::radians(1.0) : 1;
  return ray;
}

bool add_angles(const SniffedTable& table, bool only_gaze, GazeRole& role) {
  const std::array<AnglePair, 3> pairs = angles_of(table, only_gaze);
  const auto left = angle_ray(table, pairs[1]), right = angle_ray(table, pairs[2]),
             both = angle_ray(table, pairs[0]);
  if (left && right)
    role.rays = {*left, *right};
  else if (both)
    role.rays = {*both};
  else
    return false;
  role.angles = true;
  const bool tangents = role.rays[0].tangents.has_value();
  const std::size_t first = left && right ? *pairs[1].across : *pairs[0].across;
  role.reasons.push_back("The gaze stands in " + table.called(first) + " and its neighbours, as two " +
                         (tangents                             ? "tangents."
                          : role.rays[0].radians_per_unit == 1 ? "angles in radians."
                                                               : "angles in degrees."));
  role.questions.push_back(tangents ? "Whether the two tangents of the gaze grow to the right and upwards "
                                      "(\"axes\" of the gaze in the map)."
                                    : "By which formula the two angles of the gaze make a direction, and "
                                      "whether they grow to the right "
                                      "and upwards (\"convention\" spherical, tangents or helmholtz, and "
                                      "\"axes\", of the gaze in the map).");
  return true;
}

bool names_gaze(const SniffedTable& table) {
  return std::any_of(table.names.begin(), table.names.end(), [](const std::string& name) {
    const NameWords words = words_of(name);
    return words.has_start({"gaze"}) && !words.has_start({"object", "target", "name"});
  });
}

std::string lower_field(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool flag_belongs(const NameWords& name, FlagOf of) {
  const bool eyes = is_of_eyes(name) || side_of(name) != Side::none;
  switch (of) {
    case FlagOf::head:
      return head_score(name) > 0 || (!eyes && head_score(name) >= 0 && name.has_start({"track", "pose"}));
    case FlagOf::gaze:
      return is_of_eyes(name) && side_of(name) == Side::none;
    case FlagOf::left_eye:
      return side_of(name) == Side::left && !name.has_start({"hand", "control"});
    case FlagOf::right_eye:
      return side_of(name) == Side::right && !name.has_start({"hand", "control"});
  }
  return false;
}

// Where the map has their filter.
const char* place_of(FlagOf of) {
  switch (of) {
    case FlagOf::head:
      return "the head";
    case FlagOf::gaze:
      return "the gaze's combined";
    case FlagOf::left_eye:
      return "the gaze's left";
    case FlagOf::right_eye:
      return "the gaze's right";
  }
  return "the head";
}

}  // namespace

RowFilter find_flags(const SniffedTable& table, FlagOf of, std::vector<std::string>& reasons,
                     std::vector<std::string>& questions) {
  RowFilter filter;
  for (std::size_t column = 0; column < table.names.size(); ++column) {
    const NameWords name = words_of(table.names[column]);
    if (!name.has_start({"valid", "tracked", "istracked", "isvalid", "istracking", "status", "tracking"}))
      continue;
    if (!flag_belongs(name, of)) continue;
    std::set<std::string> words;
    for (const auto& row : table.fields) words.insert(row[column]);
    if (words.size() > 2 || std::any_of(words.begin(), words.end(), [](const std::string& word) {
          return !std::set<std::string>{"0", "1", "true", "false"}.contains(lower_field(word));
        })) {
      if (words.size() > 1)
        questions.push_back("Which values of " + table.called(column) +
                            " mean that the row is good (\"valid\" of " + place_of(of) + " in the map).");
      continue;
    }
    RowCondition good;
    good.column = table.ref(column);
    good.kind = RowCondition::Kind::one_of;
    good.texts = {"1", "true", "True", "TRUE"};
    filter.all.push_back(good);
    reasons.push_back("Rows count as good where " + table.called(column) + " is 1 or true.");
    return filter;
  }
  return filter;
}

std::optional<GazeRole> find_gaze(const SniffedTable& table, bool beside_head) {
  GazeRole role;
  const bool only_gaze = !beside_head;
  Sides sides = vectors_of(table, only_gaze);
  if (!sides.any()) {
    if (add_angles(table, only_gaze, role)) return role;
    if (!names_gaze(table)) return std::nullopt;
    role.questions.push_back(
        "Where the gaze stands: columns are called so, but none are a unit vector or a pair of "
        "angles (\"gaze\" of the map; \"point\" for what is looked at).");
    return role;
  }
  role.space = sides.space;
  const std::array<Side, 2> eyes{Side::left, Side::right};
  for (const Side side :
       sides.per_eye() ? std::vector<Side>(eyes.begin(), eyes.end()) : std::vector<Side>{Side::none}) {
    const std::vector<std::size_t>& columns = *sides.of(side);
    DirectionColumns ray;
    ray.vector = refs_of(table, columns);
    if (any_zero_rows(table, columns)) ray.placeholder = glm::dvec3(0);
    ray.valid = find_flags(table,
                           side == Side::none   ? FlagOf::gaze
                           : side == Side::left ? FlagOf::left_eye
                                                : FlagOf::right_eye,
                           role.reasons, role.questions);
    role.rays.push_back(std::move(ray));
    role.reasons.push_back("The gaze" +
                           std::string(side == Side::none   ? ""
                                       : side == Side::left ? " of the left eye"
                                                            : " of the right eye") +
                           " stands in " + table.called(columns[0]) +
                           " and its neighbours, as a unit vector.");
  }
  return role;
}

}  // namespace herr
