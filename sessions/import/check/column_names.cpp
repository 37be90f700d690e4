#include "sessions/import/check/column_names.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace herr {
namespace {

bool is_upper(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool is_letter_or_digit(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

std::string lower_text(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

// A new word begins at a capital after a small letter, and at the last of several capitals before one.
bool begins_word(std::string_view text, std::size_t at) {
  if (at == 0 || !is_upper(text[at])) return false;
  return !is_upper(text[at - 1]) ||
         (at + 1 < text.size() && !is_upper(text[at + 1]) && is_letter_or_digit(text[at + 1]));
}

std::string unit_of_word(const std::string& word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 29> kUnitNames{
      {{"s", "s"},         {"sec", "s"},    {"secs", "s"},    {"seconds", "s"},
       {"ms", "ms"},       {"msec", "ms"},  {"millis", "ms"}, {"milliseconds", "ms"},
       {"us", "us"},       {"usec", "us"},  {"micros", "us"}, {"microseconds", "us"},
       {"ns", "ns"},       {"nsec", "ns"},  {"nanos", "ns"},  {"nanoseconds", "ns"},
       {"m", "m"},         {"meters", "m"}, {"metres", "m"},  {"cm", "cm"},
       {"mm", "mm"},       {"deg", "deg"},  {"degs", "deg"},  {"degree", "deg"},
       {"degrees", "deg"}, {"rad", "rad"},  {"rads", "rad"},  {"radians", "rad"},
       {"tan", "tan"}}};
  for (const auto& [name, unit] : kUnitNames)
    if (word == name) return std::string(unit);
  return "";
}

std::optional<std::size_t> column_called(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

bool NameWords::has(std::initializer_list<std::string_view> any) const {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(any.begin(), any.end(), word) != any.end();
  });
}

bool NameWords::has_start(std::initializer_list<std::string_view> any) const {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::any_of(any.begin(), any.end(),
                       [&](std::string_view start) { return word.starts_with(start); });
  });
}

NameWords words_of(std::string_view name) {
  NameWords result;
  std::string word;
  const auto end_word = [&] {
    if (!word.empty()) result.words.push_back(lower_text(word));
    word.clear();
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!is_letter_or_digit(name[i]) || begins_word(name, i)) end_word();
    if (is_letter_or_digit(name[i])) word += name[i];
  }
  end_word();
  // A unit stands last, in brackets or behind the name; a name of one word is no unit.
  const bool bracketed = name.find_first_of("[(") != std::string_view::npos;
  if (result.words.size() > (bracketed ? 0u : 1u)) result.unit = unit_of_word(result.words.back());
  if (!result.unit.empty()) result.words.pop_back();
  if (result.unit.empty() && result.has({"tan", "tangent"})) result.unit = "tan";
  return result;
}

Side side_of(const NameWords& name) {
  if (name.has({"left", "l", "lefteye"})) return Side::left;
  if (name.has({"right", "r", "righteye"})) return Side::right;
  return Side::none;
}

std::vector<LetterGroup> letter_groups(const SniffedTable& table) {
  std::vector<std::string> names;
  for (const std::string& name : table.names) names.push_back(lower_text(name));
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
      std::string stem = table.names[x];
      stem[at] = ' ';
      // "qx": what is left is a word of its own; "rotationx_left": the cut must not join words.
      groups.push_back({words_of(stem), {x, *y, *z}, with('w')});
    }
  return groups;
}

bool is_of_eyes(const NameWords& name) {
  return name.has_start({"gaze", "eye", "look", "pupil", "fixation", "cyclop"}) || name.has({"g"});
}

int head_score(const NameWords& name) {
  if (is_of_eyes(name) ||
      name.has_start({"hand",    "control", "left", "right",  "vel",    "acc",     "gyro",  "mag",   "bias",
                      "omega",   "wrist",   "palm", "object", "target", "tracker", "hit",   "scale", "grav",
                      "angular", "linear",  "ray",  "body",   "chest",  "pelvis",  "origin"}) ||
      side_of(name) != Side::none)
    return -1;
  return name.has_start({"head", "hmd", "helmet", "headset", "device"}) ? 2 : name.has_start({"cam"}) ? 1 : 0;
}

}  // namespace herr
