#include "sessions/import/tables/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <system_error>

#include "sessions/streams/field_text.h"
#include "sessions/text/letters.h"

namespace herr {
namespace {

constexpr std::uint64_t kExactMantissa = std::uint64_t{1} << 53;
constexpr int kExactPower = 22;
constexpr std::array<double, kExactPower + 1> kPowersOfTen{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                           1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                           1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::size_t kMostNumberBytes = 400;

bool same_word(std::string_view text, std::string_view lower_word) {
  return std::equal(text.begin(), text.end(), lower_word.begin(), lower_word.end(),
                    [](char a, char b) { return lower_case(a) == b; });
}

// `text` has been found to be a number; `negative_power`: one that may be too small for a double.
std::optional<double> rounded_number(std::string_view text, char decimal, bool negative_power) {
  std::array<char, kMostNumberBytes> bytes;
  if (text.starts_with('+')) text.remove_prefix(1);
  if (text.size() > bytes.size()) return std::nullopt;
  std::replace_copy(text.begin(), text.end(), bytes.begin(), decimal, '.');
  double value = 0;
  const auto [end, error] = std::from_chars(bytes.data(), bytes.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && negative_power) return 0.0;
  if (error != std::errc() || end != bytes.data() + text.size()) return std::nullopt;
  return value;
}

// Microsoft's words begin with a digit: 1.#QNAN, 1.#IND00.
bool is_microsoft_nan(std::string_view unsigned_text) {
  return unsigned_text.starts_with("1.#") && !unsigned_text.starts_with("1.#INF");
}

bool is_word_for_none(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  if (text.empty()) return false;
  if (is_digit(text[0])) return is_microsoft_nan(text);
  if (text.size() >= 3 && same_word(text.substr(0, 3), "nan") && (text.size() == 3 || text[3] == '('))
    return true;
  return same_word(text, "null") || same_word(text, "none") || same_word(text, "n/a") ||
         same_word(text, "na");
}

// Commas between digits that may be decimal signs: "0,1", "(0,1, 1,6)", but not "(0.1,1.6)" nor "(1,2)".
bool may_be_decimal_commas(std::string_view text, bool bracketed) {
  if (text.find('.') != std::string_view::npos) return false;
  bool tight = false;
  for (std::size_t comma = text.find(','); comma != std::string_view::npos; comma = text.find(',', comma + 1))
    tight = tight || (comma + 1 < text.size() && is_digit(text[comma + 1]));
  return tight && (!bracketed || text.find_first_of("; \t") != std::string_view::npos);
}

}  // namespace

std::optional<double> parse_number(std::string_view text, char decimal) {
  const char* at = text.data();
  const char* const end = at + text.size();
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  std::uint64_t mantissa = 0;  // wraps where there are too many digits; it is not used then
  const char* const whole = at;
  while (at != end && is_digit(*at)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*at++ - '0');
  auto digits = at - whole;
  std::int64_t power = 0;
  if (at != end && *at == decimal) {
    const char* const fraction = ++at;
    while (at != end && is_digit(*at)) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*at++ - '0');
    power = fraction - at;
    digits += at - fraction;
  }
  if (digits == 0) return std::nullopt;
  if (at != end && lower_case(*at) == 'e') {
    int exponent = 0;
    if (++at != end && *at == '+' && end - at > 1 && at[1] != '-') ++at;
    const auto [after, error] = std::from_chars(at, end, exponent);
    if (after == at) return std::nullopt;
    const bool below = *at == '-';
    power += error == std::errc() ? exponent : (below ? -1'000'000 : 1'000'000);
    at = after;
  }
  if (at != end) return std::nullopt;
  // Both are exact as doubles, and so one operation rounds once.
  if (digits <= 19 && mantissa <= kExactMantissa && power >= -kExactPower && power <= kExactPower) {
    const double exact = static_cast<double>(mantissa);
    const double value = power < 0 ? exact / kPowersOfTen[static_cast<std::size_t>(-power)]
                                   : exact * kPowersOfTen[static_cast<std::size_t>(power)];
    return negative ? -value : value;
  }
  return rounded_number(text, decimal, power < 0);
}

bool stands_for_no_number(std::string_view text) {
  if (text.empty()) return true;
  if (is_digit(text[0]) && !text.starts_with("1.#")) return false;
  if (text.size() > 1 && text[0] == '-' && is_digit(text[1]) && !text.starts_with("-1.#")) return false;
  if (is_word_for_none(text)) return true;
  std::string_view rest = without_brackets(text);
  if (rest.size() == text.size() && rest.find_first_of(",; \t") == std::string_view::npos) return false;
  if (trimmed(rest).empty()) return true;
  bool any = false;
  for (std::string_view part = take_number(rest, '.'); !part.empty(); part = take_number(rest, '.')) {
    const bool none = is_word_for_none(part);
    if (!none && !parse_number(part, '.')) return false;
    any = any || none;
  }
  return any;
}

std::string_view without_brackets(std::string_view text) {
  if (text.size() < 2) return text;
  const std::string_view ends{"()[]{}"};
  const std::size_t open = ends.find(text.front());
  if (open == std::string_view::npos || open % 2 != 0 || text.back() != ends[open + 1]) return text;
  return text.substr(1, text.size() - 2);
}

std::string_view take_number(std::string_view& rest, char decimal) {
  const std::string_view parting = decimal == ',' ? "; \t" : ",; \t";
  const std::size_t begin = rest.find_first_not_of(",; \t");
  if (begin == std::string_view::npos) return rest = {};
  rest.remove_prefix(begin);
  std::string_view part = rest.substr(0, rest.find_first_of(parting));
  rest.remove_prefix(part.size());
  if (part.ends_with(',')) part.remove_suffix(1);
  return part;
}

int number_evidence(std::string_view text, char decimal) {
  if (stands_for_no_number(text) || parse_number(text, decimal)) return 2;
  std::string_view rest = without_brackets(text);
  const bool bracketed = rest.size() < text.size();
  if (rest.find_first_of(",; \t") == std::string_view::npos) return 0;
  if (decimal == '.' && may_be_decimal_commas(rest, bracketed)) return 0;
  for (std::string_view part = take_number(rest, decimal); !part.empty(); part = take_number(rest, decimal))
    if (!parse_number(part, decimal)) return 0;
  return bracketed ? 2 : 1;
}

}  // namespace herr
