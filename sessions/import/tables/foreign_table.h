// Rows of a table that some other program wrote: any separator, with or without a header line, comments,
// quotes, blank lines. Before: LineReader. After: import_rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/files/line_reader.h"
#include "sessions/import/map/column_map.h"

namespace herr {

class ForeignTable {
 public:
  // Opens the file and reads its header line. Throws InputError.
  ForeignTable(const std::filesystem::path& file, const TableFormat& format);

  bool has(const ColumnRef& column) const;
  // The place of a column. Throws InputError that names the nearest column there is.
  std::size_t place(const ColumnRef& column) const;

  // Goes to the next row; false at the end. Throws InputError when a line has another number of fields; the
  // call after that goes on with the following line.
  bool next();
  std::string_view text(std::size_t place) const { return fields_[place]; }
  double number(std::size_t place) const;  // finite
  // `count` numbers of a field like "(1.0, 2.0, 3.0)".
  std::vector<double> numbers(std::size_t place, std::size_t count) const;

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
  [[noreturn]] void fail_field(std::size_t place, const std::string& problem,
                               const std::string& remedy) const;

  std::int64_t line() const { return line_.number; }
  const std::filesystem::path& path() const { return reader_.path(); }
  std::int64_t blank_lines() const { return blank_lines_; }
  // After the end: the last line where the file ends within it, else empty. It is not a row.
  const std::string& cut_off() const { return cut_off_; }

 private:
  bool next_line();
  void split(std::string_view line);
  double number_in(std::string_view text, std::size_t place) const;

  TableFormat format_;
  LineReader reader_;
  TextLine line_;
  bool waiting_ = false;  // the constructor has read the first row already
  std::vector<std::string> names_;
  std::size_t columns_ = 0;
  std::vector<std::string_view> fields_;
  std::int64_t blank_lines_ = 0;
  std::string cut_off_;
};

}  // namespace herr
