#include "sessions/files/append_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "sessions/files/durability.h"

namespace herr {
namespace {

// `written` is what reached the end of the file before the disk refused. Best effort: readers drop a last
// line that was cut off.
void take_back_torn_row(int descriptor, std::string_view written) {
  const std::size_t line_end = written.rfind('\n');
  const std::size_t torn =
      line_end == std::string_view::npos ? written.size() : written.size() - line_end - 1;
  const off_t end = ::lseek(descriptor, 0, SEEK_END);
  if (end >= static_cast<off_t>(torn) && torn > 0) {
    [[maybe_unused]] const int best_effort = ::ftruncate(descriptor, end - static_cast<off_t>(torn));
  }
}

}  // namespace

AppendFile::AppendFile(std::filesystem::path file) : path_(std::move(file)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw WriteError(path_, "create", errno);
}

AppendFile::AppendFile(std::filesystem::path file, std::int64_t kept_bytes) : path_(std::move(file)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw WriteError(path_, "open", errno);
  if (::ftruncate(descriptor_, kept_bytes) == 0) return;
  const int error = errno;
  ::close(std::exchange(descriptor_, -1));
  throw WriteError(path_, "cut", error);
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : path_(std::move(other.path_)),
      rows_(std::move(other.rows_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

AppendFile::~AppendFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void AppendFile::append(std::string_view rows) {
  rows_ += rows;
}

void AppendFile::flush() {
  std::string_view rest = rows_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      take_back_torn_row(descriptor_, std::string_view(rows_).substr(0, rows_.size() - rest.size()));
      throw WriteError(path_, "write", error);
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  rows_.clear();
}

void AppendFile::sync() {
  flush();
  sync_file(descriptor_, path_);
}

void AppendFile::finish() {
  sync();
  if (::close(std::exchange(descriptor_, -1)) != 0) throw WriteError(path_, "close", errno);
}

}  // namespace herr
