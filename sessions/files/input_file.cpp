#include "sessions/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "sessions/files/input_error.h"

namespace herr {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int error) {
  // What the machine lacks for the moment is no fault of the file.
  if (error == EMFILE || error == ENFILE || error == ENOMEM)
    throw std::system_error(error, std::generic_category(), printable(path.string()) + ": " + what);
  const std::string reason = std::generic_category().message(error);
  throw InputError(path, 0, what + ": " + reason,
                   error == ENOENT ? "check the path" : "check the file and its permissions");
}

}  // namespace

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  if (path_.native().find('\0') != std::string::npos)
    throw InputError(path_, 0, "the path holds a NUL byte", "check the path");
  // O_NONBLOCK: opening a FIFO without a writer must not wait for one; regular files ignore it.
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor_ < 0) fail(path_, "cannot be opened", errno);
  struct stat status {};
  const bool known = ::fstat(descriptor_, &status) == 0;
  const int error = errno;
  if (known && S_ISREG(status.st_mode)) {
    size_bytes_ = unread_bytes_ = status.st_size;
    return;
  }
  ::close(std::exchange(descriptor_, -1));  // the destructor does not run when a constructor throws
  if (!known) fail(path_, "cannot be examined", error);
  throw InputError(path_, 0, S_ISDIR(status.st_mode) ? "is a folder, not a file" : "is not a regular file",
                   "name a file");
}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_bytes_(other.size_bytes_),
      unread_bytes_(other.unread_bytes_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  if (this == &other) return *this;
  if (descriptor_ >= 0) ::close(descriptor_);
  path_ = std::move(other.path_);
  descriptor_ = std::exchange(other.descriptor_, -1);
  size_bytes_ = other.size_bytes_;
  unread_bytes_ = other.unread_bytes_;
  return *this;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t InputFile::read(char* bytes, std::size_t capacity) {
  std::size_t done = 0;
  const auto wanted = static_cast<std::size_t>(std::min<std::int64_t>(
      unread_bytes_, static_cast<std::int64_t>(std::min(capacity, std::size_t{1} << 40))));
  while (done < wanted) {
    const ssize_t got = ::read(descriptor_, bytes + done, wanted - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path_, "cannot be read", errno);
    if (got == 0) {  // the file shrank after it was opened
      unread_bytes_ = static_cast<std::int64_t>(done);
      break;
    }
    done += static_cast<std::size_t>(got);
  }
  unread_bytes_ -= static_cast<std::int64_t>(done);
  return done;
}

int InputFile::release() {
  return std::exchange(descriptor_, -1);
}

std::string read_whole_file(const std::filesystem::path& path, std::int64_t max_bytes) {
  InputFile file(path);
  if (file.size_bytes() > max_bytes)
    throw InputError(path, 0,
                     "has " + std::to_string(file.size_bytes()) + " bytes, more than the limit of " +
                         std::to_string(max_bytes),
                     "check that this is the right file");
  std::string text(static_cast<std::size_t>(file.size_bytes()), '\0');
  text.resize(file.read(text.data(), text.size()));
  return text;
}

}  // namespace herr
