#include "sessions/camera/recorded_name.h"

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "sessions/files/contained_folder.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

// What is wrong with the name itself; empty when nothing is.
std::string flaw_of(const std::string& name) {
  if (name.empty()) return "is empty";
  if (name.front() == '/') return "is an absolute path";
  for (const char character : name) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x20 || byte == 0x7f) return "holds a control character";
    if (byte == '\\') return "holds a backslash";
  }
  for (std::size_t start = 0; start <= name.size();) {
    const std::size_t end = std::min(name.find('/', start), name.size());
    const std::string part = name.substr(start, end - start);
    if (part == "..") return "leads out of the folder";
    if (part.empty() || part == ".") return "has an empty part";
    start = end + 1;
  }
  return {};
}

std::string reason(int error) {
  return std::generic_category().message(error);
}

}  // namespace

InputFile open_recorded(const std::filesystem::path& folder, const std::string& name,
                        const std::string& remedy) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(folder / name, 0, problem, remedy);
  };
  if (const std::string flaw = flaw_of(name); !flaw.empty()) refuse(flaw);
  const ContainedFolder inside(folder);
  if (inside.error() != 0)
    refuse("cannot be reached: " + folder.filename().string() + ": " + reason(inside.error()));
  OpenedFile opened = inside.open(name);
  if (opened.error == EXDEV) refuse("is a link that leads out of the folder");
  if (opened.error != 0) refuse("cannot be reached: " + reason(opened.error));
  return {folder / name, std::move(opened)};
}

}  // namespace herr
