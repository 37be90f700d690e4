#include "sessions/files/output_file.h"

#include <fcntl.h>

#include <utility>

#include "sessions/files/system/file_system.h"

namespace herr {
namespace {

int flags_of(OutputFile::Opening opening) {
  switch (opening) {
    case OutputFile::Opening::make:
      return O_WRONLY | O_CREAT | O_EXCL;
    case OutputFile::Opening::make_for_append:
      return O_WRONLY | O_CREAT | O_EXCL | O_APPEND;
    case OutputFile::Opening::append:
      return O_WRONLY | O_CREAT | O_APPEND;
  }
  return O_WRONLY;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, std::filesystem::path shown, Opening opening)
    : shown_(std::move(shown)) {
  OpenedFile opened = open_file(path, flags_of(opening));
  if (opened.error != 0)
    throw WriteError(shown_, opening == Opening::append ? "open" : "create", opened.error);
  descriptor_ = std::move(opened.descriptor);
}

void OutputFile::write(std::string_view bytes, std::size_t& written) {
  const int error = write_all(descriptor_.get(), bytes.data(), bytes.size(), &written);
  if (error != 0) throw WriteError(shown_, "write", error);
}

void OutputFile::write(std::string_view bytes) {
  std::size_t unused = 0;
  write(bytes, unused);
}

void OutputFile::cut(std::int64_t kept_bytes) {
  if (const int error = cut_to(descriptor_.get(), kept_bytes); error != 0)
    throw WriteError(shown_, "cut", error);
}

void OutputFile::take_back(std::size_t bytes) noexcept {
  struct stat status {};
  if (bytes == 0 || file_system().status(descriptor_.get(), status) < 0) return;
  const std::int64_t kept = std::int64_t{status.st_size} - static_cast<std::int64_t>(bytes);
  if (kept >= 0) cut_to(descriptor_.get(), kept);
}

void OutputFile::sync() {
  if (const int error = sync_to_disk(descriptor_.get()); error != 0) throw WriteError(shown_, "sync", error);
}

void OutputFile::close() {
  if (const int error = descriptor_.close(); error != 0) throw WriteError(shown_, "close", error);
}

}  // namespace herr
