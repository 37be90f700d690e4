#include "sessions/files/append_file.h"

#include <utility>

namespace herr {
namespace {

// Bytes after the last line end.
std::size_t torn_bytes(std::string_view written) {
  const std::size_t line_end = written.rfind('\n');
  return line_end == std::string_view::npos ? written.size() : written.size() - line_end - 1;
}

}  // namespace

AppendFile::AppendFile(std::filesystem::path file)
    : path_(std::move(file)), file_(path_, path_, OutputFile::Opening::make_for_append) {}

AppendFile::AppendFile(std::filesystem::path file, std::int64_t kept_bytes)
    : path_(std::move(file)), file_(path_, path_, OutputFile::Opening::append) {
  file_.cut(kept_bytes);
}

void AppendFile::append(std::string_view rows) {
  rows_ += rows;
}

void AppendFile::flush() {
  std::size_t written = 0;
  try {
    file_.write(rows_, written);
  } catch (const WriteError&) {
    // Best effort: readers drop a last line that was cut off.
    file_.take_back(torn_bytes(std::string_view(rows_).substr(0, written)));
    throw;
  }
  rows_.clear();
}

void AppendFile::sync() {
  flush();
  file_.sync();
}

void AppendFile::finish() {
  sync();
  file_.close();
}

}  // namespace herr
