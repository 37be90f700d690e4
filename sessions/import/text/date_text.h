// Dates as programs write them, to nanoseconds since 1970 (UTC). Before: TimeColumns, file names, EXIF.
// After: time_reader, picture_stamps. Independent of locale and time zone of the machine.
#pragma once

#include <optional>
#include <string_view>

#include "sessions/format/pose.h"

namespace herr {

// `format` as of strptime: %Y %m %d %H %M %S %f (fraction of a second) %z (zone) %I %p %b %y %j and literal text;
// empty: ISO 8601 ("2016-12-13 21:21:13.011", "T", "Z", "+01:00"). A zone in the text wins over `zone_minutes`
// (east of Greenwich); without both the date is taken as UTC, which the caller says. None: it is no such date.
std::optional<TimeNs> parse_date(std::string_view text, std::string_view format, std::optional<int> zone_minutes);

}  // namespace herr
