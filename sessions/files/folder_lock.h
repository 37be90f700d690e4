// One process at a time writes into a folder: two that append to one frames.csv would spoil it.
// Before: the output folder was made. After: the writers. The lock ends with the process, however it ends.
#pragma once

#include <filesystem>
#include <optional>

#include "sessions/files/system/descriptor.h"

namespace herr {

class FolderLock {
 public:
  // None while another process has the lock. Where the file system knows no locks everyone gets one. Throws
  // WriteError when the folder cannot be opened.
  static std::optional<FolderLock> take(const std::filesystem::path& folder);

 private:
  explicit FolderLock(Descriptor folder);

  Descriptor folder_;
};

}  // namespace herr
