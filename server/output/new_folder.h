// A folder that appears under its name only when it is complete: made beside it, renamed at the end.
// Before: a command knows where its results shall stand. After: they stand there whole, or nothing changed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace herr {

// Not thread-safe.
class NewFolder {
 public:
  struct Request {
    std::filesystem::path out;
    bool overwrite = false;  // `out` may hold an earlier result
    std::string flag;        // begins every message: "OUT", "--probe-pictures"
    std::string example;     // of a good name
    // Throws UsageError when the folder, which is not empty, holds anything but an earlier result.
    std::function<void(const std::filesystem::path&)> check_overwritable;
  };
  // Throws UsageError when `out` is a link, no folder, or not empty and may not be overwritten.
  explicit NewFolder(Request request);
  // Removes what was made, the folders above it too, unless it was kept.
  ~NewFolder();
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  const std::filesystem::path& path() const { return temporary_; }  // where to write
  const std::filesystem::path& final_path() const { return request_.out; }
  // Renames to the final name; what was there goes. Throws WriteError.
  void keep();

 private:
  void remove_made_parents() const;

  Request request_;
  std::filesystem::path temporary_;
  std::vector<std::filesystem::path> made_parents_;  // innermost first
  bool kept_ = false;
};

}  // namespace herr
