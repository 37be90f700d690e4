// Rows of a file that some other program wrote, as fields at places: one pass, bounded memory. The two kinds
// are delimited_table (text with separators) and xml_rows (one element a row).
// Before: a file, TableFormat. After: rows/ reads values from the fields.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/import/map/column_map.h"

namespace herr {

// What was passed over or repaired while rows were cut into fields.
struct RowSourceCounts {
  std::int64_t blank_lines = 0;
  std::int64_t repeated_headers = 0;  // lines that name the columns again, or a first line without numbers
  std::int64_t ragged_rows = 0;       // more or fewer fields than the header names, beyond the columns in use
};

class RowSource {
 public:
  virtual ~RowSource() = default;
  RowSource(const RowSource&) = delete;
  RowSource& operator=(const RowSource&) = delete;

  virtual bool has(const ColumnRef& column) const = 0;
  // The place of a column, to be asked before the first row. Throws InputError that names the nearest column.
  virtual std::size_t place(const ColumnRef& column) = 0;
  // Goes to the next row; false at the end. Throws InputError when a row is not whole; the call after that
  // goes on with the following row.
  virtual bool next() = 0;

  // Fields of the current row. Only places that were asked for hold text.
  std::string_view text(std::size_t place) const { return fields_[place]; }
  // Empty, or one of the words that programs write for no number: nan, -nan(ind), NULL ...
  bool absent(std::size_t place) const;
  double number(std::size_t place) const;  // finite; throws InputError that says what was found
  // As many numbers as `values` of a field like "(1.0, 2.0, 3.0)".
  void numbers(std::size_t place, std::span<double> values) const;

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
  [[noreturn]] void fail_field(std::size_t place, const std::string& problem,
                               const std::string& remedy) const;

  std::int64_t line() const { return line_; }  // of the row's beginning, from 1
  const std::filesystem::path& path() const { return path_; }
  // What a line above the rows calls the column of this number (from 1), also where the map does not ask for
  // names: a header line or a comment. Empty: nothing.
  std::string_view told_name(std::size_t number) const {
    return number > 0 && number <= told_names_.size() ? std::string_view(told_names_[number - 1])
                                                      : std::string_view();
  }
  std::int64_t told_line() const { return told_line_; }
  const RowSourceCounts& counts() const { return counts_; }
  // After the end: what the file holds after the last whole row, else empty. It is not a row.
  const std::string& cut_off() const { return cut_off_; }
  char decimal() const { return decimal_; }

 protected:
  RowSource(std::filesystem::path path, char decimal) : path_(std::move(path)), decimal_(decimal) {}

  std::filesystem::path path_;
  char decimal_;
  std::vector<std::string> names_;  // of the columns, where there is a header
  std::vector<std::string> told_names_;
  std::int64_t told_line_ = 0;
  std::vector<std::string_view> fields_;
  std::int64_t line_ = 0;
  RowSourceCounts counts_;
  std::string cut_off_;

 private:
  [[noreturn]] void fail_number(std::size_t place) const;
};

// Opens the file and reads what comes before its first row. `wanted`: all columns that will be asked for;
// where separator or decimal sign are to be found in the file, those with which all of them are there. Throws
// InputError.
std::unique_ptr<RowSource> open_rows(const std::filesystem::path& file, const TableFormat& format,
                                     std::span<const ColumnRef> wanted);

}  // namespace herr
