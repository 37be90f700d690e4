#include "sessions/import/tables/table_layout.h"

#include <algorithm>
#include <cctype>

#include "sessions/import/tables/field_cutter.h"
#include "sessions/import/tables/number_text.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

using Lines = std::span<const SampleLine>;

bool begins_as_a_name(std::string_view field) {
  if (field.starts_with('(')) field.remove_prefix(1);
  if (field.empty()) return false;
  const auto first = static_cast<unsigned char>(field[0]);
  return std::isalpha(first) != 0 || first >= 0x80 ||
         std::string_view("#%[_<").find(field[0]) != std::string_view::npos;
}

std::string_view without_mark(std::string_view name) {
  while (!name.empty() && (name[0] == '#' || name[0] == '%' || name[0] == ' ')) name.remove_prefix(1);
  return name;
}

void name_columns(TableLayout& layout, const SampleLine& line) {
  std::vector<std::string_view> fields;
  cut_fields(line.text, layout.separator, fields);
  layout.header_line = line.number;
  layout.header_text = line.comment ? "" : std::string(trimmed(line.text));
  layout.most_fields = fields.size();
  layout.columns = filled_fields(fields);
  layout.names.assign(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(layout.columns));
}

// Numbers alone, one at least with decimals, as many as in the next line: a row where the map expects a
// header line.
bool is_row(Lines lines, char separator) {
  std::vector<std::string_view> fields, below;
  cut_fields(lines[0].text, separator, fields);
  const auto next =
      std::find_if(lines.begin() + 1, lines.end(), [](const SampleLine& line) { return !line.comment; });
  if (next != lines.end()) {
    cut_fields(next->text, separator, below);
    if (below.size() != fields.size()) return false;
  }
  bool decimals = false;
  for (const std::string_view field : fields) {
    if (number_evidence(field, '.') < 2 && number_evidence(field, ',') < 2) return false;
    decimals = decimals || field.find_first_of(".,") != std::string_view::npos;
  }
  return decimals;
}

// Takes what comes before the rows off `lines`.
void take_header(TableLayout& layout, const TableFormat& format, std::span<const ColumnRef> wanted,
                 Lines& lines) {
  if (format.header_lines > 1) {
    layout.rows_after = static_cast<std::int64_t>(format.header_lines);
    for (; !lines.empty() && lines[0].number <= layout.rows_after; lines = lines.subspan(1))
      if (lines[0].number == static_cast<std::int64_t>(format.names_line)) name_columns(layout, lines[0]);
    return;
  }
  const auto first =
      std::find_if(lines.begin(), lines.end(), [](const SampleLine& line) { return !line.comment; });
  if (first == lines.end()) return;
  name_columns(layout, *first);
  if (first != lines.begin() && !layout.has_all(wanted)) {
    TableLayout commented = layout;
    name_columns(commented, *(first - 1));
    if (commented.has_all(wanted)) {
      layout = commented;
      layout.rows_after = layout.header_line;
      lines = lines.subspan(static_cast<std::size_t>(first - lines.begin()));
      return;
    }
  }
  if (is_row(lines.subspan(static_cast<std::size_t>(first - lines.begin())), layout.separator)) {
    layout.header_line = 0;
    layout.header_text.clear();
    layout.names.clear();
    layout.columns = layout.most_fields = 0;
    return;
  }
  layout.rows_after = layout.header_line;
  lines = lines.subspan(static_cast<std::size_t>(first - lines.begin()) + 1);
}

// Lines of words above the first row: a header that the map does not expect, or a line of units.
void pass_words(TableLayout& layout, Lines& lines) {
  std::vector<std::string_view> fields;
  for (; !lines.empty(); lines = lines.subspan(1)) {
    if (lines[0].comment) continue;
    cut_fields(lines[0].text, layout.separator, fields);
    if (!is_line_of_words(fields)) break;
    if (layout.header_text.empty()) layout.header_text = std::string(trimmed(lines[0].text));
    layout.rows_after = lines[0].number;
    ++layout.word_lines;
  }
}

