#include "sessions/import/check/column_roles.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <initializer_list>
#include <string_view>

namespace herr {
namespace {

constexpr double kUsual = 0.9;  // of the rows

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool holds(const std::string& text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

std::optional<std::size_t> column_called(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

// Columns whose names differ in one letter alone: x, y, z and, where there is one, w.
struct LetterGroup {
  std::string stem;  // the name without that letter, lower case
  std::array<std::size_t, 3> xyz{};
  std::optional<std::size_t> w;
};

std::vector<LetterGroup> letter_groups(const SniffedTable& table) {
  std::vector<std::string> names;
  for (const std::string& name : table.names) names.push_back(lower(name));
  std::vector<LetterGroup> groups;
  for (std::size_t x = 0; x < names.size(); ++x)
    for (std::size_t at = 0; at < names[x].size(); ++at) {
      if (names[x][at] != 'x') continue;
      const auto with = [&](char letter) {
        std::string name = names[x];
        name[at] = letter;
        return column_called(names, name);
      };
      const auto y = with('y'), z = with('z');
      if (!y || !z) continue;
      std::string stem = names[x];
      stem.erase(at, 1);
      groups.push_back({stem, {x, *y, *z}, with('w')});
    }
  return groups;
}

// Share of the rows in which the columns are a unit vector; rows that are all zero or no numbers do not
// count.
double unit_share(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  std::vector<std::vector<double>> values;
  for (const std::size_t column : columns) {
    const auto numbers = table.numbers(column);
    if (!numbers) return 0;
    values.push_back(*numbers);
  }
  std::size_t unit = 0, counted = 0;
  for (std::size_t row = 0; row < table.fields.size(); ++row) {
    double sum = 0;
    for (const auto& column : values) sum += column[row] * column[row];
    if (!(sum > 1e-12)) continue;
    ++counted;
    unit += std::abs(std::sqrt(sum) - 1) < 0.01 ? 1 : 0;
  }
  return counted == 0 ? 0 : static_cast<double>(unit) / static_cast<double>(counted);
}

double largest(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  double most = 0;
  for (const std::size_t column : columns)
    for (const double value : table.numbers(column).value_or(std::vector<double>{}))
      if (std::isfinite(value)) most = std::max(most, std::abs(value));
  return most;
}

std::string called(const SniffedTable& table, std::size_t column) {
  const ColumnRef ref = table.ref(column);
  return ref.number > 0 ? "column " + std::to_string(ref.number) : "'" + ref.name + "'";
}

// Steps between neighbours that grow; none where fewer than nine in ten do.
std::vector<double> growing_steps(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] > values[i - 1]) steps.push_back(values[i] - values[i - 1]);
  if (static_cast<double>(steps.size()) < kUsual * static_cast<double>(values.size() - 1)) steps.clear();
  std::sort(steps.begin(), steps.end());
  return steps;
}

struct UnitGuess {
  TimeUnit unit;
  double seconds;
  const char* word;
};
constexpr std::array<UnitGuess, 4> kUnits{{{TimeUnit::s, 1, "seconds"},
                                           {TimeUnit::ms, 1e-3, "milliseconds"},
                                           {TimeUnit::us, 1e-6, "microseconds"},
                                           {TimeUnit::ns, 1e-9, "nanoseconds"}}};

// Clocks since 1970 tell their unit by their size, others by the rate that they give.
std::optional<UnitGuess> unit_of(double value, double step) {
  for (const UnitGuess& guess : kUnits)
    if (value * guess.seconds > 9e8 && value * guess.seconds < 4e9) return guess;
  constexpr double kSlowestHz = 10, kFastestHz = 2000;
  for (const UnitGuess& guess : kUnits) {
    const double hz = 1 / (step * guess.seconds);
    if (hz >= kSlowestHz && hz <= kFastestHz) return guess;
  }
  return std::nullopt;
}

int time_score(const std::string& name) {
  if (holds(name, {"timestamp", "time_stamp", "unix", "stamp"})) return 3;
  if (holds(name, {"time"})) return 2;
  return name == "t" || name == "ts" ? 2 : 0;
}

std::optional<TimeRole> date_time(const SniffedTable& table) {
  for (std::size_t column = 0; column < table.columns(); ++column) {
    const std::string& text = table.fields.front()[column];
    if (text.size() < 19 || text[4] != '-' || text[7] != '-' || text[13] != ':' || text[16] != ':') continue;
    TimeRole role;
    role.time.kind = TimeColumns::Kind::date;
    role.time.column = table.ref(column);
    role.reason = called(table, column) + " holds dates";
    return role;
  }
  return std::nullopt;
}

// Four numbers side by side that are a unit quaternion, of a table without names.
void add_bare_quaternions(const SniffedTable& table, std::vector<RotationRole>& roles) {
  for (std::size_t first = 1; first + 4 <= table.columns(); ++first) {
    const std::vector<std::size_t> columns{first, first + 1, first + 2, first + 3};
    if (unit_share(table, columns) < kUsual) continue;
    for (const RotationKind kind : {RotationKind::quaternion_xyzw, RotationKind::quaternion_wxyz})
      roles.push_back({kind, columns, 1, false,
                       "columns " + std::to_string(first + 1) + " to " + std::to_string(first + 4) +
                           " are a unit quaternion"});
    return;
  }
}

void add_matrices(const SniffedTable& table, std::vector<RotationRole>& roles) {
  for (std::size_t first = 0; first + 16 <= table.columns(); ++first) {
    const auto is = [&](std::size_t i, double value) {
      const auto numbers = table.numbers(first + i);
      return numbers && std::all_of(numbers->begin(), numbers->end(),
                                    [&](double v) { return std::abs(v - value) < 1e-9; });
    };
    if (!(is(12, 0) && is(13, 0) && is(14, 0) && is(15, 1))) continue;
    RotationRole role;
    role.kind = RotationKind::matrix_4x4;
    for (std::size_t i = 0; i < 16; ++i) role.columns.push_back(first + i);
    role.reason = "columns " + std::to_string(first + 1) + " to " + std::to_string(first + 16) +
                  " are a 4x4 matrix by rows";
    roles.push_back(std::move(role));
    return;
  }
}

double angle_unit(const SniffedTable& table, const std::vector<std::size_t>& columns) {
  return largest(table, columns) > 7 ? glm::radians(1.0) : 1;
}

void add_named_rotations(const SniffedTable& table, std::vector<RotationRole>& roles) {
  for (const LetterGroup& group : letter_groups(table)) {
    const std::vector<std::size_t> xyz(group.xyz.begin(), group.xyz.end());
    if (group.w) {
      const std::vector<std::size_t> xyzw{xyz[0], xyz[1], xyz[2], *group.w};
      if (unit_share(table, xyzw) >= kUsual)
        roles.insert(roles.begin(), {RotationKind::quaternion_xyzw, xyzw, 1, false,
                                     called(table, xyz[0]) + " and its neighbours are a unit quaternion"});
    } else if (holds(group.stem, {"rot", "euler", "angle", "orient"}) &&
               !holds(group.stem, {"gaze", "eye", "veloc", "vel_", "omega", "gyro", "rate"})) {
      const double unit = angle_unit(table, xyz);
      if (unit == 1) continue;  // numbers below 7: radians, or a quaternion without w
      roles.push_back(
          {RotationKind::euler_xyz, xyz, unit, false,
           called(table, xyz[0]) + " and its neighbours are angles in degrees, in the order of Unity"});
    }
  }
  std::array<std::optional<std::size_t>, 3> named;
  for (std::size_t column = 0; column < table.names.size(); ++column) {
    const std::string name = lower(table.names[column]);
    for (std::size_t i = 0; i < 3; ++i)
      if (name == std::array<const char*, 3>{"roll", "pitch", "yaw"}[i]) named[i] = column;
  }
  if (!(named[0] && named[1] && named[2])) return;
  const std::vector<std::size_t> columns{*named[0], *named[1], *named[2]};
  roles.push_back({RotationKind::euler_xyz, columns, angle_unit(table, columns), true,
                   "Roll, Pitch and Yaw are angles of Unreal's rotator"});
}

}  // namespace

std::optional<TimeRole> find_time(const SniffedTable& table) {
  std::optional<TimeRole> best;
  int best_score = -1;
  for (std::size_t column = 0; column < table.columns(); ++column) {
    const auto values = table.numbers(column);
    if (!values) continue;
    const std::vector<double> steps = growing_steps(*values);
    if (steps.empty()) continue;
    const double step = steps[steps.size() / 2];
    const auto unit = unit_of(values->front(), step);
    if (!unit) continue;
    const int score = table.names.empty() ? (column == 0 ? 3 : 0) : time_score(lower(table.names[column]));
    if (score <= best_score || (score == 0 && column > 0)) continue;
    best_score = score;
    TimeRole role;
    role.time.column = table.ref(column);
    role.time.unit = unit->unit;
    role.reason = called(table, column) + " grows like a clock in " + unit->word + " (" +
                  std::to_string(std::llround(1 / (step * unit->seconds))) + " Hz)";
    best = std::move(role);
  }
  if (const auto dates = date_time(table); dates && best_score < 2) return dates;
  return best;
}

std::vector<RotationRole> find_rotations(const SniffedTable& table) {
  std::vector<RotationRole> roles;
  if (table.names.empty()) {
    add_matrices(table, roles);
    if (roles.empty()) add_bare_quaternions(table, roles);
  } else {
    add_named_rotations(table, roles);
  }
  return roles;
}

std::optional<PositionRole> find_position(const SniffedTable& table, const RotationRole& rotation,
                                          std::size_t time_column) {
  const auto taken = [&](std::size_t column) {
    return column == time_column ||
           std::find(rotation.columns.begin(), rotation.columns.end(), column) != rotation.columns.end();
  };
  if (table.names.empty()) {
    const std::size_t first = rotation.columns.front();
    if (first < 3 || taken(first - 1) || taken(first - 2) || taken(first - 3)) return std::nullopt;
    return PositionRole{{first - 3, first - 2, first - 1}, "the three columns before it are the position"};
  }
  std::optional<PositionRole> best;
  int best_score = 0;
  for (const LetterGroup& group : letter_groups(table)) {
    if (group.w || taken(group.xyz[0])) continue;
    if (holds(group.stem, {"rot", "euler", "gaze", "eye", "dir", "vel", "acc", "gyro", "mag", "bias", "scale",
                           "hand", "left", "right", "forward", "quat"}))
      continue;
    int score = 1;
    score += holds(group.stem, {"pos", "trans", "location"}) ? 4 : 0;
    score += holds(group.stem, {"head", "hmd", "helmet", "cam"}) ? 2 : 0;
    if (score <= best_score) continue;
    best_score = score;
    best = PositionRole{{group.xyz[0], group.xyz[1], group.xyz[2]},
                        called(table, group.xyz[0]) + " and its neighbours are the position"};
  }
  return best;
}

std::optional<GazeRole> find_gaze(const SniffedTable& table) {
  std::optional<std::vector<std::size_t>> combined, left, right;
  for (const LetterGroup& group : letter_groups(table)) {
    const std::vector<std::size_t> xyz(group.xyz.begin(), group.xyz.end());
    if (group.w || !holds(group.stem, {"gaze", "eye", "dir", "forward", "g"}) ||
        unit_share(table, xyz) < kUsual)
      continue;
    if (holds(group.stem, {"origin", "point", "pos", "head", "hmd", "helmet", "world"})) continue;
    const bool is_left =
        holds(group.stem, {"left", "_l.", "_l_"}) || group.stem.ends_with("_l") || group.stem == "l";
    const bool is_right =
        holds(group.stem, {"right", "_r.", "_r_"}) || group.stem.ends_with("_r") || group.stem == "r";
    auto& place = is_left ? left : is_right ? right : combined;
    if (!place) place = xyz;
  }
  if (left && right) return GazeRole{{*left, *right}, "a unit vector for each eye is the gaze"};
  if (combined)
    return GazeRole{{*combined}, called(table, combined->front()) + " and its neighbours are the gaze"};
  return std::nullopt;
}

}  // namespace herr
