#include "sessions/import/tables/foreign_table.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

// Loggers add whatever the application has: 69 columns and 1.5 kB of names are a real example.
constexpr std::size_t kMaxLineBytes = 64 << 10;
constexpr std::size_t kMaxFields = 4096;

// Cuts the first field off `rest`.
std::string_view take_field(std::string_view& rest, char separator) {
  const bool blanks = separator == ' ';
  if (blanks) rest = trimmed(rest);
  std::size_t from = 0;
  const std::size_t quote = rest.find_first_not_of(" \t");
  const bool quoted = quote != std::string_view::npos && rest[quote] == '"';
  if (quoted) from = std::min(rest.find('"', quote + 1), rest.size());
  const std::size_t end =
      std::min(blanks ? rest.find_first_of(" \t", from) : rest.find(separator, from), rest.size());
  std::string_view field = trimmed(rest.substr(0, end));
  rest.remove_prefix(end);
  if (quoted && field.size() >= 2 && field.back() == '"') field = field.substr(1, field.size() - 2);
  return field;
}

}  // namespace

ForeignTable::ForeignTable(const std::filesystem::path& file, const TableFormat& format)
    : format_(format), reader_(file, kMaxLineBytes) {
  if (reader_.empty()) throw InputError(path(), 0, "is empty", "name a recording");
  if (!next_line()) throw InputError(path(), 0, "has no rows", "name a recording");
  columns_ = fields_.size();
  if (format_.header)
    names_.assign(fields_.begin(), fields_.end());
  else
    waiting_ = true;
}

void ForeignTable::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(path(), line_.number, problem, remedy);
}

void ForeignTable::fail_field(std::size_t place, const std::string& problem,
                              const std::string& remedy) const {
  const std::string name = place < names_.size() ? in_quotes(names_[place]) : std::to_string(place + 1);
  fail("column " + name + " " + problem, remedy);
}

bool ForeignTable::has(const ColumnRef& column) const {
  if (column.number > 0) return column.number <= columns_;
  return std::count(names_.begin(), names_.end(), column.name) == 1;
}

std::size_t ForeignTable::place(const ColumnRef& column) const {
  if (column.number > 0) {
    if (column.number <= columns_) return column.number - 1;
    throw InputError(path(), 0,
                     "has " + std::to_string(columns_) + " columns, and the map asks for column " +
                         std::to_string(column.number),
                     "check the preset or the separator");
  }
  const auto found = std::find(names_.begin(), names_.end(), column.name);
  if (found == names_.end()) {
    const std::string nearest = nearest_name(column.name, names_);
    throw InputError(path(), 1,
                     "has no column " + in_quotes(column.name) +
                         (nearest.empty() ? "" : " (is it " + in_quotes(nearest) + "?)"),
                     "check the preset, the separator, or write a map");
  }
  if (std::find(found + 1, names_.end(), column.name) != names_.end())
    throw InputError(path(), 1, "names column " + in_quotes(column.name) + " twice",
                     "give the column's number in a map");
  return static_cast<std::size_t>(found - names_.begin());
}

void ForeignTable::split(std::string_view line) {
  fields_.clear();
  for (std::string_view rest = line;;) {
    fields_.push_back(take_field(rest, format_.separator));
    if (format_.separator == ' ') rest = trimmed(rest);
    if (rest.empty() || fields_.size() > kMaxFields) return;
    if (format_.separator != ' ') rest.remove_prefix(1);
  }
}

// Skips blank lines and comments.
bool ForeignTable::next_line() {
  while (reader_.next(line_)) {
    if (!line_.whole) {
      cut_off_ = std::string(line_.text);
      return false;
    }
    if (line_.text.find('\0') != std::string_view::npos)
      fail("holds NUL bytes", "save it as UTF-8 text, or copy it again");
    if (line_.too_long) fail("the line is longer than 65536 bytes", "name a table of text");
    if (trimmed(line_.text).empty()) {
      ++blank_lines_;
      continue;
    }
    if (!format_.comment.empty() && line_.text.starts_with(format_.comment)) continue;
    split(line_.text);
    return true;
  }
  return false;
}

bool ForeignTable::next() {
  if (waiting_) {
    waiting_ = false;
    return true;
  }
  if (!next_line()) return false;
  if (fields_.size() != columns_)
    fail("the line has " + std::to_string(fields_.size()) + " fields where the first one has " +
             std::to_string(columns_),
         "correct or remove the line");
  return true;
}

double ForeignTable::number_in(std::string_view text, std::size_t place) const {
  std::string_view digits = text;
  if (digits.starts_with("+") && digits.size() > 1 && digits[1] != '-') digits.remove_prefix(1);
  // from_chars reads "inf" and "nan" too: a number here is digits, sign, point and exponent.
  const bool plain = !digits.empty() && digits.find_first_not_of("0123456789+-.eE") == std::string_view::npos;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (!plain || error != std::errc() || end != digits.data() + digits.size())
    fail_field(place, "is " + in_quotes(text) + ", not a finite number",
               digits.find(',') != std::string_view::npos ? "write numbers with a decimal point, not a comma"
                                                          : "correct or remove the line");
  return value;
}

double ForeignTable::number(std::size_t place) const {
  return number_in(text(place), place);
}

std::vector<double> ForeignTable::numbers(std::size_t place, std::size_t count) const {
  std::string_view rest = text(place);
  if (rest.size() >= 2 && (rest.front() == '(' || rest.front() == '['))
    rest = rest.substr(1, rest.size() - 2);
  const char separator = rest.find(',') != std::string_view::npos ? ',' : ' ';
  std::vector<double> values;
  while (!trimmed(rest).empty() && values.size() <= count) {
    values.push_back(number_in(take_field(rest, separator), place));
    if (!rest.empty()) rest.remove_prefix(1);
  }
  if (values.size() != count)
    fail_field(place, "is " + in_quotes(text(place)) + ", not " + std::to_string(count) + " numbers",
               "correct or remove the line");
  return values;
}

}  // namespace herr
