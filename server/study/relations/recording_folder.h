// A folder for a recording that a relation makes, among the system's temporary files; gone with the object.
// Before: stamps_relations, prediction_relations. After: Session::open reads what was written there.
#pragma once

#include <filesystem>

namespace herr {

class RecordingFolder {
 public:
  RecordingFolder();  // throws WriteError
  ~RecordingFolder();
  RecordingFolder(const RecordingFolder&) = delete;
  RecordingFolder& operator=(const RecordingFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace herr
