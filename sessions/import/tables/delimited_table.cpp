#include "sessions/import/tables/delimited_table.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "sessions/files/input_error.h"
#include "sessions/import/tables/field_cutter.h"
#include "sessions/import/tables/table_faults.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view between(const char* begin, const char* end) {
  while (begin != end && is_blank(*begin)) ++begin;
  while (end != begin && is_blank(end[-1])) --end;
  return {begin, static_cast<std::size_t>(end - begin)};
}

bool holds(std::string_view line, char c) {
  return std::memchr(line.data(), c, line.size()) != nullptr;
}

constexpr std::size_t kFewestNames = 4;  // of a header line, to be told from a row

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// The first two fields: cheap, as every row is asked.
bool begins_with_words(std::string_view line, char separator) {
  if (!is_letter(line[0])) return false;
  const std::size_t end = line.find(separator);
  if (end == std::string_view::npos) return false;
  const std::string_view rest = between(line.data() + end + 1, line.data() + line.size());
  return !rest.empty() && is_letter(rest[0]);
}

// The first `fields.size()` fields of a line without quotes. Returns how many the line has.
std::size_t cut_plain(std::string_view line, char separator, std::span<std::string_view> fields) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t place = 0; place < fields.size(); ++place) {
    const char* stop = at;
    while (stop != end && *stop != separator) ++stop;
    fields[place] = between(at, stop);
    if (stop == end) return place + 1;
    at = stop + 1;
  }
  return fields.size() + 1 + static_cast<std::size_t>(std::count(at, end, separator));
}

std::size_t cut_blanks(std::string_view line, std::span<std::string_view> fields) {
  const char* at = line.data();
  const char* const end = at + line.size();
  for (std::size_t count = 0;; ++count) {
    while (at != end && is_blank(*at)) ++at;
    if (at == end) return count;
    const char* const begin = at;
    while (at != end && !is_blank(*at)) ++at;
    if (count < fields.size()) fields[count] = {begin, static_cast<std::size_t>(at - begin)};
  }
}

}  // namespace

DelimitedTable::DelimitedTable(const std::filesystem::path& file, const TableFormat& format,
                               std::span<const ColumnRef> wanted)
    : RowSource(file, '.'),
      format_(format),
      wanted_(wanted.begin(), wanted.end()),
      sample_(read_table_sample(file, format, kSampleLines)),
      layout_(choose_layout(sample_, format, wanted)),
      reader_(file, kMostLineBytes) {
  // Before tracking begins, rows may be whole numbers only.
  if (layout_.decimal_open && !sample_.whole_file) {
    sample_ = read_table_sample(file, format, kLongSampleLines);
    layout_ = choose_layout(sample_, format, wanted);
  }
  decimal_ = layout_.decimal;
  names_ = layout_.names;
  counts_.repeated_headers = layout_.word_lines;
  fields_.resize(layout_.most_fields);
  if (!layout_.any_rows && sample_.whole_file) fail_without_rows(sample_, layout_);
  if (layout_.has_all(wanted)) refuse_commas_of_two_kinds(sample_, layout_);
}

std::size_t DelimitedTable::place(const ColumnRef& column) {
  const auto found = layout_.find(column);
  if (!found) fail_column(sample_, format_, layout_, wanted_, column);
  needed_ = std::max(needed_, *found + 1);
  return *found;
}

