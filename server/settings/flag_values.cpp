#include "server/settings/flag_values.h"

#include <algorithm>
#include <stdexcept>

#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

// What is no flag of a command, but a field of a file that it reads.
struct FieldElsewhere {
  const char* command;
  const char* flag;
  const char* message;
};
constexpr FieldElsewhere kFieldsElsewhere[]{
    {"herr convert", "--vergence",
     "is no flag but a field of a column map: write \"vergence_m\" there and give --map FILE ('herr convert "
     "--preset NAME --show-map' prints one to begin with)"}};

// Names that people write for a flag which is called otherwise, too far from it for nearest_name().
struct OtherName {
  const char* written;
  const char* flag;
  const char* remark;
};
constexpr OtherName kOtherNames[]{{"--quality-target", "--target-ms", " (with --policy deadline)"}};

// "--target-ms (with --policy deadline)", or the nearest of the known ones, or nothing.
std::string flag_meant(const std::string& name, const std::vector<std::string>& known) {
  for (const OtherName& other : kOtherNames) {
    if (name == other.written && std::find(known.begin(), known.end(), other.flag) != known.end())
      return std::string(other.flag) + other.remark;
  }
  return nearest_name(name, known);
}

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

// A size of the numbers that `text` has: "800x600" for "800 by 600", "800x800" for "800".
std::string size_like(const std::string& text) {
  constexpr const char* kDigits = "0123456789";
  std::vector<std::string> sides;
  for (std::size_t at = text.find_first_of(kDigits); at != std::string::npos;
       at = text.find_first_of(kDigits, at)) {
    const std::size_t end = std::min(text.find_first_not_of(kDigits, at), text.size());
    sides.push_back(text.substr(at, end - at));
    at = end;
  }
  if (sides.empty() || sides.size() > 2) return "800x600";
  return sides.front() + "x" + sides.back();
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
  return parse_real_number(flag, text, -highest, highest);
}

SizeValue parse_size(const std::string& flag, const std::string& text, int highest) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos || cross == 0 || cross + 1 == text.size())
    refuse(flag, text, "a size; write WIDTHxHEIGHT: " + size_like(text));
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
    begin = std::min(text.find_first_not_of(' ', begin), end);  // a blank after a comma
    point[axis] = parse_signed_number(flag, text.substr(begin, end - begin), highest);
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
  for (const FieldElsewhere& field : kFieldsElsewhere) {
    if (name == field.flag && command == field.command) return printable(name) + ": " + field.message;
  }
  std::string message = printable(name) + ": unknown flag";
  if (const std::string meant = flag_meant(name, known); !meant.empty())
    message += "; did you mean " + meant + "?";
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
