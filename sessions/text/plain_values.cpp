#include "sessions/text/plain_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"
#include "sessions/text/letters.h"

namespace herr {
namespace {

// A leading zero only when it is the whole text: "010" is 8 to some tools and 10 to others.
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

[[noreturn]] void refuse(const std::string& text, const std::string& wanted) {
  throw std::invalid_argument("'" + printable(text) + "' is not " + wanted);
}

}  // namespace

std::int64_t whole_number_from(const std::string& text, std::int64_t lowest, std::int64_t highest) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole_text = error == std::errc() && end == text.data() + text.size();
  if (!is_plain_whole(text) || !whole_text || value < lowest || value > highest) {
    refuse(text, "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest) +
                     "; write plain decimal digits");
  }
  return value;
}

double real_number_from(const std::string& text, double lowest, double highest) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole_text = error == std::errc() && end == text.data() + text.size();
  const std::size_t sign = lowest < 0 && text.starts_with('-') ? 1 : 0;
  if (!is_plain_real(text.substr(sign)) || !whole_text || !std::isfinite(value) || value < lowest ||
      value > highest) {
    refuse(text, "a number from " + plain_number_text(lowest) + " to " + plain_number_text(highest) +
                     "; write it as 12 or 1.5");
  }
  return value;
}

std::size_t word_from(const std::string& text, const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  refuse(text, "one of " + all + "; did you mean " + nearest_name(text, words) + "?");
}

std::string plain_number_text(double value) {
  std::array<char, 352> buffer;  // the longest double has 309 digits before the point, or 324 after it
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return std::string(buffer.data(), result.ptr);
}

}  // namespace herr
