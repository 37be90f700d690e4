// The door of scenes/: a file becomes a Scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "scenes/model/scene.h"
#include "scenes/model/texture_pixels.h"

namespace herr {

// What lights a model that has no lights of its own.
enum class DefaultLight : std::uint8_t {
  above,  // one light above it that fits its bounds, with ambient light and environment 0.2
  none,   // nothing: the caller gives it light, or says that it has none
};

// Whether load_scene takes the file for a scene document, by its name; else it is a bare model.
bool is_scene_document(const std::filesystem::path& file);

// Reads a *.scene.json, or a bare .gltf, .glb or .vox. What a document names lies below its own folder or
// below one of `asset_roots`, folders all of them; to a bare model they are nothing, as a warning says.
// Throws InputError.
Scene load_scene(const std::filesystem::path& file, TexturePixels pixels = TexturePixels::decoded,
                 DefaultLight light = DefaultLight::above,
                 std::span<const std::filesystem::path> asset_roots = {});
inline Scene load_scene(const std::filesystem::path& file,
                        std::span<const std::filesystem::path> asset_roots) {
  return load_scene(file, TexturePixels::decoded, DefaultLight::above, asset_roots);
}

}  // namespace herr