TableLayout lay_out(const TableSample& sample, const TableFormat& format, char separator,
                    std::span<const ColumnRef> wanted, Lines& rows) {
  TableLayout layout;
  layout.separator = separator;
  layout.decimal = format.decimal == 0 ? '.' : format.decimal;
  rows = sample.lines;
  if (format.header) take_header(layout, format, wanted, rows);
  pass_words(layout, rows);
  std::vector<std::string_view> fields;
  for (const SampleLine& line : rows) {
    if (line.comment) continue;
    const bool first = !layout.any_rows;
    layout.any_rows = true;
    if (layout.header_line > 0 || (!first && !format.ragged)) break;
    cut_fields(line.text, separator, fields);
    if (first) layout.columns = filled_fields(fields);
    layout.most_fields = std::max(layout.most_fields, fields.size());
  }
  return layout;
}

// How well the wanted fields of the sampled rows fit numbers.
std::int64_t number_score(const TableLayout& layout, std::span<const ColumnRef> wanted, Lines rows,
                          char decimal) {
  std::int64_t score = 0;
  std::vector<std::string_view> fields;
  for (const SampleLine& line : rows) {
    if (line.comment) continue;
    cut_fields(line.text, layout.separator, fields);
    for (const ColumnRef& column : wanted) {
      const auto place = layout.find(column);
      if (!place || *place >= fields.size()) continue;
      if (!fields[*place].empty()) score += number_evidence(fields[*place], decimal);
    }
  }
  return score;
}

}  // namespace

std::optional<std::size_t> TableLayout::find(const ColumnRef& column) const {
  if (column.number > 0) {
    if (column.number > most_fields) return std::nullopt;
    return column.number - 1;
  }
  const auto found = std::find(names.begin(), names.end(), column.name);
  if (found == names.end()) {
    if (!names.empty() && !column.name.empty() && without_mark(names[0]) == column.name) return 0;
    return std::nullopt;
  }
  if (std::find(found + 1, names.end(), column.name) != names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

bool TableLayout::has_all(std::span<const ColumnRef> wanted) const {
  return std::all_of(wanted.begin(), wanted.end(),
                     [&](const ColumnRef& column) { return find(column).has_value(); });
}

TableLayout lay_out(const TableSample& sample, const TableFormat& format, char separator) {
  Lines rows;
  return lay_out(sample, format, separator, {}, rows);
}

TableLayout choose_layout(const TableSample& sample, const TableFormat& format,
                          std::span<const ColumnRef> wanted) {
  const std::string_view separators =
      format.separator != 0 ? std::string_view(&format.separator, 1) : std::string_view(";\t, ");
  const std::string_view decimals =
      format.decimal != 0 ? std::string_view(&format.decimal, 1) : std::string_view(".,");
  std::optional<TableLayout> best;
  std::int64_t best_score = 0;
  for (const char separator : separators) {
    Lines rows;
    TableLayout layout = lay_out(sample, format, separator, wanted, rows);
    const auto there = std::count_if(wanted.begin(), wanted.end(), [&](const ColumnRef& column) {
      return layout.find(column).has_value();
    });
    for (const char decimal : decimals) {
      // One column more outweighs all numbers of the sample.
      const std::int64_t score = there * 10'000'000 + number_score(layout, wanted, rows, decimal);
      // With no column there, the one that parts the lines at all, so that messages speak of what is there.
      const bool parts_more = best && there == 0 && score == best_score && layout.columns > best->columns;
      if (best && score <= best_score && !parts_more) {
        best->decimal_open |= score == best_score && best->separator == separator;
        continue;
      }
      layout.decimal = decimal;
      best = layout;
      best_score = score;
    }
  }
  return *best;
}

bool is_line_of_words(std::span<const std::string_view> fields) {
  bool any = false;
  for (const std::string_view field : fields) {
    if (field.empty()) continue;
    if (!begins_as_a_name(field) || stands_for_no_number(field)) return false;
    any = true;
  }
  return any;
}

bool has_commas_of_two_kinds(std::string_view line) {
  if (line.find_first_of(".\"") != std::string_view::npos) return false;
  int zeros = 0, blanks = 0, tight = 0;
  for (std::size_t comma = line.find(','); comma != std::string_view::npos;
       comma = line.find(',', comma + 1)) {
    const std::string_view next = line.substr(comma + 1, 2);
    if (next.empty()) continue;
    ++(next[0] == ' ' ? blanks : tight);
    zeros +=
        next.size() == 2 && next[0] == '0' && std::isdigit(static_cast<unsigned char>(next[1])) != 0 ? 1 : 0;
  }
  return zeros >= 2 ||
         (blanks > 0 && tight > 0 && line.find_first_of("0123456789") != std::string_view::npos);
}

}  // namespace herr
