// The door of scenes/: a file becomes a Scene.
#pragma once

#include <filesystem>

#include "scenes/model/scene.h"
#include "scenes/model/texture_pixels.h"

namespace herr {

// Reads a *.scene.json or a bare .gltf/.glb (then: lit from above by one light that fits its
// bounds). Throws InputError.
Scene load_scene(const std::filesystem::path& file, TexturePixels pixels = TexturePixels::decoded);

}  // namespace herr
