#include "sessions/files/folders.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>

#include "sessions/files/system/descriptor.h"
#include "sessions/files/system/file_system.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

std::error_code error_of(int result) {
  return result < 0 ? std::error_code(-result, std::generic_category()) : std::error_code();
}

FileKind kind_of(mode_t mode) {
  if (S_ISREG(mode)) return FileKind::file;
  if (S_ISDIR(mode)) return FileKind::folder;
  return S_ISLNK(mode) ? FileKind::link : FileKind::other;
}

FileFacts look(const fs::path& path, bool follow_links) {
  struct stat status {};
  FileFacts facts;
  const int result = file_system().status(path.c_str(), follow_links, status);
  if (result == -ENOENT || result == -ENOTDIR) return facts;
  facts.error = error_of(result);
  facts.kind = facts.error ? FileKind::unknown : kind_of(status.st_mode);
  facts.size_bytes = status.st_size;
  facts.changed_ns = std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
  return facts;
}

}  // namespace

FileFacts facts_of(const fs::path& path) {
  return look(path, true);
}

FileFacts facts_of_name(const fs::path& path) {
  return look(path, false);
}

bool path_exists(const fs::path& path) {
  const FileKind kind = facts_of(path).kind;
  return kind != FileKind::missing && kind != FileKind::unknown;
}

bool is_folder(const fs::path& path) {
  return facts_of(path).kind == FileKind::folder;
}

bool is_file(const fs::path& path) {
  return facts_of(path).kind == FileKind::file;
}

bool may(int mode, const fs::path& path) {
  return file_system().access(path.c_str(), mode) == 0;
}

std::vector<std::string> list_folder(const fs::path& folder, std::error_code& error) {
  std::vector<std::string> names;
  error = error_of(file_system().list(folder.c_str(), names));
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<fs::path> list_tree(const fs::path& folder, std::error_code& error) {
  std::vector<fs::path> found, open{folder};
  error.clear();
  while (!open.empty() && !error) {
    const fs::path here = std::move(open.back());
    open.pop_back();
    for (const std::string& name : list_folder(here, error)) {
      found.push_back(here / name);
      if (facts_of_name(found.back()).kind == FileKind::folder) open.push_back(found.back());
    }
  }
  return found;
}

std::error_code make_folder(const fs::path& folder) {
  return error_of(file_system().make_folder(folder.c_str()));
}

std::error_code make_folders(const fs::path& folder) {
  const FileFacts facts = facts_of(folder);
  if (facts.kind == FileKind::folder || folder.empty()) return {};
  if (facts.kind == FileKind::unknown) return facts.error;
  if (facts.kind != FileKind::missing) return std::make_error_code(std::errc::not_a_directory);
  const bool ends_with_slash = !folder.has_filename();
  if (folder.has_parent_path() && folder.parent_path() != folder)
    if (const std::error_code error = make_folders(folder.parent_path())) return error;
  if (ends_with_slash) return {};  // "a/": the line above made it
  const std::error_code error = make_folder(folder);
  // Another process, or a thread of ours, may have been quicker.
  return error && is_folder(folder) ? std::error_code() : error;
}

std::error_code rename_path(const fs::path& from, const fs::path& to) {
  return error_of(file_system().rename(from.c_str(), to.c_str()));
}

std::error_code remove_path(const fs::path& path) {
  const int result = file_system().remove(path.c_str());
  return result == -ENOENT || result == -ENOTDIR ? std::error_code() : error_of(result);
}

std::error_code remove_tree(const fs::path& path) {
  if (facts_of_name(path).kind != FileKind::folder) return remove_path(path);
  std::error_code first;
  for (const std::string& name : list_folder(path, first))
    if (const std::error_code error = remove_tree(path / name); error && !first) first = error;
  const std::error_code last = remove_path(path);
  return first ? first : last;
}

void sync_folder(const fs::path& folder) {
  const OpenedFile opened = open_file(folder, O_RDONLY | O_DIRECTORY);
  if (opened.error != 0) throw WriteError(folder, "open", opened.error);
  if (const int error = sync_to_disk(opened.descriptor.get()); error != 0)
    throw WriteError(folder, "sync", error);
}

}  // namespace herr
