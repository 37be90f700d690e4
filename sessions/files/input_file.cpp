#include "sessions/files/input_file.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/files/system/file_system.h"

namespace herr {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int error) {
  throw_shortage(error, path, what);
  throw InputError(path, 0, what + ": " + std::generic_category().message(error),
                   error == ENOENT ? "check the path" : "check the file and its permissions");
}

OpenedFile opened_by_path(const std::filesystem::path& path) {
  if (path.native().find('\0') != std::string::npos)
    throw InputError(path, 0, "the path holds a NUL byte", "check the path");
  return open_for_reading(path);
}

}  // namespace

bool is_shortage(int error_number) {
  return error_number == EMFILE || error_number == ENFILE || error_number == ENOMEM;
}

void throw_shortage(int error_number, const std::filesystem::path& path, const std::string& what) {
  if (is_shortage(error_number))
    throw std::system_error(error_number, std::generic_category(), printable(path.string()) + ": " + what);
}

InputFile::InputFile(std::filesystem::path path) : InputFile(path, opened_by_path(path)) {}

InputFile::InputFile(std::filesystem::path path, OpenedFile opened)
    : path_(std::move(path)), descriptor_(std::move(opened.descriptor)) {
  if (opened.error != 0) fail(path_, "cannot be opened", opened.error);
  struct stat status {};
  if (const int result = file_system().status(descriptor_.get(), status); result < 0)
    fail(path_, "cannot be examined", -result);
  if (!S_ISREG(status.st_mode))
    throw InputError(path_, 0, S_ISDIR(status.st_mode) ? "is a folder, not a file" : "is not a regular file",
                     "name a file");
  mode_ = status.st_mode & 0777u;
  size_bytes_ = status.st_size;
}

std::size_t InputFile::read(char* bytes, std::size_t capacity) {
  const std::size_t got = read_at(offset_, bytes, capacity);
  offset_ += static_cast<std::int64_t>(got);
  return got;
}

std::size_t InputFile::read_at(std::int64_t offset, char* bytes, std::size_t capacity) const {
  const std::int64_t rest = std::max<std::int64_t>(size_bytes_ - offset, 0);
  const auto wanted = static_cast<std::size_t>(
      std::min<std::int64_t>(rest, static_cast<std::int64_t>(std::min(capacity, std::size_t{1} << 40))));
  const std::int64_t got = read_all(descriptor_.get(), bytes, wanted, offset);
  if (got < 0) fail(path_, "cannot be read", static_cast<int>(-got));
  return static_cast<std::size_t>(got);
}

template <class Bytes>
Bytes all_bytes(const InputFile& file, const SizeLimit& limit) {
  if (file.size_bytes() > limit.max_bytes)
    throw InputError(file.path(), 0,
                     "has " + std::to_string(file.size_bytes()) + " bytes, more than the limit of " +
                         std::to_string(limit.max_bytes),
                     limit.remedy);
  Bytes bytes(static_cast<std::size_t>(file.size_bytes()), 0);
  if (file.read_at(0, reinterpret_cast<char*>(bytes.data()), bytes.size()) < bytes.size())
    throw InputError(file.path(), 0, "became shorter while it was read", "try again");
  return bytes;
}

template std::string all_bytes<std::string>(const InputFile&, const SizeLimit&);
template std::vector<unsigned char> all_bytes<std::vector<unsigned char>>(const InputFile&, const SizeLimit&);

std::string read_whole_file(const std::filesystem::path& path, const SizeLimit& limit) {
  return all_bytes<std::string>(InputFile(path), limit);
}

std::string read_whole_file(const std::filesystem::path& path, std::int64_t max_bytes) {
  return read_whole_file(path, SizeLimit{max_bytes});
}

std::string read_kernel_text(const char* path) {
  const OpenedFile opened = open_for_reading(path);
  std::string text;
  for (std::size_t block = 4096; opened.error == 0; block *= 2) {
    const std::size_t before = text.size();
    text.resize(before + block);
    const std::int64_t got =
        read_all(opened.descriptor.get(), text.data() + before, block, static_cast<std::int64_t>(before));
    text.resize(before + static_cast<std::size_t>(std::max<std::int64_t>(got, 0)));
    if (got < static_cast<std::int64_t>(block)) break;
  }
  return text;
}

}  // namespace herr
