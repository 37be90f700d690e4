// What a JPEG says of itself before its pixels, read by libjpeg. Before: HeaderBytes. After: camera_image.
#pragma once

#include "sessions/pictures/header_bytes.h"
#include "sessions/pictures/picture_module.h"

namespace herr {

// Throws InputError: no header that libjpeg can read within 16 MiB, a CMYK picture.
PictureHeader read_jpeg_header(HeaderBytes& bytes);

}  // namespace herr
