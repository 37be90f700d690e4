// PNG pictures by libpng. Before: bytes that begin as a PNG. After: picture_reader.
#pragma once

#include "sessions/pictures/picture_decoder.h"

namespace herr {

// Palettes become RGB, fewer than 8 bits 8, a transparent colour alpha; 16 bits are kept or rounded to 8.
// Nothing is converted by gAMA, iCCP or other chunks, which are not even read. Libpng's warnings are not
// shown. The bytes must outlive the decoder.
OpenedPicture open_png(std::string_view bytes);

}  // namespace herr
