// The folder of a stability report. Before: stability_command. After: its files are written whole.
#pragma once

#include <filesystem>
#include <utility>

#include "sessions/files/folder_lock.h"

namespace herr {

class StabilityFolder {
 public:
  explicit StabilityFolder(std::filesystem::path path) : path_(std::move(path)) {}

  // Makes it and keeps other processes out. An earlier report is refused or removed; see claim_folder.
  FolderLock prepare(bool overwrite) const;

  std::filesystem::path json() const { return path_ / "stability.json"; }
  std::filesystem::path page() const { return path_ / "stability.html"; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace herr
