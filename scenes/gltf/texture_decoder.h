// Decodes a PNG or JPEG from memory to 8-bit RGBA, as glTF textures need it: no colour management, alpha not
// multiplied in. Before: material_builder. After: Scene::textures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sessions/pictures/image_size.h"

namespace herr {

struct DecodedImage {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgba;  // 4 * width * height, rows from the top
};

// A picture inside a glTF file or beside it. `file` and `name` say in errors which one it is.
struct EncodedImage {
  const unsigned char* bytes = nullptr;
  std::size_t size = 0;
  const std::filesystem::path& file;
  const std::string& name;
};

// From the header alone; it is checked against kMaxImageSide_px, kMaxImagePixels and
// `max_bytes`. Throws InputError.
ImageSize texture_size(const EncodedImage& image, std::int64_t max_bytes);

// The same checks come before the pixels are decoded. Throws InputError, ModuleError.
DecodedImage decode_image(const EncodedImage& image, std::int64_t max_bytes);

}  // namespace herr
