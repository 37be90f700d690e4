#include "sessions/import/rows/time_reader.h"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "sessions/format/session_header.h"
#include "sessions/import/text/date_text.h"
#include "sessions/import/text/stamp_text.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

constexpr TimeNs kSecond = 1'000'000'000;
// A scale above 1 (days, 86400) would also stretch the rounding to whole nanoseconds: below this, a double is
// closer to the number as written.
constexpr TimeNs kDoubleNs = TimeNs{1} << 52;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// "2016-12-13", "13.12.2016", "21:21:13", "12/13/16".
bool looks_like_date(std::string_view text) {
  int points = 0;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (!is_digit(text[i - 1])) continue;
    if (text[i] == ':' || text[i] == '/' || text[i] == '-') return true;
    points += text[i] == '.' ? 1 : 0;
  }
  return points > 1;
}

bool has_digit(std::string_view text) {
  return text.find_first_of("0123456789") != std::string_view::npos;
}

[[noreturn]] void refuse_absent(const RowSource& rows, std::size_t place) {
  rows.fail_field(place,
                  rows.text(place).empty() ? "is empty, no time stamp"
                                           : "is " + in_quotes(rows.text(place)) + ", no time stamp",
                  "remove the line");
}

// Why a field is no number of a unit.
[[noreturn]] void refuse_number(const RowSource& rows, std::size_t place, TimeUnit unit) {
  const std::string_view text = rows.text(place);
  const char other = rows.decimal() == ',' ? '.' : ',';
  const std::string is = "is " + in_quotes(text);
  if (rows.absent(place)) refuse_absent(rows, place);
  if (text.find(other) == text.rfind(other) && parse_stamp(text, unit, other))
    rows.fail_field(place, is + (other == ',' ? ": a decimal comma" : ": a decimal point"),
                    std::string("write \"decimal\": \"") + other + "\" into the map");
  if (looks_like_date(text))
    rows.fail_field(place, is + ": a date", "write {\"column\": ..., \"date\": \"\"} as time into the map");
  if (!has_digit(text))
    rows.fail_field(
        place, is + ", no time stamp",
        "if the line names the columns, put # before it and write \"comment\": \"#\" into the map; "
        "else remove it");
  const bool number = text.find_first_not_of("0123456789+-.,eE") == std::string_view::npos;
  rows.fail_field(
      place, is + (number ? ", no time stamp in range" : ", no time stamp"),
      number ? "check the time unit of the map, or remove the line" : "correct or remove the line");
}

TimeNs number_ns(const RowSource& rows, std::size_t place, TimeUnit unit) {
  const auto stamp = parse_stamp(rows.text(place), unit, rows.decimal());
  if (!stamp) refuse_number(rows, place, unit);
  return *stamp;
}

TimeNs date_ns(const RowSource& rows, std::size_t place, const TimeColumns& columns) {
  const std::string_view text = rows.text(place);
  const auto stamp = parse_date(text, columns.date_format, columns.zone_minutes);
  if (stamp) return *stamp;
  if (rows.absent(place)) refuse_absent(rows, place);
  const std::string wanted =
      columns.date_format.empty() ? "year-month-day hour:minute:second" : in_quotes(columns.date_format);
  rows.fail_field(place, "is " + in_quotes(text) + ", no date as " + wanted,
                  !looks_like_date(text) && text.find_first_not_of("0123456789.+-") == std::string_view::npos
                      ? "a number: write its \"unit\" in the place of \"date\" into the map's time"
                      : "check \"date\" in the map's time, or remove the line");
}

TimeNs two_part_ns(const RowSource& rows, std::size_t seconds_place, std::size_t nanoseconds_place) {
  const TimeNs seconds = number_ns(rows, seconds_place, TimeUnit::s);
  const TimeNs rest = number_ns(rows, nanoseconds_place, TimeUnit::ns);
  if (seconds % kSecond != 0)
    rows.fail_field(seconds_place, "is " + in_quotes(rows.text(seconds_place)) + ", no whole seconds",
                    "where it holds the fraction already, name it as column with unit s in the map's time");
  if (rest < 0 || rest >= kSecond)
    rows.fail_field(nanoseconds_place,
                    "is " + in_quotes(rows.text(nanoseconds_place)) + ", not 0 to 999999999 nanoseconds",
                    "check the columns of the map's time, or remove the line");
  return seconds + rest;
}

