#include "sessions/import/text/stamp_text.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>

#include "sessions/format/session_header.h"

namespace herr {
namespace {

constexpr std::int64_t kTicksTo1970 = 621'355'968'000'000'000;
constexpr int kMostDigits = 19;        // of kLastStampNs
constexpr std::size_t kMostText = 64;  // of a number that a tool writes
constexpr int kMostExponent = 40;

int power_of(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::s:
      return 9;
    case TimeUnit::ms:
      return 6;
    case TimeUnit::us:
      return 3;
    default:
      return 0;
  }
}

// A number as digits x 10^power.
struct Decimal {
  std::string digits;
  int power = 0;
};

std::optional<Decimal> parse_decimal(std::string_view text) {
  if (text.empty() || text.size() > kMostText) return std::nullopt;
  if (text.front() == '+') text.remove_prefix(1);
  Decimal number;
  bool point = false;
  std::size_t i = 0;
  for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
    if (text[i] == '.' && !point) {
      point = true;
      continue;
    }
    if (text[i] < '0' || text[i] > '9') return std::nullopt;
    number.digits += text[i];
    number.power -= point ? 1 : 0;
  }
  if (number.digits.empty()) return std::nullopt;
  if (i == text.size()) return number;
  std::string_view exponent_text = text.substr(i + 1);
  if (!exponent_text.empty() && exponent_text.front() == '+') exponent_text.remove_prefix(1);
  int exponent = 0;
  const char* last = exponent_text.data() + exponent_text.size();
  const auto [end, error] = std::from_chars(exponent_text.data(), last, exponent);
  if (error != std::errc() || end != last || exponent < -kMostExponent || exponent > kMostExponent)
    return std::nullopt;
  number.power += exponent;
  return number;
}

std::optional<TimeNs> in_range(std::int64_t ns) {
  return ns >= 0 && ns <= kLastStampNs ? std::optional<TimeNs>(ns) : std::nullopt;
}

std::optional<TimeNs> parse_ticks(std::string_view text) {
  std::int64_t ticks = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ticks);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  const std::int64_t since_1970 = ticks - kTicksTo1970;
  if (since_1970 < 0 || since_1970 > kLastStampNs / 100) return std::nullopt;
  return since_1970 * 100;
}

}  // namespace

std::optional<TimeUnit> time_unit(std::string_view word) {
  if (word == "s") return TimeUnit::s;
  if (word == "ms") return TimeUnit::ms;
  if (word == "us") return TimeUnit::us;
  if (word == "ns") return TimeUnit::ns;
  if (word == "dotnet-ticks") return TimeUnit::ticks;
  return std::nullopt;
}

std::optional<TimeNs> parse_stamp(std::string_view text, TimeUnit unit) {
  if (unit == TimeUnit::ticks) return parse_ticks(text);
  auto number = parse_decimal(text);
  if (!number) return std::nullopt;
  std::string& digits = number->digits;
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
  const int shift = number->power + power_of(unit);
  bool round_up = false;
  if (shift >= 0) {
    if (digits.empty()) return 0;
    digits.append(static_cast<std::size_t>(shift), '0');
  } else {
    const auto cut = static_cast<std::size_t>(-shift);
    if (digits.size() < cut) return 0;  // less than 0.1 ns
    round_up = cut > 0 && digits[digits.size() - cut] >= '5';
    digits.resize(digits.size() - cut);
  }
  if (digits.size() > kMostDigits) return std::nullopt;
  std::int64_t value = 0;
  if (!digits.empty()) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc()) return std::nullopt;
  }
  return in_range(value + (round_up ? 1 : 0));
}

}  // namespace herr
