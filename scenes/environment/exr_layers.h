// Which channels of an EXR are the picture: R, G, B, alone or of a layer ("ViewLayer.Combined.R", as Blender
// names them), or Y for grey. Before: sessions/pictures/exr_header. After: exr_scanlines reads these.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sessions/pictures/exr_header.h"

namespace herr {

// Indices of the channels that are red, green and blue: of those without a layer, else of the layer called
// Combined, else of the first layer that has all three, else three times the channel Y. What is left out is a
// remark, alpha excepted. Throws InputError where there are none, or where they are integers or subsampled.
std::array<std::size_t, 3> environment_channels(const ExrLayout& layout, const std::filesystem::path& file,
                                                std::vector<std::string>& remarks);

}  // namespace herr
