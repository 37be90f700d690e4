#include "server/new_session/new_session_folder.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "server/cli/exit_code.h"
#include "server/output/atomic_file.h"
#include "sessions/input_error.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

fs::path beside(const fs::path& out, const std::string& suffix) {
  fs::path name = out;
  name += suffix + std::to_string(::getpid());
  return name;
}

void rename_folder(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw WriteError(to, "rename", error.value());
}

// What a session of format version 1 consists of; the pictures in camN/data are told by no name.
constexpr std::array<std::string_view, 12> kSessionEntries{
    "session.json", "events.jsonl",  "pose",      "pose/data.csv", "gaze",          "gaze/data.csv",
    "cam0",         "cam0/data.csv", "cam0/data", "cam1",          "cam1/data.csv", "cam1/data"};

// The first thing in a session's folder that is no part of the session.
std::optional<fs::path> foreign_entry(const fs::path& session) {
  for (auto entry = fs::recursive_directory_iterator(session); entry != fs::recursive_directory_iterator();
       ++entry) {
    const std::string name = entry->path().lexically_relative(session).generic_string();
    if (std::find(kSessionEntries.begin(), kSessionEntries.end(), name) == kSessionEntries.end())
      return entry->path();
    if (entry->path().filename() == "data") entry.disable_recursion_pending();
  }
  return std::nullopt;
}

void check_overwritable(const fs::path& out) {
  const std::string shown = printable(out.string());
  std::error_code error;
  if (!fs::exists(out / "session.json", error))
    throw UsageError("OUT: " + shown + " is not empty and no session; only a session is overwritten");
  try {
    if (const auto foreign = foreign_entry(out))
      throw UsageError("OUT: " + printable(foreign->string()) +
                       " is no part of the session and would be lost; move it away or choose another folder");
  } catch (const fs::filesystem_error& problem) {
    throw UsageError("OUT: cannot look into " + shown + ": " + problem.code().message() +
                     "; choose another folder");
  }
}

// Folders above `path` that do not exist, innermost first.
std::vector<fs::path> missing_folders(fs::path path) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (; !path.empty() && !fs::exists(fs::symlink_status(path, error)); path = path.parent_path())
    missing.push_back(path);
  return missing;
}

}  // namespace

NewSessionFolder::NewSessionFolder(fs::path out, bool overwrite) : out_(std::move(out)) {
  out_ = out_.lexically_normal();
  if (!out_.has_filename()) out_ = out_.parent_path();  // "OUT/"
  if (out_.empty() || out_.filename() == "." || out_.filename() == "..")
    throw UsageError("OUT: is no name of a folder; write one, for example sessions/walk");
  const std::string shown = printable(out_.string());
  std::error_code error;
  if (fs::is_symlink(out_, error))
    throw UsageError("OUT: " + shown + " is a link; name the folder that it leads to");
  const fs::file_status status = fs::status(out_, error);
  if (fs::exists(status)) {
    if (!fs::is_directory(status))
      throw UsageError("OUT: " + shown + " exists and is no folder; choose another name");
    const bool empty = fs::is_empty(out_, error);
    if (error)
      throw UsageError("OUT: cannot look into " + shown + ": " + error.message() + "; choose another folder");
    if (!empty && !overwrite)
      throw UsageError("OUT: " + shown + " is not empty; give --overwrite to replace it");
    if (!empty) check_overwritable(out_);
  }
  const fs::path parent = out_.has_parent_path() ? out_.parent_path() : fs::path(".");
  made_parents_ = missing_folders(parent);
  temporary_ = beside(out_, ".tmp.");
  fs::create_directories(parent, error);
  const fs::path& wanted = error ? parent : temporary_;
  if (!error && fs::create_directory(temporary_, error)) return;
  remove_made_parents();
  throw UsageError("OUT: cannot make " + printable(wanted.string()) + ": " +
                   (error ? error.message() : "it exists") + "; choose another folder");
}

void NewSessionFolder::remove_made_parents() const {
  std::error_code ignored_because_the_first_error_counts;
  for (const fs::path& folder : made_parents_)
    fs::remove(folder, ignored_because_the_first_error_counts);  // only when it is empty
}

NewSessionFolder::~NewSessionFolder() {
  std::error_code ignored_because_the_first_error_counts;
  if (kept_) return;
  fs::remove_all(temporary_, ignored_because_the_first_error_counts);
  remove_made_parents();
}

void NewSessionFolder::keep() {
  std::error_code error;
  const bool replaces = fs::exists(out_, error) && !fs::is_empty(out_, error);
  const fs::path old = beside(out_, ".old.");
  if (replaces) rename_folder(out_, old);
  rename_folder(temporary_, out_);
  kept_ = true;
  sync_folder(out_.has_parent_path() ? out_.parent_path() : fs::path("."));
  if (!replaces) return;
  fs::remove_all(old, error);
  if (error) throw WriteError(old, "remove", error.value());
}

std::string NewSessionFolder::with_final_name(std::string text) const {
  const std::string from = temporary_.string(), to = out_.string();
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

SessionFindings NewSessionFolder::findings() const {
  SessionFindings found = Session::open(temporary_).findings();
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

std::string numbered_picture(std::size_t index, const std::string& extension) {
  const std::string digits = std::to_string(index);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits + extension;
}

}  // namespace herr
