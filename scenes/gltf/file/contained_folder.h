// Reads files that an untrusted file names, and only beneath one folder: "..", absolute paths, links that
// lead out, devices and pipes are refused. Before: gltf/read_gltf opens one for the glTF's own folder.
// Method: openat2(RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS); where the kernel or a sandbox has no such call,
// the canonical path must begin with the folder's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace herr {

// A whole regular file of at most `max_bytes`. Throws InputError: missing, unreadable, not a regular file,
// too big.
std::vector<unsigned char> read_regular_file(const std::filesystem::path& file, std::int64_t max_bytes);

class ContainedFolder {
 public:
  // The folder that `owner`, the file that names others, stands in. Throws InputError when it cannot be
  // opened.
  explicit ContainedFolder(const std::filesystem::path& owner);
  ~ContainedFolder();
  ContainedFolder(const ContainedFolder&) = delete;
  ContainedFolder& operator=(const ContainedFolder&) = delete;

  // As read_regular_file, for a path relative to the folder. Throws InputError also when the path leads out
  // of it.
  std::vector<unsigned char> read(const std::string& relative, std::int64_t max_bytes) const;
  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path owner_, folder_;
  int folder_fd_ = -1;
};

}  // namespace herr
