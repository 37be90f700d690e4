#include "sessions/import/check/roles/rotation_roles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "sessions/import/check/roles/column_names.h"
#include "sessions/import/check/roles/matrix_columns.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

constexpr double kNearlyAllRows = 0.9;
constexpr double kFastestDegPerS = 1200;  // a head's turns stay below in nearly all rows

const std::vector<double>& column_of(const SniffedTable& table, std::size_t column) {
  return table.values[column];
}

bool all_numbers(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  return std::all_of(columns.begin(), columns.end(),
                     [&](std::size_t column) { return table.numbers(column) != nullptr; });
}

struct Range {
  double least = 0, most = 0;
};
Range range_of(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  Range range{1e300, -1e300};
  for (const std::size_t column : columns)
    for (const double value : column_of(table, column)) {
      if (!std::isfinite(value)) continue;
      range.least = std::min(range.least, value);
      range.most = std::max(range.most, value);
    }
  return range;
}

// The change a second of the fastest of the columns, exceeded in a tenth of the rows. Angles that wrap jump
// in fewer.
double change_per_second(const SniffedTable& table, const std::vector<std::size_t>& columns, double step_s) {
  double fastest = 0;
  for (const std::size_t column : columns) {
    std::vector<double> steps;
    const std::vector<double>& values = column_of(table, column);
    for (std::size_t i = 1; i < values.size(); ++i)
      if (std::isfinite(values[i] - values[i - 1])) steps.push_back(std::abs(values[i] - values[i - 1]));
    if (steps.empty()) continue;
    const auto tenth = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 9 / 10);
    std::nth_element(steps.begin(), tenth, steps.end());
    fastest = std::max(fastest, *tenth);
  }
  return step_s > 0 ? fastest / step_s : 0;
}

double longest(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  double most = 0;
  for (std::size_t row = 0; row < table.fields.size(); ++row) {
    double sum = 0;
    for (const std::size_t column : columns)
      sum += column_of(table, column)[row] * column_of(table, column)[row];
    if (std::isfinite(sum)) most = std::max(most, std::sqrt(sum));
  }
  return most;
}

// What three numbers a row may be: angles in degrees or radians, or a quaternion without w.
struct ThreeNumbers {
  bool degrees = false, radians = false, quaternion = false;
  std::string why;
};
ThreeNumbers three_numbers(const SniffedTable& table, const NameWords& name,
                           const std::vector<std::size_t>& columns, double step_s) {
  ThreeNumbers may;
  if (name.unit == "deg") return {true, false, false, "as their name says"};
  if (name.unit == "rad") return {false, true, false, "as their name says"};
  const Range range = range_of(table, columns);
  if (std::max(-range.least, range.most) > 7)
    return {true, false, false, "as they go up to " + fixed_text(std::max(-range.least, range.most), 1)};
  const double change = change_per_second(table, columns, step_s);
  const bool too_fast = glm::degrees(change) > kFastestDegPerS;
  if (too_fast)
    return {
        true, false, false,
        "as in radians the head would turn by " + fixed_text(glm::degrees(change), 0) + " degrees a second"};
  may.quaternion = longest(table, columns) <= 1.001;
  may.degrees = may.radians = true;
  if (name.has_start({"quat"}) || name.has({"q"})) may.degrees = may.radians = !may.quaternion;
  if (name.has_start({"euler", "angle"})) may.quaternion = false;
  return may;
}

RotationRole euler_role(const SniffedTable& table, const std::vector<std::size_t>& columns, bool degrees,
                        const std::string& why) {
  RotationRole role;
  role.kind = RotationKind::euler_xyz;
  role.columns = columns;
  role.radians_per_unit = degrees ? glm::radians(1.0) : 1;
  const Range range = range_of(table, columns);
  role.full_circle = degrees && range.least >= 0 && range.most > 181 && range.most <= 360.001;
  role.reason = "The head's rotation stands in " + table.called(columns[0]) +
                " and its neighbours, as angles in " + (degrees ? "degrees" : "radians") + ", " + why + ".";
  return role;
}

void add_three_numbers(const SniffedTable& table, const LetterGroup& group, double step_s,
                       RotationRoles& found) {
  const ThreeNumbers may = three_numbers(table, group.name, group.columns(), step_s);
  const int ways = may.degrees + may.radians + may.quaternion;
  if (ways != 1) {
    found.questions.push_back("What " + table.called(group.xyz[0]) +
                              " and its neighbours are: angles in degrees, angles in radians" +
                              (may.quaternion ? ", or a quaternion without w" : "") +
                              "? Their numbers are small enough for each (\"euler_xyz\" with \"unit\"" +
                              (may.quaternion ? ", or \"quaternion_xyz\"" : "") + " in the map).");
  }
  if (may.quaternion && !may.degrees)
    found.roles.push_back({RotationKind::quaternion_xyz,
                           group.columns(),
                           {},
                           1,
                           false,
                           false,
                           false,
                           "The head's rotation stands in " + table.called(group.xyz[0]) +
                               " and its neighbours, as a quaternion without w."});
  else
    found.roles.push_back(
        euler_role(table, group.columns(), may.degrees, may.why.empty() ? "perhaps" : may.why));
}

