// The time columns of a map.
#include <nlohmann/json.hpp>

#include "sessions/import/map/map_parts.h"
#include "sessions/import/text/date_text.h"

namespace herr {
namespace {

TimeUnit parse_unit(const JsonObject& entry) {
  const std::string word = entry.text("unit");
  const auto unit = time_unit(word);
  if (!unit)
    entry.fail("unit", "is '" + printable(word) + "'",
               "write s, ms, us, ns, dotnet-ticks (100 ns since the year 1) or filetime (100 ns since 1601)");
  return *unit;
}

void parse_date_columns(const JsonObject& entry, TimeColumns& time) {
  time.kind = TimeColumns::Kind::date;
  time.date_format = entry.text("date");
  if (const auto fault = date_format_fault(time.date_format))
    entry.fail("date", "is '" + printable(time.date_format) + "', which " + fault->problem,
               fault->remedy + "; \"\" stands for ISO 8601");
  if (!entry.has("zone")) return;
  time.zone_minutes = parse_zone(entry.text("zone"));
  if (!time.zone_minutes)
    entry.fail("zone", "is '" + printable(entry.text("zone")) + "'",
               "write the distance to Greenwich, such as \"+01:00\", or \"Z\"");
}

void parse_stamp_column(const JsonObject& entry, TimeColumns& time) {
  time.column = parse_ref(entry, "column");
  if (std::string(only_one_of(entry, {"unit", "date"}, "unit")) == "date") {
    parse_date_columns(entry, time);
    return;
  }
  refuse_beside(entry, "unit", {"zone"});
  time.unit = parse_unit(entry);
}

// A number of seconds, or such a number as text where a double has too few digits; exact.
TimeNs parse_offset(const JsonObject& entry) {
  if (!entry.has("offset_s")) return 0;
  const nlohmann::json& value = entry.value("offset_s");
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  const auto offset = value.is_number() || value.is_string() ? parse_stamp(text, TimeUnit::s) : std::nullopt;
  if (!offset)
    entry.fail("offset_s", "is " + printable(value.is_string() ? "'" + text + "'" : text.substr(0, 80)),
               "write seconds from -4e9 to 4e9, as a number, or as text to keep more than 15 digits");
  return *offset;
}

}  // namespace

TimeColumns parse_time(const JsonObject& parent) {
  const JsonObject entry = parent.object("time");
  entry.allow_only(
      {"column", "unit", "date", "zone", "seconds", "nanoseconds", "rate_hz", "offset_s", "scale"});
  TimeColumns time;
  const std::string kind = only_one_of(entry, {"column", "seconds", "rate_hz"}, "stamps");
  if (kind != "seconds") refuse_beside(entry, kind.c_str(), {"nanoseconds"});
  if (kind != "column") refuse_beside(entry, kind.c_str(), {"unit", "date", "zone"});
  if (kind == "column") {
    parse_stamp_column(entry, time);
  } else if (kind == "seconds") {
    time.kind = TimeColumns::Kind::seconds_nanoseconds;
    time.column = parse_ref(entry, "seconds");
    time.nanoseconds = parse_ref(entry, "nanoseconds");
  } else {
    time.kind = TimeColumns::Kind::rate;
    time.rate_hz = entry.number("rate_hz", 1e-3, 1e6);
  }
  time.scale = entry.number_or("scale", 1e-12, 1e12, 1);
  time.offset_ns = parse_offset(entry);
  return time;
}

}  // namespace herr
