// Finds and loads the picture module (picture_module.h), once. Before: the first picture that needs it,
// or a command that wants the time of loading out of its frames. After: PictureReader.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "sessions/pictures/picture_module.h"

namespace herr {

// The installation is not whole: the module is missing, does not load, or is of another build. what() is one
// line, "FILE: problem; remedy". A fault of neither the user's input nor the moment.
class ModuleError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The module, loaded by the first call (some 0.3 s of CPU) and kept until the program ends. Thread-safe; no
// lock is taken once it is loaded. Throws ModuleError; the next call tries again.
const PictureModule& picture_module();

// Where a program in `folder` looks, in this order: beside itself, then where an installation
// and the build keep modules.
std::vector<std::filesystem::path> picture_module_places(const std::filesystem::path& folder);

}  // namespace herr
