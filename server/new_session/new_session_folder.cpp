#include "server/new_session/new_session_folder.h"

#include <unistd.h>

#include <string>
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

}  // namespace

NewSessionFolder::NewSessionFolder(fs::path out, bool overwrite) : out_(std::move(out)) {
  out_ = out_.lexically_normal();
  if (!out_.has_filename()) out_ = out_.parent_path();  // "OUT/"
  if (out_.empty() || out_.filename() == "." || out_.filename() == "..")
    throw UsageError("OUT: is no name of a folder; write one, for example sessions/walk");
  const std::string shown = printable(out_.string());
  std::error_code error;
  const fs::file_status status = fs::status(out_, error);
  if (fs::exists(status)) {
    if (!fs::is_directory(status))
      throw UsageError("OUT: " + shown + " exists and is no folder; choose another name");
    const bool empty = fs::is_empty(out_, error);
    if (error) throw UsageError("OUT: cannot look into " + shown + ": " + error.message());
    if (!empty && !overwrite)
      throw UsageError("OUT: " + shown + " is not empty; give --overwrite to replace it");
    if (!empty && !fs::exists(out_ / "session.json", error))
      throw UsageError("OUT: " + shown + " is not empty and no session; only a session is overwritten");
  }
  const fs::path parent = out_.has_parent_path() ? out_.parent_path() : fs::path(".");
  fs::create_directories(parent, error);
  if (error) throw UsageError("OUT: cannot make " + printable(parent.string()) + ": " + error.message());
  temporary_ = beside(out_, ".tmp.");
  if (!fs::create_directory(temporary_, error))
    throw UsageError("OUT: cannot make " + printable(temporary_.string()) + ": " +
                     (error ? error.message() : "it exists") + "; choose another folder");
}

NewSessionFolder::~NewSessionFolder() {
  std::error_code ignored_because_the_first_error_counts;
  if (!kept_) fs::remove_all(temporary_, ignored_because_the_first_error_counts);
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

std::string numbered_picture(std::size_t index, const std::string& extension) {
  const std::string digits = std::to_string(index);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits + extension;
}

}  // namespace herr
