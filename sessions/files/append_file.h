// A file that only grows, by whole rows: what is on the disk is always a beginning of what was appended.
// Before: session_recorder formats rows. After: the stream readers, which drop a last line that was cut off.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "sessions/files/output_file.h"

namespace herr {

// Not thread-safe. Every function throws WriteError.
class AppendFile {
 public:
  // Creates the file; one of that name must not exist.
  explicit AppendFile(std::filesystem::path file);
  // Goes on after the first `kept_bytes` of a file (a line end); what follows them is cut off. A file that is
  // not there is made, for kept_bytes 0.
  AppendFile(std::filesystem::path file, std::int64_t kept_bytes);
  // Rows that were not flushed are lost with the object: a destructor could not report a full disk.

  // Takes whole rows, each with its line end; they reach the file at the next flush.
  void append(std::string_view rows);
  // A row that the disk took only a part of is taken back, if the disk lets us.
  void flush();
  // Flushes and waits for the disk.
  void sync();
  // Flushes, waits for the disk, and closes the file.
  void finish();

  std::size_t unflushed_bytes() const { return rows_.size(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  OutputFile file_;
  std::string rows_;
};

}  // namespace herr
