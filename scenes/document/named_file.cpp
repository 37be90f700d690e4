#include "scenes/document/named_file.h"

#include <cerrno>
#include <string>

#include "sessions/files/contained_folder.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

bool is_missing(int error) {
  return error == ENOENT || error == ENOTDIR || error == ELOOP || error == ENAMETOOLONG;
}

std::string shown(const fs::path& path) {
  return printable(path.string());
}

bool has_part(const fs::path& path, const char* name) {
  for (const fs::path& part : path)
    if (part == name) return true;
  return false;
}

[[noreturn]] void fail_missing(const JsonObject& entry, const char* key, const fs::path& file,
                               const fs::path& relative, std::span<const fs::path> asset_roots) {
  std::string problem = "names " + shown(file) + ", which does not exist";
  for (std::size_t i = 0; i < asset_roots.size(); ++i)
    problem += (i == 0 ? "; nor is it below --asset-root " : ", ") + shown(asset_roots[i]);
  entry.fail(key, problem,
             has_part(relative, "generated") ? "build first: `cmake --build` makes the generated meshes"
             : asset_roots.empty()           ? "check the path; a file elsewhere needs --asset-root DIR"
                                             : "check the path");
}

}  // namespace

fs::path named_file(const JsonObject& entry, const char* key, std::span<const fs::path> asset_roots) {
  const std::string name = entry.text(key);
  const fs::path relative(name);
  const bool climbs = name.empty() || relative.is_absolute() || name.find('\0') != std::string::npos ||
                      has_part(relative, "..");
  if (climbs) {
    entry.fail(key, "is \"" + printable(name) + "\", which is not below the folder of the scene",
               "write a path relative to the scene file, without \"..\", or to a folder of models that "
               "--asset-root names");
  }
  const fs::path own = entry.file().parent_path();
  const int error = ContainedFolder(own).open(name).error;
  if (error == EXDEV) {
    entry.fail(
        key, "is \"" + printable(name) + "\", a link that leads out of the folder of the scene",
        "copy the file into that folder, or name the folder in which it lies with --asset-root and the "
        "path below that one");
  }
  // What is there and does not open tells its loader why.
  if (!is_missing(error)) return (own / relative).lexically_normal();
  for (const fs::path& root : asset_roots) {
    const int error_there = ContainedFolder(root).open(name).error;
    if (error_there == EXDEV) {
      entry.fail(key, "is \"" + printable(name) + "\", a link that leads out of --asset-root " + shown(root),
                 "copy the file into that folder");
    }
    if (!is_missing(error_there)) return (root / relative).lexically_normal();
  }
  fail_missing(entry, key, (own / relative).lexically_normal(), relative, asset_roots);
}

void check_asset_roots(std::span<const fs::path> asset_roots) {
  for (const fs::path& root : asset_roots)
    if (!is_folder(root))
      throw InputError(root, 0, "is no folder", "name with --asset-root a folder below which models lie");
}

}  // namespace herr
