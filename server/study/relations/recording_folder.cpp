#include "server/study/relations/recording_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "sessions/files/folders.h"
#include "sessions/files/write_error.h"

namespace herr {

RecordingFolder::RecordingFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) throw WriteError("TMPDIR", "find the folder that it names", error.value());
  std::string pattern = (parent / "herr-relations-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw WriteError(parent, "make a folder for recordings in it (TMPDIR names another)", errno);
  path_ = pattern;
}

RecordingFolder::~RecordingFolder() {
  remove_tree(path_);
}

}  // namespace herr
