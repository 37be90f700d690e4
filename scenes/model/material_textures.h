// Every texture that a material reads, in one list. Before: scene. After: load_gltf (does anything read a
// mesh's coordinates?), renderer/geometry (does it need more than two textures?).
#pragma once

#include <array>

#include "scenes/model/material.h"

namespace herr {

inline constexpr std::size_t kBaseTextures = 2;  // of these the first are base colour and metallic-roughness

inline std::array<TextureSlot, 14> texture_slots(const Material& m) {
  return {TextureSlot{m.base_colour_texture, m.base_colour_uv_set},
          TextureSlot{m.metallic_roughness_texture, m.metallic_roughness_uv_set},
          m.emission_texture,
          m.normal_texture,
          m.specular_texture,
          m.specular_colour_texture,
          m.transmission_texture,
          m.occlusion_texture,
          m.clearcoat.strength_texture,
          m.clearcoat.roughness_texture,
          m.clearcoat.normal_texture,
          m.sheen.colour_texture,
          m.sheen.roughness_texture,
          m.anisotropy.texture};
}

// Does it bend normals or stretch highlights, which needs tangents?
inline bool follows_tangents(const Material& m) {
  return m.normal_texture.texture >= 0 || m.clearcoat.normal_texture.texture >= 0 ||
         m.anisotropy.strength > 0;
}

// The coordinates that made tangents follow: those of the normal texture where there is one.
inline int tangent_uv_set(const Material& m) {
  for (const TextureSlot& slot : {m.normal_texture, m.anisotropy.texture, m.clearcoat.normal_texture}) {
    if (slot.texture >= 0) return slot.uv_set;
  }
  return 0;
}

}  // namespace herr
