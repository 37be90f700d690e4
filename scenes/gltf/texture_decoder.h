// Decodes a PNG or JPEG from memory to 8-bit RGBA, as glTF textures need it: no colour management, alpha not
// multiplied in. Before: material_builder. After: Scene::textures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace herr {

struct DecodedImage {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height, rows from the top
};

// The header is checked against kMaxImageSide_px, kMaxImagePixels and `max_bytes` before pixels are decoded.
// Throws InputError, ModuleError; `file` and `name` say which image of which file it is.
DecodedImage decode_image(const unsigned char* bytes, std::size_t size, std::int64_t max_bytes,
                          const std::filesystem::path& file, const std::string& name);

}  // namespace herr
