// Files by names that are not trusted: they open only beneath one folder. "..", absolute paths and links that
// lead out are refused by the kernel as it walks the path, so that nothing can be swapped between a check and
// the opening. Before: a name out of a recording, a glTF, a grid or a scene document. After: input_file.
// Method: openat2(RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS); where the kernel or a sandbox has no such call,
// the path with every link resolved must begin with the folder's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sessions/files/system/descriptor.h"

namespace herr {

class ContainedFolder {
 public:
  // The folder itself may be reached through links. Throws std::system_error where the machine is short of
  // descriptors or memory.
  explicit ContainedFolder(const std::filesystem::path& folder);

  // Why the folder could not be opened, or 0.
  int error() const { return folder_.error; }
  // For reading. The error is EXDEV where `name` leads out of the folder, EINVAL where it holds a NUL byte,
  // and else what the kernel says. Throws as the constructor.
  OpenedFile open(const std::string& name) const;

 private:
  OpenedFile open_by_prefix(const std::string& name) const;

  std::filesystem::path path_;
  OpenedFile folder_;
};

// A file that an untrusted file names, in the folder of that file or below it: a whole regular file of 1 to
// `max_bytes` bytes. Throws InputError "OWNER: names "NAME", which ...; remedy".
std::vector<unsigned char> read_named_file(const std::filesystem::path& owner, const std::string& name,
                                           std::int64_t max_bytes);

}  // namespace herr
