#include "scenes/gltf/contained_folder.h"

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "sessions/input_error.h"

namespace herr {
namespace {

// O_NONBLOCK: opening a pipe must not wait for a writer; it has no effect on regular files.
constexpr int kOpenFlags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;

// A file descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void fail_open(const std::filesystem::path& file, int error) {
  const std::string reason = std::generic_category().message(error);
  throw InputError(file, 0, "cannot be opened (" + reason + ")", "check the path and its permissions");
}

[[noreturn]] void fail_outside(const std::filesystem::path& file) {
  throw InputError(file, 0, "lies outside the folder of the glTF file that names it",
                   "copy it into that folder and name it without \"..\" or a leading \"/\"");
}

std::vector<unsigned char> read_descriptor(int fd, const std::filesystem::path& file,
                                           std::int64_t max_bytes) {
  struct stat status {};
  if (::fstat(fd, &status) != 0) fail_open(file, errno);
  if (!S_ISREG(status.st_mode)) throw InputError(file, 0, "is not a regular file", "name a file");
  if (status.st_size > max_bytes) {
    throw InputError(file, 0,
                     "has " + std::to_string(status.st_size) + " bytes, at most " +
                         std::to_string(max_bytes) + " are accepted",
                     "split or shrink the model");
  }
  // The size seen at opening is what is read: a file that grows meanwhile cannot exceed the limit.
  std::vector<unsigned char> bytes(static_cast<std::size_t>(status.st_size));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(fd, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      throw InputError(file, 0, "cannot be read (" + std::generic_category().message(errno) + ")",
                       "check the disk");
    }
    if (count == 0) throw InputError(file, 0, "became shorter while it was read", "try again");
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

// Fallback: both paths with every link resolved, compared component by component.
int open_by_prefix(const std::filesystem::path& folder, const std::string& relative,
                   const std::filesystem::path& file) {
  std::error_code error;
  const auto base = std::filesystem::canonical(folder, error);
  if (error) fail_open(folder, error.value());
  const auto target = std::filesystem::canonical(base / relative, error);
  if (error) fail_open(file, error.value());
  const auto split = std::mismatch(base.begin(), base.end(), target.begin(), target.end());
  if (split.first != base.end()) fail_outside(file);
  return ::open(target.c_str(), kOpenFlags | O_NOFOLLOW);
}

}  // namespace

std::vector<unsigned char> read_regular_file(const std::filesystem::path& file, std::int64_t max_bytes) {
  const Descriptor descriptor(::open(file.c_str(), kOpenFlags));
  if (descriptor.get() < 0) fail_open(file, errno);
  return read_descriptor(descriptor.get(), file, max_bytes);
}

ContainedFolder::ContainedFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
  if (folder_.empty()) folder_ = ".";
  folder_fd_ = ::open(folder_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (folder_fd_ < 0) fail_open(folder_, errno);
}

ContainedFolder::~ContainedFolder() {
  ::close(folder_fd_);
}

std::vector<unsigned char> ContainedFolder::read(const std::string& relative, std::int64_t max_bytes) const {
  const std::filesystem::path file = folder_ / std::filesystem::path(relative).relative_path();
  // A NUL byte would end the name early for the kernel: another file than the one that was checked.
  if (relative.find('\0') != std::string::npos) {
    throw InputError(file, 0, "the name holds a NUL byte", "rename the file");
  }
  struct open_how how {};
  how.flags = static_cast<std::uint64_t>(kOpenFlags);
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  int fd = static_cast<int>(::syscall(SYS_openat2, folder_fd_, relative.c_str(), &how, sizeof(how)));
  if (fd < 0 && (errno == ENOSYS || errno == EPERM)) {
    if (std::filesystem::path(relative).is_absolute()) fail_outside(file);
    fd = open_by_prefix(folder_, relative, file);
  }
  const int error = errno;
  const Descriptor descriptor(fd);
  if (fd < 0 && error == EXDEV) fail_outside(relative);
  if (fd < 0) fail_open(file, error);
  return read_descriptor(descriptor.get(), file, max_bytes);
}

}  // namespace herr
