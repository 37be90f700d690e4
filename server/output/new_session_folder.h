// The folder of a new session, which appears under its name only when it is complete; and what every new
// session has in common. Before: `herr convert` and `herr synth` ask for it. After: OUT stands whole, or as
// it was before.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "server/output/new_folder.h"
#include "sessions/session.h"

namespace herr {

// Not thread-safe.
class NewSessionFolder {
 public:
  // Throws UsageError when `out` is a link, or exists and is not empty, unless it may be overwritten and
  // holds a session and nothing else: whatever else lies there would be lost.
  NewSessionFolder(std::filesystem::path out, bool overwrite);

  const std::filesystem::path& path() const { return folder_.path(); }  // where to write
  std::string name() const { return folder_.final_path().filename().string(); }
  // A message about the unfinished folder, with the name that the user asked for.
  std::string with_final_name(std::string text) const;
  // What replay would say of the session: opens it. Throws InputError about path().
  SessionFindings findings() const;
  // Renames to the final name; an overwritten session goes. Throws WriteError.
  void keep() { folder_.keep(); }

 private:
  NewFolder folder_;
};

// Named after the folder, eyes 63 mm apart.
SessionHeader new_session_header(const NewSessionFolder& folder);

// Throws UsageError when `scene`, the value of `flag`, is an absolute path: it would
// not move with the session.
void check_scene_name(const std::string& flag, const std::string& scene);

// The file of a scene that session.json will name, seen from the session's folder as replay will look for it.
// Throws UsageError where there is none.
std::filesystem::path scene_beside(const NewSessionFolder& folder, const std::string& flag,
                                   const std::string& scene);

// "000012.png": pictures sort by name.
std::string numbered_picture(std::size_t index, const std::string& extension);

}  // namespace herr
