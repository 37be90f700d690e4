// Values as people write them in settings, read strictly. Libraries take "010" for 8, and "nan" and "inf" for
// numbers; here they are mistakes. All readers throw std::invalid_argument, with what was wanted and what to
// do: "'010' is not a whole number from 1 to 64; write 10", "'two' is not a whole number from 1 to 64; write
// plain decimal digits", "'65' is out of range: 1 to 64".
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace herr {

// What the advice says of "2s".
inline constexpr const char* kWithoutUnit = "the number alone, without a unit";

// Digits only: no sign, no leading zero.
std::int64_t whole_number_from(const std::string& text, std::int64_t lowest, std::int64_t highest);
// Digits with at most one decimal point: no sign, no exponent, no leading zero before another digit.
double real_number_from(const std::string& text, double lowest, double highest);

// The index of `text` among the words; an unknown one names the nearest.
std::size_t word_from(const std::string& text, const std::vector<std::string>& words);

// The shortest text in digits that reads back as the same double, with a minus sign where it is negative.
// `value` is finite.
std::string plain_number_text(double value);

}  // namespace herr
