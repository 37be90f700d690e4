// What a date format must hold to name one instant (date_text.h).
#include <cstddef>
#include <string>
#include <string_view>

#include "sessions/import/text/date_text.h"

namespace herr {
namespace {

constexpr std::string_view kDateFields = "YymbdjHIpMSfz";

// Letters that say the same in two ways.
constexpr std::string_view kDateRivals[] = {"Yy", "mb", "HI", "mj", "bj", "dj"};

std::string with_percent(char letter) {
  return std::string("%") + letter;
}

class SeenFields {
 public:
  bool has(char letter) const { return letters_.find(letter) != std::string::npos; }
  bool any(std::string_view letters) const { return letters_.find_first_of(letters) != std::string::npos; }
  void add(char letter) { letters_ += letter; }

 private:
  std::string letters_;
};

std::optional<DateFormatFault> fault_of_day(const SeenFields& seen) {
  if (!seen.any("Yymbdj")) return std::nullopt;
  const bool whole = seen.any("Yy") && (seen.has('j') || (seen.any("mb") && seen.has('d')));
  if (!whole)
    return DateFormatFault{"names no whole day",
                           "give %Y, %m and %d (or %y, %b, %j), or none of them for a time of day"};
  if (!seen.any("HI")) return DateFormatFault{"names a day without an hour", "give %H"};
  return std::nullopt;
}

std::optional<DateFormatFault> fault_of_time(const SeenFields& seen) {
  if (!seen.any("HIMS")) return DateFormatFault{"names no time", "give %H, %M and %S, such as %H:%M:%S.%f"};
  if (seen.has('I') != seen.has('p'))
    return seen.has('I')
               ? DateFormatFault{"has %I without %p", "give %p (AM or PM), or %H for hours up to 23"}
               : DateFormatFault{"has %p without %I", "write %I for hours up to 12"};
  if (seen.any("HI") && seen.has('S') && !seen.has('M'))
    return DateFormatFault{"has hours and seconds without minutes", "give %M"};
  if (seen.has('f') && !seen.has('S'))
    return DateFormatFault{"has %f without %S", "%f is the fraction of a second: give %S before it"};
  return std::nullopt;
}

}  // namespace

TimeNs date_period_ns(std::string_view format) {
  SeenFields seen;
  for (std::size_t i = 0; i + 1 < format.size(); ++i)
    if (format[i] == '%') seen.add(format[++i]);
  constexpr TimeNs kMinute = 60'000'000'000;
  if (format.empty() || seen.any("Yymbdj")) return 0;
  return seen.any("HI") ? 24 * 60 * kMinute : seen.has('M') ? 60 * kMinute : kMinute;
}

std::optional<DateFormatFault> date_format_fault(std::string_view format) {
  if (format.empty()) return std::nullopt;
  SeenFields seen;
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '%') continue;
    if (++i == format.size()) return DateFormatFault{"ends with a single %", "write %% for the sign itself"};
    if (format[i] == '%') continue;
    if (kDateFields.find(format[i]) == std::string_view::npos)
      return DateFormatFault{"has " + with_percent(format[i]),
                             "write %Y %y %m %b %d %j %H %I %p %M %S %f %z, %% and literal text"};
    if (seen.has(format[i]))
      return DateFormatFault{"has " + with_percent(format[i]) + " twice", "remove one"};
    seen.add(format[i]);
  }
  for (const std::string_view rivals : kDateRivals)
    if (seen.has(rivals[0]) && seen.has(rivals[1]))
      return DateFormatFault{"has both " + with_percent(rivals[0]) + " and " + with_percent(rivals[1]),
                             "keep one"};
  if (const auto fault = fault_of_day(seen)) return fault;
  return fault_of_time(seen);
}

}  // namespace herr
