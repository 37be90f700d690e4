#include "server/study/relations/recording_folder.h"

#include <unistd.h>

#include <string>
#include <system_error>

#include "sessions/files/folders.h"
#include "sessions/files/write_error.h"

namespace herr {
namespace {

constexpr int kMostLeftBehind = 1000;  // by processes of this number that were killed

}  // namespace

RecordingFolder::RecordingFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) throw WriteError("TMPDIR", "find the folder that it names", error.value());
  const std::string name = "herr-relations-" + std::to_string(::getpid()) + "-";
  for (int number = 1; number <= kMostLeftBehind; ++number) {
    path_ = parent / (name + std::to_string(number));
    error = make_folder(path_);
    if (error != std::errc::file_exists) break;
  }
  if (error)
    throw WriteError(parent, "make a folder for recordings in it (TMPDIR names another)", error.value());
}

RecordingFolder::~RecordingFolder() {
  remove_tree(path_);
}

}  // namespace herr
