#include "sessions/files/system/descriptor.h"

#include <cerrno>
#include <utility>

#include "sessions/files/system/file_system.h"

namespace herr {
namespace {

template <class Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result == -EINTR) result = call();
  return result;
}

}  // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this == &other) return *this;
  close();
  descriptor_ = std::exchange(other.descriptor_, -1);
  return *this;
}

Descriptor::~Descriptor() {
  close();
}

int Descriptor::close() noexcept {
  if (descriptor_ < 0) return 0;
  const int result = file_system().close(std::exchange(descriptor_, -1));
  // Linux has let go of the descriptor even then: closing again could hit somebody else's file.
  return result == -EINTR ? 0 : -result;
}

OpenedFile open_file(const std::filesystem::path& path, int flags) {
  const int result = uninterrupted([&] { return file_system().open(path.c_str(), flags); });
  if (result < 0) return {Descriptor(), -result};
  return {Descriptor(result), 0};
}

OpenedFile open_for_reading(const std::filesystem::path& path) {
  return open_file(path, kReadFlags);
}

int write_all(int descriptor, const void* bytes, std::size_t count, std::size_t* written) {
  const char* rest = static_cast<const char*>(bytes);
  std::size_t done = 0;
  int error = 0;
  while (done < count && error == 0) {
    const ssize_t taken =
        uninterrupted([&] { return file_system().write(descriptor, rest + done, count - done); });
    if (taken > 0) done += static_cast<std::size_t>(taken);
    if (taken < 0) error = static_cast<int>(-taken);
    if (taken == 0) error = EIO;  // nothing taken and no reason: asking again could go on for ever
  }
  if (written != nullptr) *written = done;
  return error;
}

int cut_to(int descriptor, std::int64_t bytes) {
  return -uninterrupted([&] { return file_system().truncate(descriptor, static_cast<off_t>(bytes)); });
}

int sync_to_disk(int descriptor) {
  const int error = -uninterrupted([&] { return file_system().sync(descriptor); });
  return error == EINVAL || error == ENOTSUP ? 0 : error;
}

std::int64_t read_all(int descriptor, void* bytes, std::size_t count, std::int64_t offset) {
  char* next = static_cast<char*>(bytes);
  std::size_t done = 0;
  while (done < count) {
    const auto at = static_cast<off_t>(offset) + static_cast<off_t>(done);
    const ssize_t got =
        uninterrupted([&] { return file_system().read_at(descriptor, next + done, count - done, at); });
    if (got < 0) return got;
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return static_cast<std::int64_t>(done);
}

}  // namespace herr
