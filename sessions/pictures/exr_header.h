// What an OpenEXR file says of itself before its pixels, read by OpenEXR's core library.
// Before: HeaderBytes, flags of the version field already checked. After: camera_image; pictures of
// environments, which may be laid out more freely.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sessions/pictures/header_bytes.h"
#include "sessions/pictures/picture_module.h"

namespace herr {

enum class ExrCompression { none, rle, zips, zip };

// Inclusive corners, y downwards; never empty.
struct ExrWindow {
  std::int32_t left = 0, top = 0, right = 0, bottom = 0;
  std::int64_t width() const { return std::int64_t{right} - left + 1; }
  std::int64_t height() const { return std::int64_t{bottom} - top + 1; }
};

struct ExrChannel {
  std::string name;
  SampleType stored = SampleType::other;  // half, f32; other: 32-bit integers
  bool subsampled = false;
};

struct ExrLayout {
  ExrCompression compression = ExrCompression::none;
  ExrWindow data, display;           // where there are pixels; what the picture is
  std::vector<ExrChannel> channels;  // in the file's order
  bool cube_map = false;             // by its envmap attribute
  bool other_primaries = false;      // it names chromaticities that are not sRGB's
  std::size_t header_bytes = 0;      // where the table of its chunks begins
};

// Throws InputError: a header that cannot be read; a compression other than those above (the other decoders
// of OpenEXR 3.1.5 have open memory errors).
ExrLayout read_exr_layout(HeaderBytes& bytes);

// As read_exr_layout, and for pixels that OpenImageIO decodes: refuses a data window that is not the display
// window at (0, 0); channels of integers, subsampled, or neither R, G, B nor Y.
PictureHeader read_exr_header(HeaderBytes& bytes);

// What makes a plain EXR of most kinds: "oiiotool IN.exr --scanline --compression zip -o OUT.exr", with
// `more` after IN.exr.
std::string exr_conversion(const std::string& more = "");

}  // namespace herr
