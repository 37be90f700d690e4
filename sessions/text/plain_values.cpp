#include "sessions/text/plain_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"
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

// A number well written, but for its size.
[[noreturn]] void refuse_size(const std::string& text, const std::string& lowest,
                              const std::string& highest) {
  throw std::invalid_argument("'" + printable(text) + "' is out of range: " + lowest + " to " + highest);
}

std::string_view without_minus(std::string_view text) {
  return text.substr(text.starts_with('-') ? 1 : 0);
}

// The number that other programs read in "+1", "010", "1e2", ".5", "1,5" or " 5", as it is written here.
// None where it is no number, or one out of range.
std::optional<std::string> plain_form(std::string text, double lowest, double highest, bool whole) {
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  if (text.starts_with('+')) text.erase(0, 1);
  if (text.find('.') == std::string::npos && std::count(text.begin(), text.end(), ',') == 1)
    text[text.find(',')] = '.';
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool read = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  if (!read || value < lowest || value > highest || (whole && value != std::floor(value)))
    return std::nullopt;
  return plain_number_text(value + 0.0);  // -0 is 0
}

// "2s", "11ms", "50%".
bool has_unit(std::string_view text) {
  const std::size_t end = text.find_first_not_of("0123456789.");
  return end != std::string_view::npos && end > 0 &&
         std::all_of(text.begin() + static_cast<std::ptrdiff_t>(end), text.end(), [](char c) {
           return (lower_case(c) >= 'a' && lower_case(c) <= 'z') || c == '%' || c == ' ';
         });
}

// What to write instead of `text`; `example` where nothing is known.
std::string advice(const std::string& text, const std::optional<std::string>& plain, const char* example) {
  if (plain) return *plain;
  return has_unit(text) ? kWithoutUnit : example;
}

}  // namespace

std::int64_t whole_number_from(const std::string& text, std::int64_t lowest, std::int64_t highest) {
  std::int64_t value = 0;
  const std::string from = std::to_string(lowest), to = std::to_string(highest);
  if (!is_plain_whole(without_minus(text)))
    refuse(text,
           "a whole number from " + from + " to " + to + "; write " +
               advice(text, plain_form(text, static_cast<double>(lowest), static_cast<double>(highest), true),
                      "plain decimal digits"));
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || value < lowest || value > highest || text.starts_with('-'))
    refuse_size(text, from, to);
  return value;
}

double real_number_from(const std::string& text, double lowest, double highest) {
  double value = 0;
  const std::string from = plain_number_text(lowest), to = plain_number_text(highest);
  if (!is_plain_real(without_minus(text)))
    refuse(text, "a number from " + from + " to " + to + "; write " +
                     advice(text, plain_form(text, lowest, highest, false), "it as 12 or 1.5"));
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value) || value < lowest || value > highest)
    refuse_size(text, from, to);
  if (lowest >= 0 && text.starts_with('-')) refuse_size(text, from, to);
  return value;
}

std::size_t word_from(const std::string& text, const std::vector<std::string>& words) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  const std::string nearest = nearest_name(text, words);
  refuse(text, "one of " + all + (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

std::string plain_number_text(double value) {
  std::array<char, 352> buffer;  // the longest double has 309 digits before the point, or 324 after it
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return std::string(buffer.data(), result.ptr);
}

}  // namespace herr
