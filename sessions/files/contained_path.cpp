#include "sessions/files/contained_path.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

namespace herr {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument(why);
}

void check_parts(const std::string& name) {
  if (name.empty()) refuse("is empty");
  if (name.front() == '/') refuse("is an absolute path");
  for (const char character : name) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x20 || byte == 0x7f) refuse("holds a control character");
    if (byte == '\\') refuse("holds a backslash");
  }
  std::size_t start = 0;
  while (start <= name.size()) {
    const std::size_t end = std::min(name.find('/', start), name.size());
    const std::string part = name.substr(start, end - start);
    if (part == "..") refuse("leads out of the folder");
    if (part.empty() || part == ".") refuse("has an empty part");
    start = end + 1;
  }
}

}  // namespace

std::filesystem::path contained_path(const std::filesystem::path& folder, const std::string& name) {
  check_parts(name);
  std::error_code error;
  const std::filesystem::path root = std::filesystem::canonical(folder, error);
  if (error) refuse("cannot be reached: " + folder.filename().string() + ": " + error.message());
  const std::filesystem::path file = std::filesystem::canonical(folder / name, error);
  if (error) refuse("cannot be reached: " + error.message());
  const auto [in_root, in_file] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  if (in_root != root.end() || in_file == file.end()) refuse("is a link that leads out of the folder");
  return file;
}

}  // namespace herr
