// Reads *.scene.json, the document that composes glTF files, catchers and lights into a scene (README.md has
// the schema). Before: load_scene. Uses: sessions/strict_json, gltf/load_gltf, catcher_meshes.
#pragma once

#include <filesystem>
#include <span>

#include "scenes/model/scene.h"
#include "scenes/model/texture_pixels.h"

namespace herr {

// Files that it names may lie below one of `asset_roots` (named_file.h). Throws InputError that names the
// field.
Scene read_scene_document(const std::filesystem::path& file, TexturePixels pixels,
                          std::span<const std::filesystem::path> asset_roots = {});

}  // namespace herr
