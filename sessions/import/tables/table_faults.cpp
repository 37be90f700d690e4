#include "sessions/import/tables/table_faults.h"

#include <algorithm>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"
#include "sessions/import/tables/field_cutter.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

constexpr const char* kTwoKinds = "decimal commas in fields that commas separate cannot be told apart";
constexpr const char* kExportAgain =
    "export it again with decimal points, or with semicolons between the fields";

std::string set_key(const char* key, const std::string& value) {
  return std::string("set \"") + key + "\": \"" + value + "\" in the map";
}

std::string fields_text(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " field" : " fields");
}

// The separator with which all wanted columns are there, or 0.
char fitting_separator(const TableSample& sample, const TableFormat& format,
                       std::span<const ColumnRef> wanted) {
  for (const char separator : {';', '\t', ',', ' '})
    if (const TableLayout other = lay_out(sample, format, separator);
        (other.header_line > 0 || other.columns > 1) && other.has_all(wanted))
      return separator;
  return 0;
}

// The line of the sample that names all wanted columns, or 0.
std::int64_t naming_line(const TableSample& sample, const TableLayout& layout,
                         std::span<const ColumnRef> wanted) {
  std::vector<std::string_view> fields;
  for (const SampleLine& line : sample.lines) {
    TableLayout other;
    cut_fields(line.text, layout.separator, fields);
    other.names.assign(fields.begin(), fields.end());
    other.most_fields = fields.size();
    if (other.has_all(wanted)) return line.number;
  }
  return 0;
}

std::string column_text(const ColumnRef& column) {
  return column.number > 0 ? "column " + std::to_string(column.number) : "column " + in_quotes(column.name);
}

std::string separator_remedy(char separator) {
  const char* also = separator == ';' ? "; with decimal commas also \"decimal\": \",\"" : "";
  return set_key("separator", separator_key(separator)) + " (or \"auto\"" + also + ")";
}

[[noreturn]] void fail_name(const TableSample& sample, const TableLayout& layout,
                            std::span<const ColumnRef> wanted, const ColumnRef& column) {
  const std::int64_t line = std::max<std::int64_t>(layout.header_line, 1);
  if (std::count(layout.names.begin(), layout.names.end(), column.name) > 1)
    throw InputError(sample.path, line, "names " + column_text(column) + " twice",
                     "give the column's number in a map");
  if (layout.header_line == 0)
    throw InputError(
        sample.path, line,
        "has no header line that names " + column_text(column) + ": its first line holds numbers",
        "number the columns in a map with \"header\": false, or put the header line back");
  if (const std::int64_t named = naming_line(sample, layout, wanted);
      named > 0 && named != layout.header_line) {
    const std::string number = std::to_string(named);
    throw InputError(sample.path, line, "has no " + column_text(column) + "; line " + number + " names it",
                     "set \"header_lines\": " + number + " and \"names_line\": " + number + " in the map");
  }
  const std::string nearest = nearest_name(column.name, layout.names);
  throw InputError(
      sample.path, line,
      "has no " + column_text(column) + (nearest.empty() ? "" : " (is it " + in_quotes(nearest) + "?)"),
      "check the preset, the separator, or write a map");
}

}  // namespace

void fail_column(const TableSample& sample, const TableFormat& format, const TableLayout& layout,
                 std::span<const ColumnRef> wanted, const ColumnRef& column) {
  if (const char other = fitting_separator(sample, format, wanted); other != 0 && other != layout.separator)
    throw InputError(sample.path, std::max<std::int64_t>(layout.header_line, 1),
                     "has no " + column_text(column) + ": the fields are separated by " +
                         separator_name(other) + ", not by " + separator_name(layout.separator),
                     separator_remedy(other));
  if (column.number == 0) fail_name(sample, layout, wanted, column);
  throw InputError(
      sample.path, 0,
      "has " + std::to_string(layout.most_fields) + " columns, and the map asks for " + column_text(column),
      "check the preset or the separator");
}

void fail_without_rows(const TableSample& sample, const TableLayout& layout) {
  if (sample.cut_off_line > 0)
    throw InputError(sample.path, sample.cut_off_line,
                     "holds no whole row: the file ends within its first one",
                     "end the line if it is whole, or copy the file again");
  if (layout.header_line > 0 || layout.word_lines > 0)
    throw InputError(sample.path, 0, "holds a header line and no rows",
                     "record again, or copy the file again");
  throw InputError(sample.path, 0, "has no rows", "name a recording");
}

FaultWords wrong_field_count(std::string_view line, const TableLayout& layout, std::size_t found,
                             std::size_t needed, bool ragged) {
  const bool header = layout.header_line > 0;
  FaultWords words{"the line has " + fields_text(found) +
                       (header ? " where the header line names " : " where the first row has ") +
                       std::to_string(layout.columns),
                   "correct or remove the line"};
  if (layout.separator == ',' && found > layout.columns && line.find('.') == std::string_view::npos &&
      (has_commas_of_two_kinds(line) || found + 1 >= 2 * layout.columns))
    return {words.problem + ": " + kTwoKinds, kExportAgain};
  std::vector<std::string_view> fields;
  for (const char other : {';', '\t', ',', ' '}) {
    if (other == layout.separator || found >= layout.columns) continue;
    cut_fields(line, other, fields);
    if (fields.size() < layout.columns || filled_fields(fields) > layout.columns) continue;
    return {words.problem + ": it is separated by " + separator_name(other) + ", not by " +
                separator_name(layout.separator),
            header ? "separate header line and rows alike" : separator_remedy(other)};
  }
  cut_fields(line, layout.separator, fields);
  if (is_line_of_words(fields))
    words = {words.problem + ": another header line begins with " + in_quotes(fields[0]),
             "split the file there, it holds two recordings"};
  else if (ragged)
    words.remedy = "the map needs " + fields_text(needed) + "; correct or remove the line";
  else if (found >= needed)
    words.remedy = "set \"ragged\": true in the map if only fields after the first " +
                   std::to_string(needed) + " come and go, or correct the line";
  return words;
}

void refuse_commas_of_two_kinds(const TableSample& sample, const TableLayout& layout) {
  if (layout.separator != ',') return;
  std::int64_t alike = 0, rows = 0, first = 0;
  std::vector<std::string_view> fields;
  for (const SampleLine& line : sample.lines) {
    if (line.comment || line.number <= layout.rows_after) continue;
    ++rows;
    if (line.text.find('.') != std::string::npos) return;
    cut_fields(line.text, ',', fields);
    const bool shifted = layout.header_line == 0 || filled_fields(fields) > layout.columns;
    if (!shifted || !has_commas_of_two_kinds(line.text)) continue;
    if (++alike == 1) first = line.number;
  }
  if (alike > 0 && 2 * alike >= rows) throw InputError(sample.path, first, kTwoKinds, kExportAgain);
}

}  // namespace herr
