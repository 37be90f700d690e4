// Time stamps as foreign files write them, to integer nanoseconds without a detour over floating point: 1.7e9
// seconds as a double are only known to 240 ns.
// Before: a field of a row. After: time_reader; names of pictures.
#pragma once

#include <optional>
#include <string_view>

#include "sessions/format/pose.h"

namespace herr {

enum class TimeUnit {
  s,
  ms,
  us,
  ns,
  dotnet_ticks,  // 100 ns since 0001-01-01 (.NET's DateTime.Ticks); becomes time since 1970
  filetime       // 100 ns since 1601-01-01 (Windows FILETIME); becomes time since 1970
};

// The unit of a word as it stands in maps ("s", "ms", "us", "ns", "dotnet-ticks", "filetime").
std::optional<TimeUnit> time_unit(std::string_view word);
const char* word_of(TimeUnit unit);

// How long one is.
TimeNs ns_per(TimeUnit unit);
// Whether it counts from a year of its own, not from the zero of the file's clock.
bool counts_from_a_year(TimeUnit unit);

// Decimal digits with optional sign, `decimal` point and exponent, rounded to the nearest nanosecond (halves
// away from zero). None when it is no such number or lies beyond +-kLastStampNs. Allocates nothing.
std::optional<TimeNs> parse_stamp(std::string_view text, TimeUnit unit, char decimal = '.');

}  // namespace herr
