// The pixels of a flat EXR of scanlines, decoded without a library: of the compressions none, RLE, ZIPS and
// ZIP every length is known before its bytes are read, so that each is checked. Before: exr_layers says which
// channels. After: exr_picture. Format: OpenEXR's "File Layout" and "Technical Introduction".
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string_view>

#include "sessions/pictures/exr_header.h"

namespace herr {

// Three values for each pixel of one scanline of the data window, from its left.
using ExrScanline = std::function<void(std::int32_t y, const float* rgb)>;

// Calls `take` with every scanline that lies in both windows, from the top. Throws InputError: damaged, cut
// off, or with so many channels that they need more than 4 GiB.
void read_exr_scanlines(std::string_view bytes, const ExrLayout& layout,
                        const std::array<std::size_t, 3>& channels, const std::filesystem::path& file,
                        const ExrScanline& take);

}  // namespace herr
