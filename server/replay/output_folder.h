// The folder that one session's results go to, and the names in it.
// Before: replay_command. After: the writers of pictures, frames.csv and summary.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "server/replay/replay_options.h"

namespace herr {

// The last part of the session's path, symbolic links and dots resolved ("." is the current folder's name).
std::string session_folder_name(const std::filesystem::path& session);

class OutputFolder {
 public:
  // OUT/<session name>. Nothing is touched yet.
  OutputFolder(const std::filesystem::path& out, const std::filesystem::path& session);

  // Throws UsageError when the folder lies inside the session, is not a folder, or is not empty and may not
  // be overwritten. Reads only.
  void check(bool overwrite) const;
  // Makes the folders; with leftovers of an earlier replay, removes those (and nothing else).
  // Throws UsageError where the folder cannot be made, WriteError when the disk refuses.
  void prepare(PictureFormat format) const;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path frames_folder() const { return path_ / "frames"; }
  std::filesystem::path frames_csv() const { return path_ / "frames.csv"; }
  std::filesystem::path summary_json() const { return path_ / "summary.json"; }
  std::filesystem::path picture(std::int64_t frame, const std::string& suffix) const;  // frame_000060<suffix>
  std::filesystem::path contact_sheet(std::int64_t frame) const;

 private:
  void remove_earlier_results() const;

  std::filesystem::path session_, path_;
};

// True for the names that a replay writes into its folder ("frames.csv", "frame_000000.exr", ...) and for
// temporary files that a process which no longer runs left behind.
bool is_replay_result(const std::string& file_name);

}  // namespace herr
