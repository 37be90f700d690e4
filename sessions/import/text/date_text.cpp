#include "sessions/import/text/date_text.h"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "sessions/format/session_header.h"
#include "sessions/text/letters.h"

namespace herr {
namespace {

constexpr std::array<std::string_view, 12> kMonths{"january",   "february", "march",    "april",
                                                   "may",       "june",     "july",     "august",
                                                   "september", "october",  "november", "december"};
constexpr int kMostZoneMinutes = 14 * 60;
constexpr int kFractionDigits = 9;

struct DateParts {
  int year = 1970, month = 1, day = 1, day_of_year = 0;
  int hour = 0, minute = 0, second = 0;
  std::optional<bool> afternoon;  // of a clock of twelve hours
  TimeNs fraction_ns = 0;
  std::optional<int> zone_minutes;
};

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

// Takes pieces off the front of a text; each says whether it was there.
class DateScanner {
 public:
  explicit DateScanner(std::string_view text) : rest_(text) {}
  bool done() const { return rest_.empty(); }
  bool starts_digit() const { return !rest_.empty() && is_digit(rest_.front()); }

  bool take(char c) {
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  bool take_blanks() {
    const std::size_t before = rest_.size();
    while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
    return rest_.size() < before;
  }
  bool take_word(std::string_view small) {
    if (rest_.size() < small.size()) return false;
    for (std::size_t i = 0; i < small.size(); ++i)
      if (lower_case(rest_[i]) != small[i]) return false;
    rest_.remove_prefix(small.size());
    return true;
  }
  bool take_number(std::size_t fewest, std::size_t most, int& value) {
    std::size_t digits = 0;
    value = 0;
    for (; digits < most && starts_digit(); ++digits, rest_.remove_prefix(1))
      value = value * 10 + rest_.front() - '0';
    return digits >= fewest;
  }
  bool take_fraction(TimeNs& ns) {
    int digits = 0;
    ns = 0;
    for (; starts_digit(); ++digits, rest_.remove_prefix(1)) {
      if (digits < kFractionDigits) ns = ns * 10 + (rest_.front() - '0');
      if (digits == kFractionDigits && rest_.front() >= '5') ++ns;
    }
    for (int i = digits; i < kFractionDigits; ++i) ns *= 10;
    return digits > 0;
  }
  bool take_month(int& month) {
    for (std::size_t i = 0; i < kMonths.size(); ++i)
      if (take_word(kMonths[i]) || take_word(kMonths[i].substr(0, 3))) {
        month = static_cast<int>(i) + 1;
        return true;
      }
    return false;
  }
  bool take_zone(std::optional<int>& minutes) {
    minutes = 0;
    if (take_word("z") || take_word("utc") || take_word("gmt")) return true;
    const bool west = take('-');
    int hours = 0, rest = 0;
    if (!west && !take('+')) return false;
    if (!take_number(2, 2, hours)) return false;
    if ((take(':') || starts_digit()) && !take_number(2, 2, rest)) return false;
    minutes = (west ? -1 : 1) * (hours * 60 + rest);
    return rest < 60 && hours * 60 + rest <= kMostZoneMinutes;
  }

 private:
  std::string_view rest_;
};

bool scan_iso(DateScanner& text, DateParts& date) {
  if (!text.take_number(4, 4, date.year)) return false;
  const char separator = text.take('-') ? '-' : text.take('/') ? '/' : '\0';
  const std::size_t fewest = separator == '\0' ? 2 : 1;
  if (!text.take_number(fewest, 2, date.month)) return false;
  if (separator != '\0' && !text.take(separator)) return false;
  if (!text.take_number(fewest, 2, date.day)) return false;
  if (!text.take_word("t") && !text.take_blanks()) return false;
  if (!text.take_number(1, 2, date.hour)) return false;
  const bool colons = text.take(':');
  if (!text.take_number(2, 2, date.minute)) return false;
  if (colons ? text.take(':') : text.starts_digit()) {
    if (!text.take_number(2, 2, date.second)) return false;
    if ((text.take('.') || text.take(',')) && !text.take_fraction(date.fraction_ns)) return false;
  }
  text.take_blanks();
  return text.done() || text.take_zone(date.zone_minutes);
}

bool scan_field(char field, DateScanner& text, DateParts& date) {
  switch (field) {
    case 'Y':
      return text.take_number(4, 4, date.year);
    case 'y':
      if (!text.take_number(2, 2, date.year)) return false;
      date.year += date.year < 69 ? 2000 : 1900;
      return true;
    case 'm':
      return text.take_number(1, 2, date.month);
    case 'b':
      return text.take_month(date.month);
    case 'd':
      return text.take_number(1, 2, date.day);
    case 'j':
      return text.take_number(1, 3, date.day_of_year) && date.day_of_year > 0;
    case 'H':
      return text.take_number(1, 2, date.hour);
    case 'I':
      return text.take_number(1, 2, date.hour) && date.hour >= 1 && date.hour <= 12;
    case 'M':
      return text.take_number(1, 2, date.minute);
    case 'S':
      return text.take_number(1, 2, date.second);
    case 'f':
      return text.take_fraction(date.fraction_ns);
    case 'p':
      date.afternoon = text.take_word("pm");
      return *date.afternoon || text.take_word("am");
    case 'z':
      return text.take_zone(date.zone_minutes);
    default:
      return field == '%' && text.take('%');
  }
}

bool scan_format(DateScanner& text, std::string_view format, DateParts& date) {
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] == '%') {
      if (++i == format.size() || !scan_field(format[i], text, date)) return false;
    } else if (is_blank(format[i])) {
      if (!text.take_blanks() && (i == 0 || !is_blank(format[i - 1]))) return false;
    } else if (!text.take(format[i])) {
      // Programs leave a fraction of zero out.
      const bool point = format[i] == '.' || format[i] == ',';
      if (!point || format.substr(i + 1, 2) != "%f") return false;
      i += 2;
    }
  }
  return text.done();
}

