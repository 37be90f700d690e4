// What an OpenEXR file says of itself before its pixels, read by OpenEXR's core library.
// Before: HeaderBytes, flags of the version field already checked. After: camera_image.
#pragma once

#include "sessions/pictures/header_bytes.h"
#include "sessions/pictures/picture_module.h"

namespace herr {

// Throws InputError: a header that cannot be read; a compression other than none, RLE, ZIPS and ZIP (the
// other decoders of OpenEXR 3.1.5 have open memory errors); a data window that is not the display window at
// (0, 0); channels of integers, subsampled, or neither R, G, B nor Y.
PictureHeader read_exr_header(HeaderBytes& bytes);

}  // namespace herr
