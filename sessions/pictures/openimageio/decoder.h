// Decodes a picture in memory by OpenImageIO. Before: bytes whose first ones were
// verified to be of the format.
#pragma once

#include <cstddef>

#include "sessions/pictures/picture_module.h"

namespace herr {

// The functions of PictureModule, which see.
OpenPicture* open_picture(const char* format, const void* bytes, std::size_t count, PictureHeader* header,
                          PictureProblem* problem) noexcept;
bool read_picture(OpenPicture* picture, SampleType as, void* samples, std::size_t capacity_bytes,
                  PictureProblem* problem) noexcept;
void close_picture(OpenPicture* picture) noexcept;

}  // namespace herr
