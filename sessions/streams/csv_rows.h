// Checked rows of a comma-separated file with a header line, read one at a time in bounded memory.
// Before: LineReader. After: stream_rows, which turns fields into poses, gaze and camera frames.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/files/line_reader.h"
#include "sessions/format/pose.h"

namespace herr {

struct CsvLayout {
  std::vector<std::string> columns;  // required, in any order in the file
  bool others_allowed = false;       // further columns are legal and ignored
};

class CsvRows {
 public:
  // Opens the file and checks its header line. Throws InputError.
  CsvRows(const std::filesystem::path& file, const CsvLayout& layout);

  // Goes to the next whole line; false at the end. Throws InputError when the line does not have the right
  // number of fields; the call after that goes on with the following line.
  bool next();

  // Fields of the current row by their place in the layout. Throw InputError that names column and line.
  std::string_view text(std::size_t column) const;
  double number(std::size_t column) const;  // finite, '.' as decimal point whatever the locale
  TimeNs stamp(std::size_t column) const;   // 0 ... kLastStampNs
  bool flag(std::size_t column) const;      // 0 or 1
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

  std::int64_t line() const { return line_.number; }
  const std::filesystem::path& path() const { return reader_.path(); }
  // After the end: what the last line held when the file ends in the middle of it, else empty.
  const std::string& cut_off() const { return cut_off_; }

 private:
  [[noreturn]] void fail_field(std::size_t column, const std::string& problem,
                               const std::string& remedy) const;
  void read_header(const CsvLayout& layout);
  void split(std::string_view text);

  LineReader reader_;
  TextLine line_;
  std::vector<std::string> columns_;  // of the layout
  std::vector<std::size_t> place_;    // field index in the file of each column of the layout
  std::size_t fields_expected_ = 0;
  std::vector<std::string_view> fields_;
  std::string cut_off_;
};

}  // namespace herr
