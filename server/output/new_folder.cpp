#include "server/output/new_folder.h"

#include <unistd.h>

#include <system_error>
#include <utility>

#include "server/process/exit_code.h"
#include "sessions/files/folders.h"
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
  if (const std::error_code error = rename_path(from, to)) throw WriteError(to, "rename", error.value());
}

// Folders above `path` that do not exist, innermost first.
std::vector<fs::path> missing_folders(fs::path path) {
  std::vector<fs::path> missing;
  for (; !path.empty() && facts_of_name(path).kind == FileKind::missing; path = path.parent_path())
    missing.push_back(path);
  return missing;
}

void check_present(const NewFolder::Request& request) {
  const std::string shown = request.flag + ": " + printable(request.out.string());
  if (facts_of_name(request.out).kind == FileKind::link)
    throw UsageError(shown + " is a link; name the folder that it leads to");
  if (!path_exists(request.out)) return;
  if (!is_folder(request.out)) throw UsageError(shown + " exists and is no folder; choose another name");
  std::error_code error;
  const bool empty = list_folder(request.out, error).empty();
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
  std::error_code error = make_folders(parent);
  const fs::path& wanted = error ? parent : temporary_;
  if (!error) error = make_folder(temporary_);
  if (!error) return;
  remove_made_parents();
  const std::string reason = error == std::errc::file_exists ? "it exists" : error.message();
  throw UsageError(request_.flag + ": cannot make " + printable(wanted.string()) + ": " + reason +
                   "; choose another folder");
}

void NewFolder::remove_made_parents() const {
  // Only those that are empty. The first error counts, and it was told.
  for (const fs::path& folder : made_parents_) remove_path(folder);
}

NewFolder::~NewFolder() {
  if (kept_) return;
  remove_tree(temporary_);
  remove_made_parents();
}

void NewFolder::keep() {
  const fs::path& out = request_.out;
  std::error_code error;
  const bool replaces = path_exists(out) && !list_folder(out, error).empty();
  const fs::path old = beside(out, ".old.");
  if (replaces) rename_folder(out, old);
  rename_folder(temporary_, out);
  kept_ = true;
  sync_folder(out.has_parent_path() ? out.parent_path() : fs::path("."));
  if (!replaces) return;
  if (error = remove_tree(old); error) throw WriteError(old, "remove", error.value());
}

}  // namespace herr
