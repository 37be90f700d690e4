// The folder of a study: what stands in it, what an earlier study may leave there. Before: study_command.
// After: study_run appends and replaces its files.
#pragma once

#include <filesystem>

#include "sessions/files/folder_lock.h"

namespace herr {

class StudyFolder {
 public:
  explicit StudyFolder(std::filesystem::path path) : path_(std::move(path)) {}

  // Makes it and keeps other processes out. What an earlier study left is refused, removed (`overwrite`) or
  // kept (`resume`); references stay. Other files stay as they are; where there are only others the folder is
  // refused. Throws UsageError, WriteError, TemporaryError.
  FolderLock prepare(bool overwrite, bool resume) const;

  std::filesystem::path csv() const { return path_ / "study.csv"; }
  std::filesystem::path json() const { return path_ / "study.json"; }
  std::filesystem::path page() const { return path_ / "study.html"; }
  std::filesystem::path state() const { return path_ / "study.state.json"; }
  std::filesystem::path references() const { return path_ / "references"; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace herr
