// The pixels of a Radiance picture as they are stored: three mantissas and an exponent each. Before:
// radiance_header. After: radiance_picture. Coding: Radiance's color.c, Greg Ward: runs by component, the
// older runs of whole pixels, or no runs at all; a scanline says which by its first bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "scenes/environment/radiance_header.h"

namespace herr {

// 4 bytes for each pixel, scanline after scanline. Throws InputError with the scanline: cut off or damaged.
std::vector<std::uint8_t> read_radiance_scanlines(std::string_view bytes, const RadianceHeader& header,
                                                  const std::filesystem::path& file);

}  // namespace herr
