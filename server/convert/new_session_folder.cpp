#include "server/convert/new_session_folder.h"

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
  if (!out_.has_filename()) out_ = out_.parent_path();  // "OUT/"
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

}  // namespace herr
