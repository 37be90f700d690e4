// 8-bit pixels to the bytes of a PNG file, by libpng. Before: server/output/png_encoder. After: a file.
#pragma once

#include <cstdint>
#include <vector>

namespace herr {

struct PngPixels {
  int width_px = 0, height_px = 0, channels = 3;  // RGB, or RGB with unassociated alpha; sRGB
  const std::uint8_t* values = nullptr;           // rows from the top without padding
};

// Appends to `out`. `level` of zlib, 0 to 9. No times in the file: same pixels, same bytes. Thread-safe.
// Throws std::bad_alloc, and std::runtime_error where libpng refuses.
void write_png(const PngPixels& pixels, int level, std::vector<std::uint8_t>& out);

}  // namespace herr
