// JPEG pictures by libjpeg, which the program links for headers anyway. Before: bytes that begin as a JPEG.
// After: picture_reader.
#pragma once

#include "sessions/pictures/picture_decoder.h"

namespace herr {

// Grey, RGB and YCbCr; others (CMYK) are left to the picture module. What libjpeg warns of, such as data that
// end early, is a problem. The bytes must outlive the decoder.
OpenedPicture open_jpeg(std::string_view bytes);

}  // namespace herr
