// Encodes 8-bit pixels as a PNG file in memory by OpenImageIO. After: whoever gave the
// request writes the file.
#pragma once

#include "sessions/pictures/picture_module.h"

namespace herr {

// The function of PictureModule, which see.
bool encode_png_picture(const PngRequest* request, PictureProblem* problem) noexcept;

}  // namespace herr
