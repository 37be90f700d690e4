// Where the pictures of a look go. Before: the command's options. After: files that
// stand whole under their names.
#pragma once

#include <filesystem>
#include <vector>

#include "server/look/look_options.h"

namespace herr {

struct LookFiles {
  std::filesystem::path folder;              // of a turntable; else empty
  std::vector<std::filesystem::path> files;  // of one picture: in each format; of a turntable none
  PictureFormats formats;                    // in the order of kPictureFormats
};

// Throws UsageError where a picture has another ending than its format's, a file is there already and may not
// be overwritten, or nothing would be written.
LookFiles look_files(const LookOptions& options);
// "helmet-007.png" of 12 pictures, with as many digits as the last one needs, three at least.
std::string turntable_picture(const LookOptions& options, int number, PictureFormat format);
bool is_turntable_picture(const std::string& name);

}  // namespace herr