struct Scored {
  LetterGroup group;
  int score = 0;
};

// The groups with the best score of those that `fits`; several with the same are for the user to tell.
template <typename Fits>
std::vector<LetterGroup> best_groups(const std::vector<LetterGroup>& groups, const Fits& fits) {
  std::vector<LetterGroup> best;
  int most = 0;
  for (const LetterGroup& group : groups) {
    const int score = head_score(group.name);
    if (score < most || !fits(group)) continue;
    if (score > most) best.clear();
    most = score;
    best.push_back(group);
  }
  return best;
}

void ask_which(const SniffedTable& table, const std::vector<LetterGroup>& groups, const char* what,
               RotationRoles& found) {
  if (groups.size() < 2) return;
  std::string names;
  for (const LetterGroup& group : groups) names += (names.empty() ? "" : ", ") + table.called(group.xyz[0]);
  found.questions.push_back(std::string("Which columns are ") + what + " of the head: those of " + names +
                            " fit alike (\"orientation\" of the map).");
}

bool add_quaternions(const SniffedTable& table, const std::vector<LetterGroup>& groups,
                     RotationRoles& found) {
  const auto best = best_groups(groups, [&](const LetterGroup& group) {
    return group.w &&
           unit_share(table, {group.xyz[0], group.xyz[1], group.xyz[2], *group.w}) >= kNearlyAllRows;
  });
  if (best.empty()) return false;
  ask_which(table, best, "the quaternion", found);
  const LetterGroup& group = best.front();
  found.roles.push_back({RotationKind::quaternion_xyzw,
                         {group.xyz[0], group.xyz[1], group.xyz[2], *group.w},
                         {},
                         1,
                         false,
                         false,
                         false,
                         "The head's rotation stands in " + table.called(group.xyz[0]) +
                             " and its neighbours, as a unit quaternion."});
  return true;
}

// Forward and up of the head in the world, each a unit vector and square to the other.
bool add_forward_up(const SniffedTable& table, const std::vector<LetterGroup>& groups, RotationRoles& found) {
  const auto called = [&](std::initializer_list<std::string_view> words) -> const LetterGroup* {
    for (const LetterGroup& group : groups)
      if (!group.w && group.name.has(words) && head_score(group.name) >= 0 &&
          unit_share(table, group.columns()) >= kNearlyAllRows)
        return &group;
    return nullptr;
  };
  const LetterGroup *forward = called({"forward", "fwd", "front"}), *up = called({"up", "upward"});
  if (!forward || !up) return false;
  found.roles.push_back({RotationKind::forward_up, forward->columns(), up->columns(), 1, false, false, false,
                         "The head's rotation stands in " + table.called(forward->xyz[0]) + " and " +
                             table.called(up->xyz[0]) +
                             " with their neighbours, as its forward and its up."});
  return true;
}

bool add_named_turns(const SniffedTable& table, double step_s, RotationRoles& found) {
  std::array<std::optional<std::size_t>, 3> turn;
  NameWords name;
  for (std::size_t column = 0; column < table.names.size(); ++column) {
    const NameWords words = words_of(table.names[column]);
    if (is_of_eyes(words) || head_score(words) < 0 || !table.numbers(column)) continue;
    for (std::size_t i = 0; i < 3; ++i)
      if (!turn[i] && words.has({std::array<const char*, 3>{"roll", "pitch", "yaw"}[i]})) {
        turn[i] = column;
        name = words;
      }
  }
  if (!(turn[0] && turn[1] && turn[2])) return false;
  const std::vector<std::size_t> columns{*turn[0], *turn[1], *turn[2]};
  const ThreeNumbers may = three_numbers(table, name, columns, step_s);
  if (may.degrees && may.radians)
    found.questions.push_back("Whether " + table.called(columns[0]) + ", " + table.called(columns[1]) +
                              " and " + table.called(columns[2]) +
                              " are in degrees or radians (\"unit\" in the map).");
  RotationRole role = euler_role(table, columns, may.degrees, may.why.empty() ? "perhaps" : may.why);
  role.turns_named = true;
  found.roles.push_back(std::move(role));
  return true;
}

bool add_letter_turns(const SniffedTable& table, const std::vector<LetterGroup>& groups, double step_s,
                      RotationRoles& found) {
  const auto best = best_groups(groups, [&](const LetterGroup& group) {
    return !group.w && all_numbers(table, group.columns()) &&
           (group.name.has_start({"rot", "euler", "angle", "orient", "quat"}) || group.name.has({"q", "r"}));
  });
  if (best.empty()) return false;
  ask_which(table, best, "the rotation", found);
  add_three_numbers(table, best.front(), step_s, found);
  return true;
}

