// Where the pictures of a look go. Before: the command's options. After: files that
// stand whole under their names.
#pragma once

#include <filesystem>
#include <vector>

#include "server/look/look_options.h"

namespace herr {

enum class LookFormat { png, exr };

struct LookFiles {
  std::filesystem::path out;  // a file, or the folder of a turntable
  LookFormat format = LookFormat::png;
};

// Throws UsageError where a picture has another ending than .png or .exr, a file is there already and may not
// be overwritten, or the model itself would be.
LookFiles look_files(const LookOptions& options);
// "helmet-007.png" of 12 pictures, with as many digits as the last one needs, three at least.
std::string turntable_picture(const LookOptions& options, int number);
bool is_turntable_picture(const std::string& name);

}  // namespace herr
