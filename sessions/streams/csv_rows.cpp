#include "sessions/streams/csv_rows.h"

#include <algorithm>
#include <charconv>

#include "sessions/files/input_error.h"
#include "sessions/files/nearest_name.h"
#include "sessions/format/session_header.h"
#include "sessions/streams/field_text.h"

namespace herr {
namespace {

// Nine columns of 25 digits take 234 bytes; trackers add a few dozen columns.
constexpr std::size_t kMaxLineBytes = 8192;
constexpr std::size_t kMaxFields = 256;

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

}  // namespace

CsvRows::CsvRows(const std::filesystem::path& file, const CsvLayout& layout)
    : reader_(file, kMaxLineBytes), columns_(layout.columns) {
  if (reader_.empty()) throw InputError(path(), 0, "is empty", "it starts with the line " + joined(columns_));
  read_header(layout);
}

void CsvRows::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(path(), line_.number, problem, remedy);
}

void CsvRows::fail_field(std::size_t column, const std::string& problem, const std::string& remedy) const {
  fail("column " + columns_[column] + " " + problem, remedy);
}

void CsvRows::split(std::string_view text) {
  fields_.clear();
  for (;;) {
    const std::size_t comma = text.find(',');
    fields_.push_back(trimmed(text.substr(0, comma)));
    if (comma == std::string_view::npos || fields_.size() > kMaxFields) return;
    text.remove_prefix(comma + 1);
  }
}

void CsvRows::read_header(const CsvLayout& layout) {
  const std::string expected = "it should read " + joined(columns_);
  if (!reader_.next(line_)) fail("has no header line", expected);
  if (line_.text.find('\0') != std::string_view::npos)
    fail("holds NUL bytes", "save it as UTF-8 text, not UTF-16");
  if (!line_.whole) fail("the header line is cut off", "record the session again; " + expected);
  if (line_.too_long) fail("the header line is longer than 8192 bytes", expected);
  split(line_.text);
  fields_expected_ = fields_.size();
  for (const char other : {';', '\t'}) {
    if (columns_.size() > 1 && fields_expected_ == 1 && line_.text.find(other) != std::string_view::npos)
      fail(std::string("the fields are separated by ") + (other == ';' ? "';'" : "tabs"),
           "write commas: " + expected);
  }
  const std::vector<std::string> found(fields_.begin(), fields_.end());
  std::vector<std::string> unknown;
  for (const std::string& name : found)
    if (std::find(columns_.begin(), columns_.end(), name) == columns_.end()) unknown.push_back(name);
  for (const std::string& column : columns_) {
    const auto place = std::find(found.begin(), found.end(), column);
    if (place == found.end()) {
      const std::string nearest = nearest_name(column, unknown);
      fail("the header line has no column " + column +
               (nearest.empty() ? "" : " (is it " + in_quotes(nearest) + "?)"),
           expected);
    }
    if (std::find(place + 1, found.end(), column) != found.end())
      fail("the header line names column " + column + " twice", expected);
    place_.push_back(static_cast<std::size_t>(place - found.begin()));
  }
  if (!layout.others_allowed && !unknown.empty())
    fail("the header line has an unknown column " + in_quotes(unknown.front()), expected);
}

bool CsvRows::next() {
  if (!reader_.next(line_)) return false;
  if (!line_.whole) {
    // Even when it looks complete: the last digits of its last number may be missing.
    cut_off_ = std::string(line_.text);
    return false;
  }
  if (line_.too_long) fail("the line is longer than 8192 bytes", "remove it");
  if (line_.text.empty()) fail("the line is empty", "remove it");
  split(line_.text);
  if (fields_.size() != fields_expected_)
    fail("the line has " + std::to_string(fields_.size()) + " fields where the header has " +
             std::to_string(fields_expected_),
         "correct or remove the line");
  return true;
}

std::string_view CsvRows::text(std::size_t column) const {
  return fields_[place_[column]];
}

double CsvRows::number(std::size_t column) const {
  const std::string_view field = text(column);
  const bool plain = begins_with_digits(field);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error == std::errc::result_out_of_range)
    fail_field(column, "is " + in_quotes(field) + ", out of range", "correct it");
  if (!plain || error != std::errc() || end != field.data() + field.size())
    fail_field(column, "is " + in_quotes(field) + ", not a finite number",
               "correct it; the decimal sign is a point");
  return value;
}

TimeNs CsvRows::stamp(std::size_t column) const {
  const std::string_view field = text(column);
  TimeNs value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  const bool out_of_range = error == std::errc::result_out_of_range;
  if (!out_of_range && (error != std::errc() || end != field.data() + field.size()))
    fail_field(column, "is " + in_quotes(field) + ", not a whole number",
               "write nanoseconds without fraction or exponent");
  if (out_of_range || value < 0 || value > kLastStampNs)
    fail_field(column, "is " + in_quotes(field) + ", out of range",
               "write nanoseconds from 0 to " + std::to_string(kLastStampNs));
  return value;
}

bool CsvRows::flag(std::size_t column) const {
  const std::string_view field = text(column);
  if (field != "0" && field != "1")
    fail_field(column, "is " + in_quotes(field), "write 0 (not valid) or 1 (valid)");
  return field == "1";
}

}  // namespace herr
