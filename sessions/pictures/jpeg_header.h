// What a JPEG says of itself before its pixels, read by libjpeg. Before: HeaderBytes. After: camera_image,
// texture_decoder.
#pragma once

#include "sessions/pictures/header_bytes.h"
#include "sessions/pictures/picture_module.h"

namespace herr {

struct JpegHeader {
  PictureHeader picture;
  bool cmyk = false;  // colours are amounts of ink
};

// Throws InputError: no header that libjpeg can read within 16 MiB.
JpegHeader read_jpeg_header(HeaderBytes& bytes);

}  // namespace herr
