// A folder that appears under its name only when it is complete: made beside it, renamed at the end.
// Before: run_convert. After: OUT stands whole, or as it was before.
#pragma once

#include <filesystem>

namespace herr {

class NewSessionFolder {
 public:
  // Throws UsageError when `out` exists and is not empty, unless it is a session and may be overwritten.
  NewSessionFolder(std::filesystem::path out, bool overwrite);
  // Removes what was written unless it was kept.
  ~NewSessionFolder();
  NewSessionFolder(const NewSessionFolder&) = delete;
  NewSessionFolder& operator=(const NewSessionFolder&) = delete;

  const std::filesystem::path& path() const { return temporary_; }  // where to write
  // Renames to the final name; an overwritten session goes. Throws WriteError.
  void keep();

 private:
  std::filesystem::path out_, temporary_;
  bool kept_ = false;
};

}  // namespace herr
