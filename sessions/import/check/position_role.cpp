#include "sessions/import/check/position_role.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sessions/import/check/column_names.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

struct LengthUnit {
  double metres;
  const char* key;
  const char* word;
};
constexpr std::array<LengthUnit, 3> kLengths{
    {{1, "m", "metres"}, {0.01, "cm", "centimetres"}, {0.001, "mm", "millimetres"}}};
constexpr double kFastestMPerS = 8;      // of heads, in nearly all rows
constexpr double kSlowestMPerS = 0.003;  // of heads that are worn
constexpr double kTallestM = 3;          // a head is about as high above the floor

double median_size(const std::vector<double>& column) {
  std::vector<double> values;
  for (const double value : column)
    if (std::isfinite(value)) values.push_back(std::abs(value));
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Units a second, exceeded in a tenth of the rows.
double usual_speed(const SniffedTable& table, const std::vector<std::size_t>& columns, double step_s) {
  std::vector<double> steps;
  for (std::size_t row = 1; row < table.fields.size(); ++row) {
    double sum = 0;
    for (const std::size_t column : columns) {
      const double step = table.values[column][row] - table.values[column][row - 1];
      sum += step * step;
    }
    if (std::isfinite(sum)) steps.push_back(std::sqrt(sum));
  }
  if (steps.empty() || step_s <= 0) return 0;
  const auto tenth = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 9 / 10);
  std::nth_element(steps.begin(), tenth, steps.end());
  return *tenth / step_s;
}

// Heads are 1 to 2 m above something, so hundreds are centimetres; and they move as people do.
void find_unit(const SniffedTable& table, const TimeRole& time, PositionRole& role) {
  double largest = 0;
  for (const std::size_t column : role.columns)
    largest = std::max(largest, median_size(table.values[column]));
  const double speed = usual_speed(table, role.columns, time.step_s);
  const auto moves_as_heads = [&](const LengthUnit& unit) {
    return speed == 0 || (speed * unit.metres <= kFastestMPerS && speed * unit.metres >= kSlowestMPerS);
  };
  std::size_t unit = largest > 100 * kTallestM ? 2 : largest > 10 * kTallestM ? 1 : 0;
  // Relative to a start the numbers are small whatever the unit: the speed tells.
  while (unit + 1 < kLengths.size() && speed * kLengths[unit].metres > kFastestMPerS) ++unit;
  const LengthUnit& chosen = kLengths[unit];
  role.metres_per_unit = chosen.metres;
  role.reasons.push_back("The position stands in " + table.called(role.columns[0]) +
                         " and its neighbours, in " + chosen.word + ": the head moves at up to " +
                         fixed_text(speed * chosen.metres, 2) + " m/s.");
  const bool others = std::any_of(kLengths.begin(), kLengths.end(), moves_as_heads);
  if (speed > 0 && others && !moves_as_heads(chosen))
    role.questions.push_back("In which unit the position is: in " + std::string(chosen.word) +
                             " the head would move at " + fixed_text(speed * chosen.metres, 4) +
                             " m/s (\"unit\" of \"position\" in the map).");
}

bool taken(std::size_t column, const RotationRole& rotation, const TimeRole& time) {
  const auto in = [&](const std::vector<std::size_t>& columns) {
    return std::find(columns.begin(), columns.end(), column) != columns.end();
  };
  return in(rotation.columns) || in(rotation.up) || in(time.columns);
}

std::vector<std::size_t> named_position(const SniffedTable& table, const RotationRole& rotation,
                                        const TimeRole& time, PositionRole& role) {
  std::vector<LetterGroup> best;
  int most = 0;
  for (const LetterGroup& group : letter_groups(table)) {
    const NameWords& name = group.name;
    const int head = head_score(name);
    if (group.w || head < 0 || taken(group.xyz[0], rotation, time)) continue;
    if (!table.numbers(group.xyz[0]) || !table.numbers(group.xyz[1]) || !table.numbers(group.xyz[2]))
      continue;
    if (name.has_start({"rot", "euler", "dir", "forward", "quat", "angle", "orient", "up", "normal"}) ||
        name.has({"q", "r"}))
      continue;
    int score = 1 + head;
    score += name.has_start({"pos", "trans", "loc"}) ? 4 : name.has({"p", "t"}) ? 2 : 0;
    if (score < most) continue;
    if (score > most) best.clear();
    most = score;
    best.push_back(group);
  }
  if (best.empty()) return {};
  if (best.size() > 1)
    role.questions.push_back("Which columns are where the head is: those of " + table.called(best[0].xyz[0]) +
                             " and " + table.called(best[1].xyz[0]) +
                             " fit alike (\"position\" of the map).");
  for (const LengthUnit& unit : kLengths)
    if (best.front().name.unit == unit.key) {
      role.metres_per_unit = unit.metres;
      role.reasons.push_back("The position stands in " + table.called(best.front().xyz[0]) +
                             " and its neighbours, in " + unit.word + " as their name says.");
    }
  return best.front().columns();
}

}  // namespace

PositionRole find_position(const SniffedTable& table, const RotationRole& rotation, const TimeRole& time) {
  PositionRole role;
  if (rotation.kind == RotationKind::matrix_4x4 || rotation.kind == RotationKind::matrix_3x4) {
    const std::size_t first = rotation.columns.front();
    const bool four = rotation.kind == RotationKind::matrix_4x4;
    const std::size_t next = rotation.column_major ? (four ? 12 : 9) : 3,
                      apart = rotation.column_major ? 1 : 4;
    role.columns = {first + next, first + next + apart, first + next + 2 * apart};
    find_unit(table, time, role);
    role.columns.clear();
    return role;
  }
  role.columns = named_position(table, rotation, time, role);
  if (role.columns.empty() && (table.names.empty() || letter_groups(table).empty())) {
    const std::size_t first = rotation.columns.front();
    bool free = first >= 3;
    for (std::size_t i = 1; free && i <= 3; ++i)
      free = !taken(first - i, rotation, time) && table.numbers(first - i) != nullptr;
    if (free) role.columns = {first - 3, first - 2, first - 1};
  }
  if (role.columns.empty())
    role.questions.push_back(
        "Where the position of the head stands: no columns are called so (\"position\" of the "
        "map; leave it out where only the rotation was recorded).");
  else if (role.reasons.empty())
    find_unit(table, time, role);
  return role;
}

}  // namespace herr
