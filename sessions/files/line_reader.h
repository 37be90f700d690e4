// Lines of a text file of any length in bounded memory. UTF-8 with or without byte-order mark, LF or CRLF.
// Before: InputFile. After: CsvRows and EventStream, which give the lines a meaning.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "sessions/files/input_file.h"

namespace herr {

struct TextLine {
  std::string_view text;    // without its line end; valid until the next line is read
  std::int64_t number = 0;  // 1-based
  bool whole = true;        // false: the file ended before the line did
  bool too_long = false;    // longer than allowed: `text` is only a part of it
};

class LineReader {
 public:
  // Throws InputError: what InputFile refuses, and UTF-16 (by its byte-order mark).
  LineReader(const std::filesystem::path& file, std::size_t max_line_bytes);
  // The next line, or false at the end of the file.
  bool next(TextLine& line);

  // Bytes of the file before the next line, a byte-order mark included.
  std::int64_t offset() const { return read_bytes_ - static_cast<std::int64_t>(end_ - begin_); }

  const std::filesystem::path& path() const { return file_.path(); }
  bool empty() const { return file_.size_bytes() == 0; }

 private:
  bool refill();
  void skip_byte_order_mark();

  InputFile file_;
  std::size_t max_line_bytes_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // unread bytes of the buffer
  std::int64_t line_ = 0, read_bytes_ = 0;
};

}  // namespace herr
