// Whether the pictures of textures are decoded when a scene is loaded. Before: load_scene. After:
// material_builder.
#pragma once

#include <cstdint>

namespace herr {

// left_out: their headers are read and TextureImage::rgba stays empty: enough to describe a
// scene, not to render it.
enum class TexturePixels : std::uint8_t { decoded, left_out };

}  // namespace herr