// The second name of a matrix, "r12" or "m01", says whether its numbers go by rows; none: names do not tell.
std::optional<bool> named_column_major(const SniffedTable& table, std::size_t first) {
  if (table.names.empty() || table.names[first + 1].size() < 2) return std::nullopt;
  const std::string &one = table.names[first], &two = table.names[first + 1];
  const auto digit = [](const std::string& name, std::size_t from_end) {
    return name.size() < from_end ? 0 : name[name.size() - from_end];
  };
  const bool next_column = digit(two, 1) == digit(one, 1) + 1 && digit(two, 2) == digit(one, 2);
  const bool next_row = digit(two, 2) == digit(one, 2) + 1 && digit(two, 1) == digit(one, 1);
  const bool digits = digit(one, 2) >= '0' && digit(one, 2) <= '9';
  if (!digits || next_column == next_row) return std::nullopt;
  return next_row;
}

bool add_matrices(const SniffedTable& table, RotationRoles& found) {
  std::vector<MatrixColumns> matrices = find_matrices(table);
  if (matrices.size() > 1 && matrices.front().kind == RotationKind::matrix_3x3) {
    // Turned round it is a rotation too, and nothing in the data tells for sure.
    const auto major = named_column_major(table, matrices.front().first);
    if (!major)
      found.questions.push_back("Whether the matrix in " + table.called(matrices.front().first) +
                                " and the next eight goes by rows or by columns (\"major\" in the map).");
    matrices = {matrices[major.value_or(false) ? 1 : 0]};
  }
  for (const MatrixColumns& matrix : matrices) {
    RotationRole role;
    role.kind = matrix.kind;
    role.column_major = matrix.column_major;
    for (std::size_t i = 0; i < matrix.numbers; ++i) role.columns.push_back(matrix.first + i);
    role.reason = "The head's rotation stands in " + table.called(matrix.first) + " to " +
                  table.called(matrix.first + matrix.numbers - 1) + ", as a matrix by " +
                  (matrix.column_major ? "columns." : "rows.");
    found.roles.push_back(std::move(role));
  }
  return !matrices.empty();
}

// How far the columns are from a unit vector, in the mean of the rows that are numbers and not all zero.
double unit_error(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  double error = 0, rows = 0;
  for (std::size_t row = 0; row < table.fields.size(); ++row) {
    double sum = 0;
    for (const std::size_t column : columns)
      sum += column_of(table, column)[row] * column_of(table, column)[row];
    if (!(sum > 1e-12)) continue;
    error += std::abs(std::sqrt(sum) - 1);
    ++rows;
  }
  return rows > 0 ? error / rows : 1;
}

double mean_size(const SniffedTable& table, std::size_t column) {
  double sum = 0, rows = 0;
  for (const double value : column_of(table, column)) {
    if (!std::isfinite(value)) continue;
    sum += std::abs(value);
    ++rows;
  }
  return rows > 0 ? sum / rows : 0;
}

// Four numbers side by side that are a unit quaternion, in columns whose names do not say so. Beside a number
// that is nearly 0 three of them may be nearly one, too, with a coordinate: the nearest to one are taken.
void add_bare_quaternions(const SniffedTable& table, const TimeRole& time, RotationRoles& found) {
  std::vector<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first + 4 <= table.columns(); ++first) {
    const std::vector<std::size_t> columns{first, first + 1, first + 2, first + 3};
    if (std::find(time.columns.begin(), time.columns.end(), first) != time.columns.end()) continue;
    if (unit_share(table, columns) < kNearlyAllRows) continue;
    const double error = unit_error(table, columns);
    if (error >= least) continue;
    least = error;
    best = columns;
  }
  if (best.empty()) return;
  // Of a head that seldom turns far from where it began w is near 1: that order is tried first.
  const bool first_is_large = mean_size(table, best.front()) > 0.7 && mean_size(table, best.back()) < 0.3;
  using enum RotationKind;
  for (const RotationKind kind : first_is_large ? std::array{quaternion_wxyz, quaternion_xyzw}
                                                : std::array{quaternion_xyzw, quaternion_wxyz})
    found.roles.push_back({kind,
                           best,
                           {},
                           1,
                           false,
                           false,
                           false,
                           "The head's rotation stands in " + table.called(best.front()) + " to " +
                               table.called(best.back()) + ", as a unit quaternion with w " +
                               (kind == RotationKind::quaternion_xyzw ? "last." : "first.")});
}

}  // namespace

double unit_share(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  if (!all_numbers(table, columns)) return 0;
  std::size_t unit = 0, counted = 0;
  for (std::size_t row = 0; row < table.fields.size(); ++row) {
    double sum = 0;
    for (const std::size_t column : columns)
      sum += column_of(table, column)[row] * column_of(table, column)[row];
    if (!(sum > 1e-12)) continue;
    ++counted;
    unit += std::abs(std::sqrt(sum) - 1) < 0.01 ? 1 : 0;
  }
  return counted == 0 ? 0 : static_cast<double>(unit) / static_cast<double>(counted);
}

RotationRoles find_rotations(const SniffedTable& table, const TimeRole& time) {
  RotationRoles found;
  const std::vector<LetterGroup> groups = letter_groups(table);
  if (add_quaternions(table, groups, found) || add_forward_up(table, groups, found) ||
      add_matrices(table, found) || add_letter_turns(table, groups, time.step_s, found) ||
      add_named_turns(table, time.step_s, found))
    return found;
  add_bare_quaternions(table, time, found);
  return found;
}

}  // namespace herr
