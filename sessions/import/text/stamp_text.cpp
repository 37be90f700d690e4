#include "sessions/import/text/stamp_text.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include "sessions/format/session_header.h"

namespace herr {
namespace {

__extension__ typedef unsigned __int128 Wide;

constexpr std::uint64_t kTicksTo1970 = 621'355'968'000'000'000;
constexpr std::uint64_t kFiletimeTo1970 = 116'444'736'000'000'000;
constexpr int kMostDigits = 19;        // that any mantissa of 64 bits holds
constexpr std::size_t kMostText = 64;  // of a number that a tool writes
constexpr int kMostExponent = 40;

constexpr std::array<std::pair<const char*, TimeUnit>, 6> kTimeUnits{
    {{"s", TimeUnit::s},
     {"ms", TimeUnit::ms},
     {"us", TimeUnit::us},
     {"ns", TimeUnit::ns},
     {"dotnet-ticks", TimeUnit::dotnet_ticks},
     {"filetime", TimeUnit::filetime}}};

constexpr std::array<std::uint64_t, kMostDigits + 1> kPowersOfTen = [] {
  std::array<std::uint64_t, kMostDigits + 1> powers{1};
  for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * 10;
  return powers;
}();

// A unit is 10^power ns.
constexpr int power_of(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::s:
      return 9;
    case TimeUnit::ms:
      return 6;
    case TimeUnit::us:
      return 3;
    case TimeUnit::ns:
      return 0;
    default:
      return 2;
  }
}

constexpr std::uint64_t ticks_before_1970(TimeUnit unit) {
  if (unit == TimeUnit::dotnet_ticks) return kTicksTo1970;
  return unit == TimeUnit::filetime ? kFiletimeTo1970 : 0;
}

// +-mantissa x 10^power, of the first 19 digits that count; `next` is the one after them.
struct Decimal {
  std::uint64_t mantissa = 0;
  int digits = 0, power = 0, next = 0;
  bool negative = false;
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Eight digits at once: pairs, fours and the whole are summed within one word. False when they are not all
// digits.
bool eight_digits(const char* at, std::uint64_t& value) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t word = 0;
  std::memcpy(&word, at, sizeof word);
  const std::uint64_t digits = word - 0x3030303030303030u;
  if (((word + 0x4646464646464646u) | digits) & 0x8080808080808080u) return false;
  const std::uint64_t pairs = digits * 10 + (digits >> 8);
  const std::uint64_t even = (pairs & 0x000000ff000000ffu) * 0x000f424000000064u;
  const std::uint64_t odd = ((pairs >> 16) & 0x000000ff000000ffu) * 0x0000271000000001u;
  value = (even + odd) >> 32;
  return true;
}

// Takes a run of digits. Behind the point each lowers the power; digits that no longer fit raise it before.
const char* take_digits(const char* at, const char* end, bool fraction, Decimal& number) {
  if (number.mantissa == 0)
    for (; at != end && *at == '0'; ++at) number.power -= fraction;
  std::uint64_t eight = 0;
  while (end - at >= 8 && number.digits + 8 <= kMostDigits && eight_digits(at, eight)) {
    number.mantissa = number.mantissa * 100'000'000 + eight;
    number.digits += 8;
    number.power -= fraction ? 8 : 0;
    at += 8;
  }
  for (; at != end && is_digit(*at); ++at) {
    if (number.digits < kMostDigits) {
      number.mantissa = number.mantissa * 10 + static_cast<std::uint64_t>(*at - '0');
      number.power -= fraction;
    } else {
      if (number.digits == kMostDigits) number.next = *at - '0';
      number.power += !fraction;
    }
    ++number.digits;
  }
  return at;
}

bool take_exponent(const char* at, const char* end, Decimal& number) {
  if (at != end && *at == '+') {
    ++at;
    if (at != end && *at == '-') return false;
  }
  int exponent = 0;
  const auto [last, error] = std::from_chars(at, end, exponent);
  if (error != std::errc() || last != end || exponent < -kMostExponent || exponent > kMostExponent)
    return false;
  number.power += exponent;
  return true;
}

bool read_decimal(std::string_view text, char decimal, Decimal& number) {
  if (text.empty() || text.size() > kMostText) return false;
  const char* at = text.data();
  const char* const end = at + text.size();
  if (*at == '+' || *at == '-') number.negative = *at++ == '-';
  const char* const first = at;
  at = take_digits(at, end, false, number);
  std::ptrdiff_t seen = at - first;
  if (at != end && *at == decimal) {
    const char* const behind = ++at;
    at = take_digits(at, end, true, number);
    seen += at - behind;
  }
  if (seen == 0) return false;
  if (at == end) return true;
  return (*at == 'e' || *at == 'E') && take_exponent(at + 1, end, number);
}

// |number| x 10^power, rounded; none beyond what any stamp may be.
std::optional<Wide> scaled(const Decimal& number, int power) {
  if (number.mantissa == 0) return Wide{0};
  const int shift = number.power + power;
  if (shift > kMostDigits) return std::nullopt;
  if (shift >= 0) {
    const Wide value = Wide{number.mantissa} * kPowersOfTen[static_cast<std::size_t>(shift)];
    const auto next = static_cast<unsigned>(number.next);
    return value +
           (shift == 0 ? (next >= 5 ? 1u : 0u) : next * kPowersOfTen[static_cast<std::size_t>(shift - 1)]);
  }
  if (shift < -kMostDigits) return Wide{0};
  const std::uint64_t divisor = kPowersOfTen[static_cast<std::size_t>(-shift)];
  const std::uint64_t rest = number.mantissa % divisor;
  return Wide{number.mantissa / divisor} + (rest >= divisor - rest ? 1u : 0u);
}

}  // namespace

std::optional<TimeUnit> time_unit(std::string_view word) {
  for (const auto& [name, unit] : kTimeUnits)
    if (word == name) return unit;
  return std::nullopt;
}

const char* word_of(TimeUnit unit) {
  for (const auto& [name, known] : kTimeUnits)
    if (unit == known) return name;
  return "";
}

TimeNs ns_per(TimeUnit unit) {
  return static_cast<TimeNs>(kPowersOfTen[static_cast<std::size_t>(power_of(unit))]);
}

bool counts_from_a_year(TimeUnit unit) {
  return ticks_before_1970(unit) != 0;
}

std::optional<TimeNs> parse_stamp(std::string_view text, TimeUnit unit, char decimal) {
  Decimal number;
  if (!read_decimal(text, decimal, number)) return std::nullopt;
  const std::optional<Wide> size = scaled(number, power_of(unit));
  if (!size) return std::nullopt;
  const Wide epoch = Wide{ticks_before_1970(unit)} * 100;
  if (number.negative && epoch != 0 && *size != 0) return std::nullopt;
  const bool negative = number.negative || *size < epoch;
  const Wide distance = *size < epoch ? epoch - *size : *size - epoch;
  if (distance > Wide{static_cast<std::uint64_t>(kLastStampNs)}) return std::nullopt;
  const auto ns = static_cast<TimeNs>(distance);
  return negative ? -ns : ns;
}

}  // namespace herr
