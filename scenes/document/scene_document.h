// Reads *.scene.json, the document that composes glTF files, catchers and lights into a scene (README.md has
// the schema). Before: load_scene. Uses: sessions/strict_json, gltf/load_gltf, catcher_meshes.
#pragma once

#include <filesystem>

#include "scenes/model/scene.h"
#include "scenes/model/texture_pixels.h"

namespace herr {

// Throws InputError that names the field.
Scene read_scene_document(const std::filesystem::path& file, TexturePixels pixels);

}  // namespace herr