std::optional<std::int64_t> days_since_1970(const DateParts& date) {
  using namespace std::chrono;
  if (date.day_of_year > 0) {
    const year y{date.year};
    if (date.day_of_year > (y.is_leap() ? 366 : 365)) return std::nullopt;
    return sys_days{y / January / 1}.time_since_epoch().count() + date.day_of_year - 1;
  }
  const year_month_day ymd{year{date.year}, month{static_cast<unsigned>(date.month)},
                           day{static_cast<unsigned>(date.day)}};
  if (!ymd.ok()) return std::nullopt;
  return sys_days{ymd}.time_since_epoch().count();
}

std::optional<TimeNs> nanoseconds_of(const DateParts& date, std::optional<int> zone_minutes) {
  const std::optional<std::int64_t> days = days_since_1970(date);
  if (!days || date.hour > 23 || date.minute > 59 || date.second > 59) return std::nullopt;
  const int hour = date.afternoon ? date.hour % 12 + (*date.afternoon ? 12 : 0) : date.hour;
  const int zone = date.zone_minutes.value_or(zone_minutes.value_or(0));
  const std::int64_t seconds = *days * 86'400 + hour * 3600 + (date.minute - zone) * 60 + date.second;
  constexpr std::int64_t kNs = 1'000'000'000;
  if (seconds < -kLastStampNs / kNs || seconds > kLastStampNs / kNs) return std::nullopt;
  const TimeNs ns = seconds * kNs + date.fraction_ns;
  return ns <= kLastStampNs ? std::optional<TimeNs>(ns) : std::nullopt;
}

std::optional<DateParts> scan_date(std::string_view text, std::string_view format) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  DateParts date;
  DateScanner scanner(text);
  const bool good =
      format.empty() ? scan_iso(scanner, date) && scanner.done() : scan_format(scanner, format, date);
  return good ? std::optional<DateParts>(date) : std::nullopt;
}

}  // namespace

std::optional<TimeNs> parse_date(std::string_view text, std::string_view format,
                                 std::optional<int> zone_minutes) {
  const std::optional<DateParts> date = scan_date(text, format);
  return date ? nanoseconds_of(*date, zone_minutes) : std::nullopt;
}

bool date_names_zone(std::string_view text, std::string_view format) {
  const std::optional<DateParts> date = scan_date(text, format);
  return date && date->zone_minutes;
}

std::optional<int> parse_zone(std::string_view text) {
  DateScanner scanner(text);
  std::optional<int> minutes;
  return scanner.take_zone(minutes) && scanner.done() ? minutes : std::nullopt;
}

}  // namespace herr
