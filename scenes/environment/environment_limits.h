// What a picture of an environment may be, whatever its format: its size and the range of its radiances.
// Before: a header has been read. After: radiance_picture, exr_picture, environment_image.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace herr {

// Throws InputError unless the picture has 2 x 1 to 8192 x 4096 pixels.
void check_environment_size(const std::filesystem::path& file, std::int64_t width_px, std::int64_t height_px);

// A radiance that can be used: negative values and NaN become 0, those above 65504 (the largest half, far
// above any display) that. Each one that changes is counted.
float radiance_in_range(double value, std::int64_t& changed);

// What is said of values that changed: one line without the file's name.
std::string range_remark(std::int64_t changed);

}  // namespace herr
