// What a scene document or an event changes about a material. Before: scene_document_parts reads it. After: a
// material with these values instead of its own.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

namespace herr {

struct Material;

struct MaterialOverride {
  std::optional<glm::vec3> base_colour, emission;
  std::optional<float> metallic, roughness, mirror, transmission, refractive_index;
  Material apply(Material material) const;
};

}  // namespace herr
