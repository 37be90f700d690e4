#include "sessions/record/append_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace herr {
namespace {

// fsync fails so on things that cannot be synced (some network folders): nothing is lost.
bool cannot_be_synced(int error_number) {
  return error_number == EINVAL || error_number == ENOTSUP;
}

}  // namespace

AppendFile::AppendFile(std::filesystem::path file) : path_(std::move(file)) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw WriteError(path_, "create", errno);
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
    if (written < 0) throw WriteError(path_, "write", errno);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  rows_.clear();
}

void AppendFile::finish() {
  flush();
  if (::fsync(descriptor_) != 0 && !cannot_be_synced(errno)) throw WriteError(path_, "sync", errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) throw WriteError(path_, "close", errno);
}

void sync_recorded_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw WriteError(folder, "open", errno);
  const bool synced = ::fsync(descriptor) == 0 || cannot_be_synced(errno);
  const int error_number = errno;
  ::close(descriptor);
  if (!synced) throw WriteError(folder, "sync", error_number);
}

}  // namespace herr
