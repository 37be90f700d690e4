#include "server/settings/flag_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Digits only; a leading zero only when it is the whole text: "010" is 8 to some tools and 10 to others.
bool is_plain_whole(std::string_view text) {
  if (text.empty() || !std::all_of(text.begin(), text.end(), is_digit)) return false;
  return text.size() == 1 || text.front() != '0';
}

bool is_plain_real(std::string_view text) {
  const std::size_t point = text.find('.');
  if (point == std::string_view::npos) return is_plain_whole(text);
  const std::string_view fraction = text.substr(point + 1);
  return is_plain_whole(text.substr(0, point)) && !fraction.empty() &&
         std::all_of(fraction.begin(), fraction.end(), is_digit);
}

[[noreturn]] void refuse(const std::string& flag, const std::string& text, const std::string& wanted) {
  throw UsageError(flag + ": '" + printable(text) + "' is not " + wanted);
}

}  // namespace

std::int64_t parse_whole_number(const std::string& flag, const std::string& text, std::int64_t lowest,
                                std::int64_t highest) {
  const std::string wanted = "a whole number from " + std::to_string(lowest) + " to " +
                             std::to_string(highest) + "; write plain decimal digits";
  std::int64_t value = 0;
  if (!is_plain_whole(text)) refuse(flag, text, wanted);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < lowest || value > highest) {
    refuse(flag, text, wanted);
  }
  return value;
}

double parse_real_number(const std::string& flag, const std::string& text, double lowest, double highest) {
  const std::string wanted =
      "a number from " + shortest_text(lowest) + " to " + shortest_text(highest) + "; write it as 12 or 1.5";
  double value = 0;
  if (!is_plain_real(text)) refuse(flag, text, wanted);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole_text = error == std::errc() && end == text.data() + text.size();
  if (!whole_text || !std::isfinite(value) || value < lowest || value > highest) refuse(flag, text, wanted);
  return value;
}

SizeValue parse_size(const std::string& flag, const std::string& text, int highest) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) refuse(flag, text, "a size; write WIDTHxHEIGHT, for example 1576x768");
  const auto side = [&](const std::string& part) {
    return static_cast<int>(parse_whole_number(flag, part, 1, highest));
  };
  return {side(text.substr(0, cross)), side(text.substr(cross + 1))};
}

glm::dvec3 parse_point(const std::string& flag, const std::string& text, double highest) {
  if (std::count(text.begin(), text.end(), ',') != 2)
    refuse(flag, text, "a point; write X,Y,Z in metres, for example 0,1.5,-3.7");
  glm::dvec3 point(0.0);
  std::size_t begin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const bool negative = part.starts_with('-');
    const std::string wanted = "a number from -" + shortest_text(highest) + " to " + shortest_text(highest) +
                               "; write X,Y,Z as 0,1.5,-3.7";
    if (!is_plain_real(part.substr(negative ? 1 : 0))) refuse(flag, part, wanted);
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), point[axis]);
    const bool whole_text = error == std::errc() && stop == part.data() + part.size();
    if (!whole_text || !(std::abs(point[axis]) <= highest)) refuse(flag, part, wanted);
    begin = end + 1;
  }
  return point;
}

std::size_t parse_word(const std::string& flag, const std::string& text,
                       const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  refuse(flag, text, "one of " + all + "; did you mean " + nearest_name(text, words) + "?");
}

std::string unknown_flag_message(const std::string& flag, const std::vector<std::string>& known,
                                 const std::string& command) {
  const std::string name = flag.substr(0, flag.find('='));
  std::string message = printable(name) + ": unknown flag";
  if (!known.empty()) message += "; did you mean " + nearest_name(name, known) + "?";
  return message + " ('" + command + " --help' lists all)";
}

const std::string& non_empty(const std::string& what, const std::string& text) {
  if (text.empty()) throw UsageError(what + ": the path is empty; give a file or folder");
  return text;
}

}  // namespace herr
