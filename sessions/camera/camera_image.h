// One decoded camera frame in linear light, and the checks that come before decoding.
// Formats: JPEG, PNG, OpenEXR (single part, flat), recognised by their first bytes.
// Headers are read here, by small libraries; pixels by the picture module (pictures/),
// which costs time to load.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sessions/files/input_file.h"
#include "sessions/pictures/image_size.h"

namespace herr {

// Linear-light RGBA as IEEE half bit patterns, rows from the top; alpha is 1. Values
// are finite, in [0, 65504].
struct CameraImage {
  int width_px = 0, height_px = 0;
  std::vector<std::uint16_t> rgba_half;  // 4 * width_px * height_px
  std::int64_t sanitised_values =
      0;  // NaN, Inf or negative values of the file that were replaced by 0 or 65504
};

// Reads the header alone. Throws InputError: missing, unreadable, unknown format, extension that belies the
// content, more than 16384 pixels on a side, unsupported layout.
ImageSize read_image_size(InputFile& file);  // from its beginning
ImageSize read_image_size(const std::filesystem::path& file);
// Decodes a frame; 8/16-bit files are sRGB (grey allowed), EXR is linear. Throws InputError, also on
// truncated data; ModuleError.
CameraImage read_camera_image(InputFile& file);  // whatever was read of it before
CameraImage read_camera_image(const std::filesystem::path& file);

}  // namespace herr
