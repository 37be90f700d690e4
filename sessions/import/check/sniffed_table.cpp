#include "sessions/import/check/sniffed_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <string_view>

#include "sessions/files/line_reader.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

constexpr std::size_t kSniffedRows = 2000;
constexpr std::size_t kSniffedLineBytes = 64 << 10;
constexpr double kMostNumbers = 0.5;

std::vector<std::string> cut(std::string_view line, char separator) {
  std::vector<std::string> fields;
  std::string_view rest = line;
  for (;;) {
    if (separator == ' ') rest = trimmed(rest);
    const std::size_t end =
        std::min(separator == ' ' ? rest.find_first_of(" \t") : rest.find(separator), rest.size());
    std::string_view field = trimmed(rest.substr(0, end));
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
      field = field.substr(1, field.size() - 2);
    fields.emplace_back(field);
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  while (!fields.empty() && fields.back().empty()) fields.pop_back();  // trailing separators
  return fields;
}

std::optional<double> number_of(std::string text, char decimal) {
  if (decimal == ',') std::replace(text.begin(), text.end(), ',', '.');
  std::string_view digits = text;
  if (digits.starts_with("+")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (!begins_with_digits(digits) || error != std::errc() || end != digits.data() + digits.size())
    return std::nullopt;
  return value;
}

std::size_t usual_width(const std::vector<std::vector<std::string>>& rows) {
  std::map<std::size_t, std::size_t> widths;
  for (const auto& row : rows) ++widths[row.size()];
  const auto most = std::max_element(widths.begin(), widths.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == widths.end() ? 0 : most->first;
}

// How well a separator cuts the lines: the share of lines of the usual width, 0 for a single column.
double evenness(const std::vector<std::string>& lines, char separator) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : lines) rows.push_back(cut(line, separator));
  const std::size_t width = usual_width(rows);
  if (width < 2) return 0;
  const auto even =
      std::count_if(rows.begin(), rows.end(), [&](const auto& row) { return row.size() == width; });
  return static_cast<double>(even) / static_cast<double>(rows.size());
}

// Semicolons and tabs stand in no number; a comma may be a decimal sign, blanks may follow a comma.
char separator_of(const std::vector<std::string>& lines) {
  constexpr double kEven = 0.8;
  for (const char separator : {';', '\t', ',', ' '})
    if (evenness(lines, separator) >= kEven) return separator;
  return 0;
}

bool decimal_commas(const std::vector<std::vector<std::string>>& rows) {
  std::size_t commas = 0, points = 0;
  for (const auto& row : rows)
    for (const std::string& field : row) {
      if (field.find_first_not_of("0123456789+-,.eE") != std::string::npos) continue;
      commas += std::count(field.begin(), field.end(), ',') == 1 ? 1 : 0;
      points += field.find('.') != std::string::npos ? 1 : 0;
    }
  return commas > points;
}

bool has_number(const std::vector<std::string>& row, char decimal) {
  return std::any_of(row.begin(), row.end(),
                     [&](const std::string& field) { return number_of(field, decimal).has_value(); });
}

std::vector<std::string> first_lines(const std::filesystem::path& file) {
  LineReader reader(file, kSniffedLineBytes);
  std::vector<std::string> lines;
  TextLine line;
  while (lines.size() <= kSniffedRows && reader.next(line)) {
    if (!line.whole || line.too_long || trimmed(line.text).empty()) continue;
    lines.emplace_back(line.text);
  }
  return lines;
}

// Of the lines above the rows, the one that names the columns; none where no line of words has their number.
std::optional<std::size_t> names_line(const std::vector<std::vector<std::string>>& rows, std::size_t first,
                                      std::size_t width) {
  for (std::size_t line = 0; line < first; ++line)
    if (rows[line].size() >= width) return line;
  return std::nullopt;
}

// A comment just above the rows that has a name for each column: "# timestamp tx ty tz qx qy qz qw".
std::vector<std::string> names_of_comment(const std::string& comment, char separator, std::size_t width) {
  const std::size_t start = comment.find_first_not_of("# \t");
  if (start == std::string::npos) return {};
  std::vector<std::string> names = cut(std::string_view(comment).substr(start), separator);
  if (names.size() != width || has_number(names, '.')) names.clear();
  return names;
}

std::vector<double> column_values(const SniffedTable& table, std::size_t column) {
  std::vector<double> values;
  std::size_t good = 0;
  for (const auto& row : table.fields) {
    const auto value = number_of(row[column], table.format.decimal);
    good += value ? 1 : 0;
    values.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  if (static_cast<double>(good) <= kMostNumbers * static_cast<double>(values.size())) values.clear();
  return values;
}

// Takes the header off the rows, and leaves rows of one width.
void name_columns(SniffedTable& table, const std::string& last_comment) {
  auto& rows = table.fields;
  std::size_t first = 0;
  while (first < rows.size() && !has_number(rows[first], table.format.decimal)) ++first;
  const std::vector<std::vector<std::string>> numbers(rows.begin() + static_cast<std::ptrdiff_t>(first),
                                                      rows.end());
  std::size_t width = usual_width(numbers);
  table.format.header = first > 0;
  if (const auto line = names_line(rows, first, width)) {
    table.names = rows[*line];
    width = table.names.size();
    if (*line > 0 && last_comment.empty()) {
      table.format.header_lines = first;
      table.format.names_line = *line + 1;
    }
  } else if (first > 0) {
    table.format.header = true;
    table.format.header_lines = first;
  } else {
    table.names = names_of_comment(last_comment, table.format.separator, width);
  }
  rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(first));
  std::erase_if(rows, [&](const auto& row) {
    return row.size() > width || row.size() + 2 < width || !has_number(row, table.format.decimal);
  });
  for (auto& row : rows) row.resize(width);
}

}  // namespace

ColumnRef SniffedTable::ref(std::size_t column) const {
  if (names.empty() || !format.header) return {"", column + 1};
  const bool once = std::count(names.begin(), names.end(), names[column]) == 1;
  return once && !names[column].empty() ? ColumnRef{names[column], 0} : ColumnRef{"", column + 1};
}

std::string SniffedTable::called(std::size_t column) const {
  return names.empty() || names[column].empty() ? "column " + std::to_string(column + 1)
                                                : "'" + names[column] + "'";
}

const std::vector<double>* SniffedTable::numbers(std::size_t column) const {
  return values[column].empty() ? nullptr : &values[column];
}

std::optional<SniffedTable> sniff_table(const std::filesystem::path& file) {
  std::vector<std::string> lines = first_lines(file);
  SniffedTable table;
  std::string last_comment;
  for (std::size_t i = 0; i < lines.size() && lines[i][0] == '#'; ++i) last_comment = lines[i];
  if (std::any_of(lines.begin(), lines.end(), [](const std::string& line) { return line[0] == '#'; }))
    table.format.comment = "#";
  std::erase_if(lines, [](const std::string& line) { return line[0] == '#'; });
  table.format.separator = separator_of(lines);
  if (lines.empty() || lines[0][0] == '<' || table.format.separator == 0) return std::nullopt;
  for (const std::string& line : lines) table.fields.push_back(cut(line, table.format.separator));
  table.format.decimal = table.format.separator != ',' && decimal_commas(table.fields) ? ',' : '.';
  name_columns(table, last_comment);
  if (table.fields.size() < 2 || table.fields.front().size() < 2) return std::nullopt;
  for (std::size_t column = 0; column < table.fields.front().size(); ++column)
    table.values.push_back(column_values(table, column));
  return table;
}

}  // namespace herr
