#include "sessions/files/contained_folder.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "sessions/files/input_error.h"
#include "sessions/files/input_file.h"
#include "sessions/files/system/file_system.h"

namespace herr {
namespace {

// A rename while the kernel resolves ".." makes it give up with EAGAIN: asked again it settles.
constexpr int kMostTries = 100;

OpenedFile with_shortage_thrown(OpenedFile opened, const std::filesystem::path& path) {
  throw_shortage(opened.error, path, "cannot be opened");
  return opened;
}

}  // namespace

ContainedFolder::ContainedFolder(const std::filesystem::path& folder)
    : path_(folder.empty() ? "." : folder),
      folder_(with_shortage_thrown(open_file(path_, O_PATH | O_DIRECTORY), path_)) {}

OpenedFile ContainedFolder::open(const std::string& name) const {
  // For the kernel the name would end there: another file than the one that was asked for.
  if (name.find('\0') != std::string::npos) return {Descriptor(), EINVAL};
  int result = -EAGAIN;
  for (int i = 0; i < kMostTries && (result == -EAGAIN || result == -EINTR); ++i)
    result = file_system().open_beneath(folder_.descriptor.get(), name.c_str(), kReadFlags);
  if (result == -ENOSYS || result == -EPERM) return with_shortage_thrown(open_by_prefix(name), path_ / name);
  if (result >= 0) return {Descriptor(result), 0};
  return with_shortage_thrown({Descriptor(), -result}, path_ / name);
}

// Both paths with every link resolved, compared part by part.
OpenedFile ContainedFolder::open_by_prefix(const std::string& name) const {
  const std::filesystem::path relative(name);
  if (relative.is_absolute()) return {Descriptor(), EXDEV};
  std::string root, target;
  if (const int result = file_system().real_path(path_.c_str(), root); result < 0)
    return {Descriptor(), -result};
  const int result = file_system().real_path((root / relative).c_str(), target);
  if (result < 0) return {Descriptor(), -result};
  const std::filesystem::path inner(target), outer(root);
  const auto [in_outer, in_inner] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
  if (in_outer != outer.end()) return {Descriptor(), EXDEV};
  return open_file(inner, kReadFlags | O_NOFOLLOW);
}

std::vector<unsigned char> read_named_file(const std::filesystem::path& owner, const std::string& name,
                                           std::int64_t max_bytes) {
  const auto refusal = [&](const std::string& problem, const std::string& remedy) {
    return InputError(owner, 0, "names \"" + printable(name) + "\", which " + problem, remedy);
  };
  if (name.find('\0') != std::string::npos) throw refusal("holds a NUL byte", "rename the file");
  const ContainedFolder folder(owner.parent_path());
  OpenedFile opened = folder.error() != 0 ? OpenedFile{Descriptor(), folder.error()} : folder.open(name);
  if (opened.error == EXDEV)
    throw refusal("lies outside the folder of the file that names it",
                  "copy it into that folder and name it without \"..\" or a leading \"/\"");
  std::vector<unsigned char> bytes;
  try {
    const InputFile file(owner.parent_path() / name, std::move(opened));
    bytes = all_bytes<std::vector<unsigned char>>(file, {max_bytes, "split or shrink the model"});
  } catch (const InputError& error) {  // it knows the file, not the one that names it
    throw refusal(error.problem(), error.remedy());
  }
  if (bytes.empty()) throw refusal("is empty", "copy the file again");
  return bytes;
}

}  // namespace herr
