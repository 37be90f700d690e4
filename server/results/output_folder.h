// The folder that one session's results go to, and the names in it.
// Before: replay_command. After: the writers of pictures, frames.csv and summary.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/settings/replay_options.h"
#include "sessions/files/folder_lock.h"

namespace herr {

// The last part of the session's path, symbolic links and dots resolved ("." is the current folder's name).
std::string session_folder_name(const std::filesystem::path& session);

// What becomes of the results of an earlier replay.
enum class EarlierResults { refuse, replace, resume };

class OutputFolder {
 public:
  // OUT/<session name>. Nothing is touched yet.
  OutputFolder(const std::filesystem::path& out, const std::filesystem::path& session);

  // Throws UsageError when the folder lies inside the session, is not a folder, is not empty and may not be
  // touched, or has results that cannot be gone on with. Reads only.
  void check(EarlierResults earlier) const;
  // True where no results lie, nor anything else: the folder is missing, empty, or has only the summary.json
  // of a session that was refused before its first frame. Such a folder is as good as an empty one.
  bool is_free() const;
  // Makes the folders, keeps other processes out, and removes the results of an earlier replay, or only the
  // temporary files that one left (resume), and nothing else. Throws UsageError where the folder cannot be
  // made, WriteError when the disk refuses, TemporaryError when another process writes there.
  FolderLock prepare(PictureFormats formats, EarlierResults earlier) const;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path frames_folder() const { return path_ / "frames"; }
  std::filesystem::path frames_csv() const { return path_ / "frames.csv"; }
  std::filesystem::path summary_json() const { return path_ / "summary.json"; }
  std::filesystem::path checkpoint_json() const { return path_ / "checkpoint.json"; }
  std::filesystem::path picture(std::int64_t frame, const std::string& suffix) const;  // frame_000060<suffix>
  std::filesystem::path contact_sheet(std::int64_t frame) const;

 private:
  std::vector<std::filesystem::path> earlier_results() const;

  std::filesystem::path session_, path_;
};

// True for the names that a replay writes into its folder ("frames.csv", "frame_000000.exr", ...) and for
// temporary files that a process which no longer runs left behind.
bool is_replay_result(const std::string& file_name);
// Only the latter.
bool is_replay_leftover(const std::string& file_name);

}  // namespace herr
