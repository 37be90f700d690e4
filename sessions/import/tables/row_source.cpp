#include "sessions/import/tables/row_source.h"

#include <cctype>

#include "sessions/files/input_error.h"
#include "sessions/import/tables/number_text.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

constexpr const char* kCorrectLine = "correct or remove the line";

bool has_letter_first(std::string_view text) {
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) != 0;
}

// Names of columns stand at the beginning of a file.
constexpr std::int64_t kLastHeaderLine = 10;

// What to do about a field that is no number, by its likely cause.
std::string number_remedy(std::string_view text, char decimal, std::int64_t line) {
  const char other = decimal == '.' ? ',' : '.';
  if (reads_as_number(text, other))
    return decimal == '.' ? "its decimal sign is a comma: set \"decimal\": \",\" (or \"auto\") in the map"
                          : "its decimal sign is a point: set \"decimal\": \".\" (or \"auto\") in the map";
  for (const char separator : {';', ','})
    if (const std::size_t end = text.find(separator);
        end != std::string_view::npos && parse_number(text.substr(0, end), decimal))
      return separator == ';'
                 ? "the fields seem separated by semicolons: set \"separator\": \";\" (or \"auto\") in the "
                   "map"
                 : "the fields seem separated by commas: set \"separator\": \",\" (or \"auto\") in the map";
  if (line <= kLastHeaderLine && has_letter_first(text) && text.size() > 1 && !text.starts_with("inf"))
    return "if this is a header line, put # before it or remove it";
  return kCorrectLine;
}

}  // namespace

void RowSource::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(path_, line_, problem, remedy);
}

void RowSource::fail_field(std::size_t place, const std::string& problem, const std::string& remedy) const {
  const std::string name = place < names_.size() ? in_quotes(names_[place]) : std::to_string(place + 1);
  fail("column " + name + " " + problem, remedy);
}

bool RowSource::absent(std::size_t place) const {
  return stands_for_no_number(fields_[place]);
}

void RowSource::fail_number(std::size_t place) const {
  const std::string_view found = fields_[place];
  if (stands_for_no_number(found))
    fail_field(place, "holds no number (" + in_quotes(found) + ")",
               "name the column that tells lost rows in the map (\"valid\"), or remove the line");
  fail_field(place, "is " + in_quotes(found) + ", not a finite number",
             number_remedy(found, decimal_, line_));
}

double RowSource::number(std::size_t place) const {
  const auto value = parse_number(fields_[place], decimal_);
  if (!value) fail_number(place);
  return *value;
}

void RowSource::numbers(std::size_t place, std::span<double> values) const {
  std::string_view rest = without_brackets(fields_[place]);
  std::size_t count = 0;
  for (auto part = take_number(rest, decimal_); !part.empty(); part = take_number(rest, decimal_), ++count) {
    if (count >= values.size()) continue;
    const auto value = parse_number(part, decimal_);
    if (!value) fail_number(place);
    values[count] = *value;
  }
  if (count == values.size()) return;
  if (stands_for_no_number(fields_[place])) fail_number(place);
  const char other = decimal_ == '.' ? ',' : '.';
  const bool other_reads =
      reads_as_number(fields_[place], other) && !reads_as_number(fields_[place], decimal_);
  fail_field(place, "is " + in_quotes(fields_[place]) + ", not " + std::to_string(values.size()) + " numbers",
             other_reads ? number_remedy(fields_[place], decimal_, line_) : kCorrectLine);
}

}  // namespace herr
