#include "sessions/import/rows/told_columns.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "sessions/import/text/stamp_text.h"
#include "sessions/streams/field_text.h"
#include "sessions/text/letters.h"

namespace herr {
namespace {

using Kind = ToldColumn::Kind;

constexpr std::string_view kLetters = "wxyz";

constexpr std::pair<std::string_view, Kind> kBeginnings[] = {
    {"time", Kind::time},        {"stamp", Kind::time},        {"position", Kind::position},
    {"trans", Kind::position},   {"location", Kind::position}, {"quat", Kind::rotation},
    {"rot", Kind::rotation},     {"orient", Kind::rotation},   {"roll", Kind::angle},
    {"pitch", Kind::angle},      {"yaw", Kind::angle},         {"vel", Kind::velocity},
    {"angular", Kind::velocity}, {"accel", Kind::velocity},    {"gyr", Kind::velocity},
};
constexpr std::pair<std::string_view, Kind> kWords[] = {
    {"pos", Kind::position}, {"p", Kind::position}, {"q", Kind::rotation}};
constexpr std::pair<char, Kind> kPrefixes[] = {{'p', Kind::position},
                                               {'t', Kind::position},
                                               {'q', Kind::rotation},
                                               {'r', Kind::rotation},
                                               {'v', Kind::velocity}};

constexpr std::pair<std::string_view, std::string_view> kUnits[] = {
    {"s", "s"},           {"sec", "s"}, {"secs", "s"},  {"seconds", "s"},       {"ms", "ms"},
    {"msec", "ms"},       {"us", "us"}, {"usec", "us"}, {"ns", "ns"},           {"nsec", "ns"},
    {"m", "m"},           {"cm", "cm"}, {"mm", "mm"},   {"milliseconds", "ms"}, {"microseconds", "us"},
    {"nanoseconds", "ns"}};

bool is_word(char c) {
  return is_digit(c) || (lower_case(c) >= 'a' && lower_case(c) <= 'z');
}

// Takes the first word off a name, in small letters: "RotationX" holds two.
std::string take_word(std::string_view& name) {
  while (!name.empty() && !is_word(name[0])) name.remove_prefix(1);
  std::string word;
  for (bool small_before = false; !name.empty() && is_word(name[0]); name.remove_prefix(1)) {
    const char c = name[0];
    if (is_capital(c) && small_before) break;
    small_before = !is_capital(c);
    word += lower_case(c);
  }
  return word;
}

void read_word(const std::string& word, ToldColumn& told) {
  told.unit = {};
  for (const auto& [spelling, unit] : kUnits)
    if (word == spelling) told.unit = unit;
  for (const auto& [beginning, kind] : kBeginnings)
    if (word.starts_with(beginning)) told.kind = kind;
  for (const auto& [known, kind] : kWords)
    if (word == known) told.kind = kind;
  if (word.empty() || word.size() > 2 || kLetters.find(word.back()) == std::string_view::npos) return;
  told.letter = word.back();
  for (const auto& [prefix, kind] : kPrefixes)
    if (word.size() == 2 && word[0] == prefix) told.kind = kind;
}

const char* words_of(Kind kind) {
  switch (kind) {
    case Kind::time:
      return "the time";
    case Kind::position:
      return "the position";
    default:
      return "the rotation";
  }
}

// Compares what columns are told to be with what a map takes them for.
class Comparison {
 public:
  explicit Comparison(const RowSource& rows) : rows_(rows) {}

  // `letter` 0: any. `unit` empty: any.
  void compare(const ColumnRef& column, Kind kind, char letter, std::string_view unit = {}) {
    const std::string_view name = rows_.told_name(column.number);
    if (found_ || name.empty()) return;
    const ToldColumn told = told_column(name);
    const bool lettered = letter == 0 || told.letter == 0 || told.letter == letter;
    const bool in_unit = unit.empty() || told.unit.empty() || told.unit == unit;
    if (lettered && in_unit && goes_with(told, kind)) return;
    std::string taken = std::string("takes it for ") + (letter != 0 ? std::string(1, letter) + " of " : "");
    taken += kind == Kind::unknown ? "a direction" : words_of(kind);
    if (!in_unit) taken += " in " + std::string(unit);
    found_ = InputError(
        rows_.path(), rows_.told_line(),
        "calls column " + std::to_string(column.number) + " " + in_quotes(name) + ", and the format " + taken,
        "give a preset or a map with the columns in this order ('herr convert --check FILE' "
        "proposes one); where the line itself is wrong, remove it");
  }

  void compare(const ColumnGroup& group, Kind kind, std::string_view letters, std::string_view unit = {}) {
    const bool each = group.columns.size() == letters.size();
    for (std::size_t i = 0; i < group.columns.size(); ++i)
      compare(group.columns[i], kind, each ? letters[i] : '\0', unit);
  }

  std::optional<InputError> found() { return std::move(found_); }

 private:
  static bool goes_with(const ToldColumn& told, Kind kind) {
    if (kind == Kind::time)
      return told.letter == 0 && (told.kind == Kind::unknown || told.kind == Kind::time);
    if (kind == Kind::unknown || told.kind == Kind::unknown) return true;
    return told.kind == kind || (kind == Kind::angle && told.kind == Kind::rotation);
  }

  const RowSource& rows_;
  std::optional<InputError> found_;
};

void compare_time(const TimeColumns& time, Comparison& comparison) {
  if (time.kind == TimeColumns::Kind::rate) return;
  const bool unit =
      time.kind == TimeColumns::Kind::number && time.scale == 1 && !counts_from_a_year(time.unit);
  comparison.compare(time.column, Kind::time, '\0', unit ? word_of(time.unit) : "");
}

std::string_view length_unit(double metres) {
  constexpr std::pair<std::string_view, double> kLengths[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}};
  for (const auto& [word, length] : kLengths)
    if (std::abs(metres / length - 1) < 1e-9) return word;
  return {};
}

}  // namespace

ToldColumn told_column(std::string_view name) {
  ToldColumn told;
  for (std::string word = take_word(name); !word.empty(); word = take_word(name)) read_word(word, told);
  return told;
}

std::optional<InputError> contradicted(const RowSource& rows, const HeadColumns& columns) {
  Comparison comparison(rows);
  compare_time(columns.time, comparison);
  if (columns.position)
    comparison.compare(*columns.position, Kind::position, "xyz", length_unit(columns.metres_per_unit));
  switch (columns.rotation_kind) {
    case RotationKind::quaternion_xyzw:
      comparison.compare(columns.rotation, Kind::rotation, "xyzw");
      break;
    case RotationKind::quaternion_wxyz:
      comparison.compare(columns.rotation, Kind::rotation, "wxyz");
      break;
    case RotationKind::quaternion_xyz:
    case RotationKind::rotation_vector:
      comparison.compare(columns.rotation, Kind::rotation, "xyz");
      break;
    case RotationKind::euler_xyz:
      comparison.compare(columns.rotation, Kind::angle, "xyz");
      break;
    default:
      break;  // matrices, directions: their names follow no habit
  }
  return comparison.found();
}

std::optional<InputError> contradicted(const RowSource& rows, const GazeColumns& columns) {
  Comparison comparison(rows);
  compare_time(columns.time, comparison);
  for (const DirectionColumns& ray : columns.rays)
    for (const auto* group : {&ray.vector, &ray.point, &ray.origin})
      if (*group) comparison.compare(**group, Kind::unknown, "xyz");
  return comparison.found();
}

}  // namespace herr
