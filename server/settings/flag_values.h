// Strict readers for the values of flags. The command line library takes "010" for 8, "nan" and
// "inf" for numbers; here only plain decimal numbers pass. Every reader throws UsageError with one
// line that names the flag.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/process/exit_code.h"

namespace herr {

// Digits only, no sign, no leading zero.
std::int64_t parse_whole_number(const std::string& flag, const std::string& text, std::int64_t lowest,
                                std::int64_t highest);
// Digits with at most one decimal point: no sign, no exponent, no leading zero before another digit.
double parse_real_number(const std::string& flag, const std::string& text, double lowest, double highest);
// As that, within [-highest, highest]: a minus sign may stand before it.
double parse_signed_number(const std::string& flag, const std::string& text, double highest);

struct SizeValue {
  int width = 0, height = 0;
};
// "WIDTHxHEIGHT", each within [1, highest].
SizeValue parse_size(const std::string& flag, const std::string& text, int highest);

// "X,Y,Z": three numbers, each within [-highest, highest]; a minus sign may stand before each.
glm::dvec3 parse_point(const std::string& flag, const std::string& text, double highest);

// `text` itself; throws UsageError that names `what` when it is empty (a script's variable that was not set).
const std::string& non_empty(const std::string& what, const std::string& text);

// "a, b, c", for help and messages.
std::string joined(const std::vector<std::string>& words);

// The index of `text` among the words; an unknown word names the nearest one.
std::size_t parse_word(const std::string& flag, const std::string& text,
                       const std::vector<std::string>& words);

// "--sceen: unknown flag; did you mean --scene? ..." - one line for a flag that no command knows.
std::string unknown_flag_message(const std::string& flag, const std::vector<std::string>& known,
                                 const std::string& command);

}  // namespace herr
