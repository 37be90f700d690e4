// KHR_texture_transform: where a texture reads its coordinates, and how they are moved on the way.
// Before: gltf_materials reads it. After: mesh_builder bakes it into the coordinates of a mesh.
#pragma once

#include <glm/vec2.hpp>

#include "sessions/files/strict_json.h"

namespace herr {

// uv' = translation * rotation * scale * uv; the rotation turns counter-clockwise as v points down.
struct UvSource {
  int set = 0;  // TEXCOORD_n
  glm::dvec2 offset{0.0}, scale{1.0};
  double rotation_rad = 0;

  bool operator==(const UvSource& other) const = default;
  bool moves() const;  // false: coordinates are taken as they are
  glm::vec2 apply(const glm::vec2& uv) const;
};

// Of a texture reference such as baseColorTexture: its set, replaced by the extension's where that names one,
// and the extension's transform. Throws InputError.
UvSource read_uv_source(const JsonObject& texture_use);

}  // namespace herr
