// A session's folder that appears under its name only when it is complete: made beside it, renamed at the
// end; and what every new session has in common. Before: `herr convert` and `herr synth` ask for it. After:
// OUT stands whole, or as it was before.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sessions/session.h"

namespace herr {

// Not thread-safe.
class NewSessionFolder {
 public:
  // Throws UsageError when `out` is a link, or exists and is not empty, unless it may be overwritten and
  // holds a session and nothing else: whatever else lies there would be lost.
  NewSessionFolder(std::filesystem::path out, bool overwrite);
  // Removes what was made, the folders above it too, unless it was kept.
  ~NewSessionFolder();
  NewSessionFolder(const NewSessionFolder&) = delete;
  NewSessionFolder& operator=(const NewSessionFolder&) = delete;

  const std::filesystem::path& path() const { return temporary_; }  // where to write
  std::string name() const { return out_.filename().string(); }     // of the finished folder
  // A message about the unfinished folder, with the name that the user asked for.
  std::string with_final_name(std::string text) const;
  // What replay would say of the session: opens it. Throws InputError about path().
  SessionFindings findings() const;
  // Renames to the final name; an overwritten session goes. Throws WriteError.
  void keep();

 private:
  void remove_made_parents() const;

  std::filesystem::path out_, temporary_;
  std::vector<std::filesystem::path> made_parents_;  // innermost first
  bool kept_ = false;
};

// Named after the folder, eyes 63 mm apart.
SessionHeader new_session_header(const NewSessionFolder& folder);

// Throws UsageError when `scene`, the value of `flag`, is an absolute path: it would not move with the
// session.
void check_scene_name(const std::string& flag, const std::string& scene);

// "000012.png": pictures sort by name.
std::string numbered_picture(std::size_t index, const std::string& extension);

}  // namespace herr
