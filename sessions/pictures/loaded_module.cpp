#include "sessions/pictures/loaded_module.h"

#include <dlfcn.h>

#include <cstring>
#include <string>
#include <system_error>

#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr const char* kFileName = "herr_pictures.so";
constexpr const char* kInstallAgain = "; install herr again, program and lib/herr/herr_pictures.so together";

// The one of the places that exists.
std::filesystem::path find_module() {
  // Not the name that the program was called by: that may be a link to it.
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw ModuleError("/proc/self/exe: cannot be read (" + error.message() + "); mount /proc");
  const auto places = picture_module_places(program.parent_path());
  for (const std::filesystem::path& place : places) {
    if (path_exists(place)) return place;
  }
  throw ModuleError(printable(places.front().string()) +
                    ": is not there, nor in ../lib/herr, and no EXR or HDR picture can be read without it" +
                    kInstallAgain);
}

std::string loading_problem() {
  const char* text = ::dlerror();
  return text != nullptr ? printable(text) : "unknown reason";
}

void check_version(const std::filesystem::path& file, const PictureModule& module) {
  // Of another version only the first field is known.
  const bool same = module.version == kPictureModuleVersion && module.table_bytes == sizeof(PictureModule);
  if (same && std::strcmp(module.program_version, HERR_VERSION) == 0) return;
  const std::string other = same ? "herr " + printable(module.program_version) : "another version of herr";
  throw ModuleError(printable(file.string()) + ": belongs to " + other + ", and this is " + HERR_VERSION +
                    kInstallAgain);
}

const PictureModule& load_module() {
  const std::filesystem::path file = find_module();
  // Functions are bound when they are first called: most of the libraries' never are. Local: nothing
  // of those libraries may take the place of a symbol of the program. Never closed: they leave
  // threads and handlers behind.
  void* const library = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr)
    throw ModuleError(printable(file.string()) + ": cannot be loaded (" + loading_problem() +
                      "); install herr again, or the library that it names (Debian: libopenimageio2.4)");
  const auto entry = reinterpret_cast<PictureModuleEntry>(::dlsym(library, kPictureModuleEntry));
  if (entry == nullptr) {
    ::dlclose(library);
    throw ModuleError(printable(file.string()) + ": is no picture module of herr" + kInstallAgain);
  }
  const PictureModule& module = *entry();
  check_version(file, module);
  return module;
}

}  // namespace

const PictureModule& picture_module() {
  static const PictureModule& module = load_module();
  return module;
}

std::vector<std::filesystem::path> picture_module_places(const std::filesystem::path& folder) {
  return {folder / kFileName, folder.parent_path() / "lib" / "herr" / kFileName};
}

}  // namespace herr
