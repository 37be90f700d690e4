// One process at a time writes into a folder: two that append to one frames.csv would spoil it.
// Before: the output folder was made. After: the writers. The lock ends with the process, however it ends.
#pragma once

#include <filesystem>

namespace herr {

class FolderLock {
 public:
  // Throws TemporaryError when another process has the lock. Where the file system knows no locks there is
  // none.
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

}  // namespace herr