// Whether the current line may be a row. Throws InputError when it is no text.
bool DelimitedTable::is_row_line() {
  if (text_.text.starts_with("\xef\xbb\xbf")) text_.text.remove_prefix(3);  // of a file appended to another
  const std::string_view line = text_.text;
  if (between(line.data(), line.data() + line.size()).empty()) {
    ++counts_.blank_lines;
    return false;
  }
  if (line_ <= layout_.rows_after) return false;
  if (!format_.comment.empty()) {
    std::size_t first = 0;
    while (is_blank(line[first])) ++first;
    if (line.substr(first).starts_with(format_.comment)) return false;
  }
  if (text_.too_long)
    fail("the line is longer than " + std::to_string(kMostLineBytes) + " bytes", "name a table of text");
  if (holds(line, '\0')) fail("the line holds NUL bytes", "save it as UTF-8 text, or copy it again");
  if (!layout_.header_text.empty() && line[0] == layout_.header_text[0] &&
      trimmed(line) == layout_.header_text) {
    ++counts_.repeated_headers;
    header_again_line_ = line_;
    return false;
  }
  return true;
}

bool DelimitedTable::next_line() {
  while (reader_.next(text_)) {
    line_ = text_.number;
    const bool row = is_row_line();
    if (row && text_.whole) return true;
    if (row) cut_off_ = std::string(text_.text);
  }
  return false;
}

// Sets the fields in use. Returns how many there are, an empty last one after a trailing separator included.
std::size_t DelimitedTable::cut(std::string_view line) {
  if (holds(line, '"')) return cut_quoted(line);
  const std::span<std::string_view> in_use(fields_.data(), needed_);
  const std::size_t count =
      layout_.separator == ' ' ? cut_blanks(line, in_use) : cut_plain(line, layout_.separator, in_use);
  return count;
}

std::size_t DelimitedTable::cut_quoted(std::string_view line) {
  std::size_t count = 0;
  std::string_view field;
  for (bool more = true; more; ++count) {
    more = take_field(line, layout_.separator, field);
    if (count < needed_) fields_[count] = field;
  }
  return count;
}

void DelimitedTable::check_count(std::size_t found) {
  for (std::size_t place = found; place < needed_; ++place) fields_[place] = {};
  if (found == layout_.columns) return;
  // Empty fields at the end may be there or not, in the header line as in the rows.
  std::size_t filled = found;
  if (layout_.separator != ' ') {
    std::string_view line = text_.text;
    while (filled > 0 && !line.empty() && (line.back() == layout_.separator || is_blank(line.back()))) {
      filled -= line.back() == layout_.separator ? 1 : 0;
      line.remove_suffix(1);
    }
  }
  if (found >= layout_.columns && filled <= layout_.most_fields) return;
  if (!format_.ragged || found < needed_) fail_count(found);
  ++counts_.ragged_rows;
}

void DelimitedTable::fail_count(std::size_t found) {
  const FaultWords words = wrong_field_count(text_.text, layout_, found, needed_, format_.ragged);
  fail(words.problem, words.remedy);
}

bool DelimitedTable::names_columns() const {
  if (layout_.header_line == 0 || !begins_with_words(text_.text, layout_.separator)) return false;
  std::vector<std::string_view> fields;
  cut_fields(text_.text, layout_.separator, fields);
  fields.resize(filled_fields(fields));
  return fields.size() == layout_.columns && fields.size() >= kFewestNames && is_line_of_words(fields) &&
         std::find(fields.begin(), fields.end(), "") == fields.end();
}

// Columns may stand in another order below a header line that is not the first one again: no row below it
// counts.
void DelimitedTable::refuse_rows_of_another_header() {
  if (other_header_line_ == 0 && names_columns()) other_header_line_ = line_;
  if (other_header_line_ == 0) return;
  fail(line_ == other_header_line_
           ? "is another header line, which is not the first one again"
           : "stands below another header line (line " + std::to_string(other_header_line_) + ")",
       "split the file there, it holds two recordings");
}

bool DelimitedTable::next() {
  if (!sample_.lines.empty()) sample_.lines = {};
  if (!next_line()) return false;
  if (line_ == header_again_line_ + 1 && names_columns()) {  // a second header line, of units
    ++counts_.repeated_headers;
    if (!next_line()) return false;
  }
  refuse_rows_of_another_header();
  check_count(cut(text_.text));
  return true;
}

}  // namespace herr
