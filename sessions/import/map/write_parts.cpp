// Columns, tables, times and filters as JSON.
#include "sessions/import/map/write_parts.h"

#include <array>
#include <cstdio>
#include <cstdlib>

#include "sessions/import/map/map_words.h"

namespace herr {
namespace {

constexpr TimeNs kNsPerSecond = 1'000'000'000;

// "+01:00"
std::string zone_text(int minutes) {
  if (minutes == 0) return "Z";
  std::array<char, 16> text{};
  const int size = std::abs(minutes);
  std::snprintf(text.data(), text.size(), "%c%02d:%02d", minutes < 0 ? '-' : '+', size / 60 % 100, size % 60);
  return text.data();
}

// Seconds as a number where it has few digits, else as text, which keeps all of them.
MapJson offset_json(TimeNs ns) {
  if (ns % kNsPerSecond == 0) return ns / kNsPerSecond;
  const auto size = static_cast<std::uint64_t>(ns < 0 ? -ns : ns);
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%s%llu.%09llu", ns < 0 ? "-" : "",
                static_cast<unsigned long long>(size / kNsPerSecond),
                static_cast<unsigned long long>(size % kNsPerSecond));
  std::string digits = text.data();
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.size() > 15) return digits;
  return MapJson::parse(digits);
}

MapJson condition_json(const RowCondition& condition) {
  MapJson entry;
  entry["column"] = json_of(condition.column);
  MapJson& test = entry[word_of(kTestWords, condition.kind)];
  switch (condition.kind) {
    case RowCondition::Kind::is:
    case RowCondition::Kind::is_not:
      test = condition.texts.empty() ? std::string() : condition.texts.front();
      break;
    case RowCondition::Kind::one_of:
      test = condition.texts;
      break;
    case RowCondition::Kind::above:
    case RowCondition::Kind::below:
      test = condition.limit;
      break;
    case RowCondition::Kind::has_bits:
      test = condition.bits;
      break;
    case RowCondition::Kind::finite:
      test = true;
      break;
  }
  return entry;
}

MapJson conditions_json(const std::vector<RowCondition>& conditions) {
  MapJson list = MapJson::array();
  for (const RowCondition& condition : conditions) list.push_back(condition_json(condition));
  return list;
}

}  // namespace

MapJson json_of(const ColumnRef& ref) {
  if (ref.number > 0) return ref.number;
  return ref.name;
}

MapJson json_of(const ColumnGroup& group) {
  if (group.columns.size() == 1 && group.numbers > 1) return json_of(group.columns.front());
  MapJson list = MapJson::array();
  for (const ColumnRef& column : group.columns) list.push_back(json_of(column));
  return list;
}

MapJson json_of(const AxisDirections& axes) {
  return axes.words();
}

MapJson json_of(const TimeColumns& time) {
  MapJson entry;
  switch (time.kind) {
    case TimeColumns::Kind::number:
      entry["column"] = json_of(time.column);
      entry["unit"] = word_of(time.unit);
      break;
    case TimeColumns::Kind::seconds_nanoseconds:
      entry["seconds"] = json_of(time.column);
      entry["nanoseconds"] = json_of(time.nanoseconds);
      break;
    case TimeColumns::Kind::date:
      entry["column"] = json_of(time.column);
      entry["date"] = time.date_format;
      if (time.zone_minutes) entry["zone"] = zone_text(*time.zone_minutes);
      break;
    case TimeColumns::Kind::rate:
      entry["rate_hz"] = time.rate_hz;
      break;
  }
  if (time.scale != 1) entry["scale"] = time.scale;
  if (time.offset_ns != 0) entry["offset_s"] = offset_json(time.offset_ns);
  return entry;
}

MapJson json_of(const RowFilter& filter) {
  MapJson entry = MapJson::object();
  if (!filter.all.empty()) entry["all"] = conditions_json(filter.all);
  if (!filter.any.empty()) entry["any"] = conditions_json(filter.any);
  return entry;
}

void write_table(const TableFormat& table, MapJson& entry) {
  if (!table.xml_row.empty()) entry["xml"] = table.xml_row;
  if (table.separator != ',') entry["separator"] = word_of(kSeparatorWords, table.separator);
  if (table.decimal != '.') entry["decimal"] = word_of(kDecimalWords, table.decimal);
  if (!table.comment.empty()) entry["comment"] = table.comment;
  if (!table.header) entry["header"] = false;
  if (table.header_lines != 1) entry["header_lines"] = table.header_lines;
  if (table.names_line != 1) entry["names_line"] = table.names_line;
  if (table.ragged) entry["ragged"] = true;
}

void write_filter(const RowFilter& filter, const char* key, MapJson& entry) {
  if (!filter.all.empty() || !filter.any.empty()) entry[key] = json_of(filter);
}

}  // namespace herr
