#include "sessions/files/folder_lock.h"

#include <fcntl.h>

#include <cerrno>
#include <utility>

#include "sessions/files/system/file_system.h"
#include "sessions/files/write_error.h"

namespace herr {

FolderLock::FolderLock(Descriptor folder) : folder_(std::move(folder)) {}

std::optional<FolderLock> FolderLock::take(const std::filesystem::path& folder) {
  OpenedFile opened = open_file(folder, O_RDONLY | O_DIRECTORY);
  if (opened.error != 0) throw WriteError(folder, "open", opened.error);
  if (file_system().lock(opened.descriptor.get()) == -EWOULDBLOCK) return std::nullopt;
  return FolderLock(std::move(opened.descriptor));
}

}  // namespace herr
