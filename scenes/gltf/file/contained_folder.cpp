#include "scenes/gltf/file/contained_folder.h"

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

#include "sessions/files/input_error.h"

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

// What an error is about: the file itself, or the file that names another ("names "a.bin", which").
struct Subject {
  std::filesystem::path file;
  std::string prefix;

  InputError error(const std::string& problem, const std::string& remedy) const {
    return InputError(file, 0, prefix + problem, remedy);
  }
};

InputError open_error(const Subject& subject, int error) {
  return subject.error("cannot be opened (" + std::generic_category().message(error) + ")",
                       "check the path and its permissions");
}

InputError outside_error(const Subject& subject) {
  return subject.error("lies outside the folder of the file that names it",
                       "copy it into that folder and name it without \"..\" or a leading \"/\"");
}

std::vector<unsigned char> read_descriptor(int fd, const Subject& subject, std::int64_t max_bytes) {
  struct stat status {};
  if (::fstat(fd, &status) != 0) throw open_error(subject, errno);
  if (!S_ISREG(status.st_mode)) throw subject.error("is not a regular file", "name a file");
  if (status.st_size > max_bytes) {
    throw subject.error("has " + std::to_string(status.st_size) + " bytes, at most " +
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
      throw subject.error("cannot be read (" + std::generic_category().message(errno) + ")",
                          "check the disk");
    }
    if (count == 0) throw subject.error("became shorter while it was read", "try again");
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

// Fallback: both paths with every link resolved, compared component by component.
int open_by_prefix(const std::filesystem::path& folder, const std::string& relative, const Subject& subject) {
  std::error_code error;
  const auto base = std::filesystem::canonical(folder, error);
  if (error) throw open_error(subject, error.value());
  const auto target = std::filesystem::canonical(base / relative, error);
  if (error) throw open_error(subject, error.value());
  const auto split = std::mismatch(base.begin(), base.end(), target.begin(), target.end());
  if (split.first != base.end()) throw outside_error(subject);
  return ::open(target.c_str(), kOpenFlags | O_NOFOLLOW);
}

}  // namespace

std::vector<unsigned char> read_regular_file(const std::filesystem::path& file, std::int64_t max_bytes) {
  const Subject subject{file, ""};
  const Descriptor descriptor(::open(file.c_str(), kOpenFlags));
  if (descriptor.get() < 0) throw open_error(subject, errno);
  return read_descriptor(descriptor.get(), subject, max_bytes);
}

ContainedFolder::ContainedFolder(const std::filesystem::path& owner)
    : owner_(owner), folder_(owner.has_parent_path() ? owner.parent_path() : ".") {
  folder_fd_ = ::open(folder_.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (folder_fd_ < 0) throw open_error({folder_, ""}, errno);
}

ContainedFolder::~ContainedFolder() {
  ::close(folder_fd_);
}

std::vector<unsigned char> ContainedFolder::read(const std::string& relative, std::int64_t max_bytes) const {
  const Subject subject{owner_, "names \"" + printable(relative) + "\", which "};
  // A NUL byte would end the name early for the kernel: another file than the one that was checked.
  if (relative.find('\0') != std::string::npos) throw subject.error("holds a NUL byte", "rename the file");
  struct open_how how {};
  how.flags = static_cast<std::uint64_t>(kOpenFlags);
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  int fd = static_cast<int>(::syscall(SYS_openat2, folder_fd_, relative.c_str(), &how, sizeof(how)));
  if (fd < 0 && (errno == ENOSYS || errno == EPERM)) {
    if (std::filesystem::path(relative).is_absolute()) throw outside_error(subject);
    fd = open_by_prefix(folder_, relative, subject);
  }
  const int error = errno;
  const Descriptor descriptor(fd);
  if (fd < 0 && error == EXDEV) throw outside_error(subject);
  if (fd < 0) throw open_error(subject, error);
  std::vector<unsigned char> bytes = read_descriptor(descriptor.get(), subject, max_bytes);
  if (bytes.empty()) throw subject.error("is empty", "copy the file again");
  return bytes;
}

}  // namespace herr
