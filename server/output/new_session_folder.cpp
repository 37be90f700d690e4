#include "server/output/new_session_folder.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "server/process/exit_code.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

// What a session of format version 1 consists of; the pictures in camN/data are told by no name.
constexpr std::array<std::string_view, 12> kSessionEntries{
    "session.json", "events.jsonl",  "pose",      "pose/data.csv", "gaze",          "gaze/data.csv",
    "cam0",         "cam0/data.csv", "cam0/data", "cam1",          "cam1/data.csv", "cam1/data"};

// The first file in a session's folder that the format does not name. `folder`: relative to the session.
std::optional<fs::path> foreign_entry(const fs::path& session, const fs::path& folder,
                                      std::error_code& error) {
  for (const std::string& name : list_folder(session / folder, error)) {
    const fs::path entry = folder / name;
    if (std::find(kSessionEntries.begin(), kSessionEntries.end(), entry.generic_string()) ==
        kSessionEntries.end())
      return session / entry;
    if (name == "data" || facts_of_name(session / entry).kind != FileKind::folder) continue;
    if (auto found = foreign_entry(session, entry, error); found || error) return found;
  }
  return std::nullopt;
}

void check_overwritable(const fs::path& out) {
  const std::string shown = printable(out.string());
  if (!path_exists(out / "session.json"))
    throw UsageError("OUT: " + shown + " is not empty and no session; only a session is overwritten");
  std::error_code error;
  const auto foreign = foreign_entry(out, "", error);
  if (error)
    throw UsageError("OUT: cannot look into " + shown + ": " + error.message() + "; choose another folder");
  if (foreign)
    throw UsageError("OUT: " + printable(foreign->string()) +
                     " is no part of the session and would be lost; move it away or choose another folder");
}

}  // namespace

NewSessionFolder::NewSessionFolder(fs::path out, bool overwrite)
    : folder_({std::move(out), overwrite, "OUT", "sessions/walk", check_overwritable}) {}

std::string NewSessionFolder::with_final_name(std::string text) const {
  const std::string from = path().string(), to = folder_.final_path().string();
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

SessionFindings NewSessionFolder::findings() const {
  SessionFindings found = Session::open(path()).findings();
  for (std::string& warning : found.warnings) warning = with_final_name(warning);
  return found;
}

SessionHeader new_session_header(const NewSessionFolder& folder) {
  constexpr double kHalfIpdM = 0.0315;  // half the distance of an average adult's pupils
  SessionHeader header;
  header.name = printable(folder.name());
  header.head_from_eye[0].position = {-kHalfIpdM, 0, 0};
  header.head_from_eye[1].position = {kHalfIpdM, 0, 0};
  return header;
}

void check_scene_name(const std::string& flag, const std::string& scene) {
  if (fs::path(scene).is_absolute())
    throw UsageError(flag + ": is an absolute path; write it relative to OUT");
}

fs::path scene_beside(const NewSessionFolder& folder, const std::string& flag, const std::string& scene) {
  fs::path file = folder.path() / scene;
  if (!is_file(file))
    throw UsageError(flag + ": there is no file " + printable(folder.with_final_name(file.string())) +
                     "; write the path relative to OUT");
  return file;
}

std::string numbered_picture(std::size_t index, const std::string& extension) {
  const std::string digits = std::to_string(index);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits + extension;
}

}  // namespace herr
