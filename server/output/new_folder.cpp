#include "server/output/new_folder.h"

#include <unistd.h>

#include <system_error>
#include <utility>

#include "server/process/exit_code.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/input_error.h"

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

// Folders above `path` that do not exist, innermost first.
std::vector<fs::path> missing_folders(fs::path path) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (; !path.empty() && !fs::exists(fs::symlink_status(path, error)); path = path.parent_path())
    missing.push_back(path);
  return missing;
}

void check_present(const NewFolder::Request& request) {
  const std::string shown = request.flag + ": " + printable(request.out.string());
  std::error_code error;
  if (fs::is_symlink(request.out, error))
    throw UsageError(shown + " is a link; name the folder that it leads to");
  const fs::file_status status = fs::status(request.out, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw UsageError(shown + " exists and is no folder; choose another name");
  const bool empty = fs::is_empty(request.out, error);
  if (error)
    throw UsageError(request.flag + ": cannot look into " + printable(request.out.string()) + ": " +
                     error.message() + "; choose another folder");
  if (!empty && !request.overwrite) throw UsageError(shown + " is not empty; give --overwrite to replace it");
  if (!empty) request.check_overwritable(request.out);
}

}  // namespace

NewFolder::NewFolder(Request request) : request_(std::move(request)) {
  fs::path& out = request_.out;
  out = out.lexically_normal();
  if (!out.has_filename()) out = out.parent_path();  // "OUT/"
  if (out.empty() || out.filename() == "." || out.filename() == "..")
    throw UsageError(request_.flag + ": is no name of a folder; write one, for example " + request_.example);
  check_present(request_);
  const fs::path parent = out.has_parent_path() ? out.parent_path() : fs::path(".");
  made_parents_ = missing_folders(parent);
  temporary_ = beside(out, ".tmp.");
  std::error_code error;
  fs::create_directories(parent, error);
  const fs::path& wanted = error ? parent : temporary_;
  if (!error && fs::create_directory(temporary_, error)) return;
  remove_made_parents();
  throw UsageError(request_.flag + ": cannot make " + printable(wanted.string()) + ": " +
                   (error ? error.message() : "it exists") + "; choose another folder");
}

void NewFolder::remove_made_parents() const {
  std::error_code ignored_because_the_first_error_counts;
  for (const fs::path& folder : made_parents_)
    fs::remove(folder, ignored_because_the_first_error_counts);  // only when it is empty
}

NewFolder::~NewFolder() {
  std::error_code ignored_because_the_first_error_counts;
  if (kept_) return;
  fs::remove_all(temporary_, ignored_because_the_first_error_counts);
  remove_made_parents();
}

void NewFolder::keep() {
  const fs::path& out = request_.out;
  std::error_code error;
  const bool replaces = fs::exists(out, error) && !fs::is_empty(out, error);
  const fs::path old = beside(out, ".old.");
  if (replaces) rename_folder(out, old);
  rename_folder(temporary_, out);
  kept_ = true;
  sync_folder(out.has_parent_path() ? out.parent_path() : fs::path("."));
  if (!replaces) return;
  fs::remove_all(old, error);
  if (error) throw WriteError(old, "remove", error.value());
}

}  // namespace herr
