// Dates as programs write them, to nanoseconds since 1970 (UTC). Before: TimeColumns, file names, EXIF.
// After: time_reader, picture_stamps. Independent of locale and time zone of the machine; allocates nothing.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sessions/format/pose.h"

namespace herr {

// `format` as of strptime: %Y %y %m %b %d %j %H %I %p %M %S, %f (fraction of a second), %z (zone), %% and
// literal text; empty: ISO 8601 ("2016-12-13 21:21:13.011", "T", "Z", "+01:00"; also with slashes, without
// separators, or with a comma before the fraction). A zone in the text wins over `zone_minutes` (east of
// Greenwich); without both the date is taken as UTC, which the caller says. A format that names no day gives
// the time since midnight; after
// "." or "," a fraction may be absent. None: it is no such date, or beyond +-kLastStampNs. `format` is sound.
std::optional<TimeNs> parse_date(std::string_view text, std::string_view format,
                                 std::optional<int> zone_minutes);

// Whether this date names its zone itself.
bool date_names_zone(std::string_view text, std::string_view format);

// After how long the dates of a format start again: a day where it names none, an hour where it names no hour
// either, a minute without both; 0: never.
TimeNs date_period_ns(std::string_view format);

// What is wrong with a format ("has %Q"), with what it should be; empty: it is sound.
struct DateFormatFault {
  std::string problem, remedy;
};
std::optional<DateFormatFault> date_format_fault(std::string_view format);

// "Z", "UTC", "GMT", "+01:00", "+0100", "+01": minutes east of Greenwich, at most 14 hours.
std::optional<int> parse_zone(std::string_view text);

}  // namespace herr
