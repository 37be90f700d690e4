#include "sessions/files/durability.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace herr {
namespace {

// 0 when the disk has it. fsync fails with EINVAL or ENOTSUP on what cannot be synced (pipes, some network
// folders): nothing is lost.
int sync_error(int descriptor) {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP) return 0;
  return errno;
}

}  // namespace

void sync_file(int descriptor, const std::filesystem::path& file) {
  if (const int error = sync_error(descriptor); error != 0) throw WriteError(file, "sync", error);
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw WriteError(folder, "open", errno);
  const int error = sync_error(descriptor);
  ::close(descriptor);
  if (error != 0) throw WriteError(folder, "sync", error);
}

}  // namespace herr
