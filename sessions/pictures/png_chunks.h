// The chunks of a PNG file (W3C PNG specification, section 5), checked before libpng sees them.
// Two reasons: libpng writes its errors and warnings to stderr, which is not a library's to use; and text,
// colour profiles and the like, which can expand without bound, are of no use here. Before: file bytes.
// After: camera_image.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sessions/pictures/image_size.h"

namespace herr {

inline constexpr std::size_t kPngHeaderBytes = 33;  // signature and IHDR, with which every PNG begins

// Width and height from the first kPngHeaderBytes. Throws InputError.
ImageSize png_size(const std::filesystem::path& file, std::string_view first_bytes);

// The same picture with nothing but its header, palette and pixels. Throws InputError: a checksum that does
// not fit, a file that ends before its last chunk.
std::string essential_png(const std::filesystem::path& file, std::string_view bytes);

}  // namespace herr
