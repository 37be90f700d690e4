// What stands in the file system under a name, and making, listing, renaming and removing it. Before:
// file_system. After: the folders of sessions and results. Nothing here throws but sync_folder: what a
// failure means, and to whom, is known above.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "sessions/files/write_error.h"

namespace herr {

enum class FileKind { missing, file, folder, link, other, unknown };

struct FileFacts {
  FileKind kind = FileKind::missing;
  std::int64_t size_bytes = 0;
  std::int64_t changed_ns = 0;  // since 1970
  std::error_code error;        // why the kind is unknown
};

// Of what a path leads to. A path of which a part is missing is missing, and no error.
FileFacts facts_of(const std::filesystem::path& path);
// Of the name itself: a link is a link.
FileFacts facts_of_name(const std::filesystem::path& path);
// What cannot be looked at counts as not there.
bool path_exists(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);
bool is_file(const std::filesystem::path& path);
// By the mode and the user, as access(2) says it; `mode` of W_OK, X_OK.
bool may(int mode, const std::filesystem::path& path);

// Names in a folder, sorted.
std::vector<std::string> list_folder(const std::filesystem::path& folder, std::error_code& error);
// The paths of all that is in a folder and the folders below it; links are not followed.
std::vector<std::filesystem::path> list_tree(const std::filesystem::path& folder, std::error_code& error);

// One that exists is no error, unless it is no folder.
std::error_code make_folders(const std::filesystem::path& folder);
// One that exists is an error.
std::error_code make_folder(const std::filesystem::path& folder);
std::error_code rename_path(const std::filesystem::path& from, const std::filesystem::path& to);
// A file, a link or an empty folder; what is missing is no error.
std::error_code remove_path(const std::filesystem::path& path);
// A folder with all that is in it; links are removed, not followed.
std::error_code remove_tree(const std::filesystem::path& path);

// Makes the names in a folder durable. One call serves any number of new files. Throws WriteError.
void sync_folder(const std::filesystem::path& folder);

}  // namespace herr
