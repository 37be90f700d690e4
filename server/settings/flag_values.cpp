#include "server/settings/flag_values.h"

#include <algorithm>
#include <stdexcept>

#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

[[noreturn]] void refuse(const std::string& flag, const std::string& text, const std::string& wanted) {
  throw UsageError(flag + ": '" + printable(text) + "' is not " + wanted);
}

// What a reader says, with the name of the flag before it.
template <typename Reader>
auto read_for(const std::string& flag, Reader&& reader) {
  try {
    return reader();
  } catch (const std::invalid_argument& error) {
    throw UsageError(flag + ": " + error.what());
  }
}

}  // namespace

std::int64_t parse_whole_number(const std::string& flag, const std::string& text, std::int64_t lowest,
                                std::int64_t highest) {
  return read_for(flag, [&] { return whole_number_from(text, lowest, highest); });
}

double parse_real_number(const std::string& flag, const std::string& text, double lowest, double highest) {
  return read_for(flag, [&] { return real_number_from(text, lowest, highest); });
}

double parse_signed_number(const std::string& flag, const std::string& text, double highest) {
  const bool minus = text.starts_with('-');
  try {
    const double size = real_number_from(minus ? text.substr(1) : text, 0, highest);
    return minus ? -size : size;
  } catch (const std::invalid_argument&) {
    refuse(flag, text, "a number from -" + shortest_text(highest) + " to " + shortest_text(highest));
  }
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
    try {
      const double size = real_number_from(part.substr(negative ? 1 : 0), 0, highest);
      point[axis] = negative ? -size : size;
    } catch (const std::invalid_argument&) {
      const std::string limit = plain_number_text(highest);
      refuse(flag, part, "a number from -" + limit + " to " + limit + "; write X,Y,Z as 0,1.5,-3.7");
    }
    begin = end + 1;
  }
  return point;
}

std::size_t parse_word(const std::string& flag, const std::string& text,
                       const std::vector<std::string>& words) {
  return read_for(flag, [&] { return word_from(text, words); });
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

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace herr