// In range once moved, else none.
std::optional<TimeNs> in_range(long double ns, TimeNs offset_ns) {
  const long double moved = ns + static_cast<long double>(offset_ns);
  if (!(std::fabs(moved) <= static_cast<long double>(kLastStampNs)) ||
      !(std::fabs(ns) <= 2 * static_cast<long double>(kLastStampNs)))
    return std::nullopt;
  return static_cast<TimeNs>(std::llround(ns)) + offset_ns;
}

}  // namespace

TimeReader::TimeReader(RowSource& rows, const TimeColumns& columns)
    : columns_(&columns), period_ns_(period_of(columns)) {
  if (columns.kind == TimeColumns::Kind::rate) return;
  place_ = rows.place(columns.column);
  if (columns.kind == TimeColumns::Kind::seconds_nanoseconds)
    nanoseconds_place_ = rows.place(columns.nanoseconds);
}

TimeNs TimeReader::read(const RowSource& rows) {
  if (columns_->kind != TimeColumns::Kind::rate) return moved(rows, carried(recorded(rows)));
  const long double ns = static_cast<long double>(row_++) * kSecond / columns_->rate_hz * columns_->scale;
  const auto stamp = in_range(ns, columns_->offset_ns);
  if (!stamp) rows.fail("the rate of the map puts the row beyond 126 years", "check its rate_hz and scale");
  return *stamp;
}

TimeNs TimeReader::recorded(const RowSource& rows) const {
  switch (columns_->kind) {
    case TimeColumns::Kind::seconds_nanoseconds:
      return two_part_ns(rows, place_, nanoseconds_place_);
    case TimeColumns::Kind::date:
      return date_ns(rows, place_, *columns_);
    default:
      return number_ns(rows, place_, columns_->unit);
  }
}

// A time of day that falls by more than half a day is the next day's, and one that then rises by as much the
// day's before: a wild stamp carries no other along.
TimeNs TimeReader::carried(TimeNs recorded_ns) {
  if (period_ns_ == 0) return recorded_ns;
  if (!before_ns_) before_ns_ = recorded_ns;
  const TimeNs step_ns = recorded_ns - *before_ns_;
  if (step_ns < -period_ns_ / 2)
    carried_ns_ += period_ns_;
  else if (step_ns > period_ns_ / 2 && carried_ns_ > 0)
    carried_ns_ -= period_ns_;
  before_ns_ = recorded_ns;
  return recorded_ns + carried_ns_;
}

TimeNs TimeReader::moved(const RowSource& rows, TimeNs recorded_ns) const {
  const double scale = columns_->scale;
  if (scale == 1 && columns_->offset_ns == 0) return recorded_ns;
  auto ns = static_cast<long double>(recorded_ns);
  const bool number = columns_->kind == TimeColumns::Kind::number;
  if (number && std::abs(scale) > 1 && std::abs(recorded_ns) < kDoubleNs &&
      !counts_from_a_year(columns_->unit))
    ns = static_cast<long double>(rows.number(place_)) * static_cast<long double>(ns_per(columns_->unit));
  const auto stamp = in_range(ns * scale, columns_->offset_ns);
  if (!stamp)
    rows.fail_field(place_,
                    "is " + in_quotes(rows.text(place_)) + ", with scale and offset no time stamp in range",
                    "check scale, offset_s and the unit of the map's time");
  return *stamp;
}

TimeNs period_of(const TimeColumns& time) {
  return time.kind == TimeColumns::Kind::date ? date_period_ns(time.date_format) : 0;
}

void add_columns(const TimeColumns& time, std::vector<ColumnRef>& columns) {
  if (time.kind == TimeColumns::Kind::rate) return;
  columns.push_back(time.column);
  if (time.kind == TimeColumns::Kind::seconds_nanoseconds) columns.push_back(time.nanoseconds);
}

}  // namespace herr
