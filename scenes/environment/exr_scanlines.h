// The pixels of a flat EXR of scanlines, unpacked by OpenEXR's core library. What a block says of itself is
// checked before the library gets it. Before: exr_layers says which channels. After: exr_picture.
// Format: OpenEXR's "File Layout".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

#include "sessions/pictures/exr_header.h"

namespace herr {

// Three values for each pixel of one scanline of the data window, from its left.
using ExrScanline = std::function<void(std::int32_t y, const float* rgb)>;

// Calls `take` with every scanline that lies in both windows, from the top. Throws InputError: damaged, cut
// off, or so wide or with so many channels that they need more than 4 GiB, or a block more than 256 MiB.
void read_exr_scanlines(std::string_view bytes, const ExrLayout& layout,
                        const std::array<std::size_t, 3>& channels, const std::filesystem::path& file,
                        const ExrScanline& take);

}  // namespace herr
