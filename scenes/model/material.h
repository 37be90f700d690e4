// What surfaces are made of: factors and textures of the metallic-roughness model, and the further lobes that
// few materials have. Before: gltf/material_builder, document, voxels. After: renderer/geometry makes
// records.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace herr {

enum class TextureWrap : std::uint8_t { repeat, clamp, mirror };

// 8-bit RGBA, rows from v = 0 downwards as glTF defines (v = 0 is the top row).
struct TextureImage {
  std::string name;
  int width_px = 0, height_px = 0;  // 1 ... 16384
  bool srgb = true;  // colour: decode to linear light after the fetch; false: values are linear
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
  std::vector<std::uint8_t> rgba;  // 4 * width * height
  bool nearest = false;            // magnified texels stay squares (sampler filter NEAREST)
  bool covers = false;             // alpha is coverage: colours of smaller levels are weighted by it
};

// mask: a surface has holes where its alpha lies below the cutoff. blend: it covers what is behind by alpha.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

// A texture and which of the mesh's coordinates it reads: set 0 is TriangleMesh::uvs,
// set n is more_uvs[n - 1].
struct TextureSlot {
  int texture = -1;  // index into Scene::textures, -1 = none
  int uv_set = 0;
};

// A thin clear layer over the surface, of index 1.5: a second highlight (KHR_materials_clearcoat).
struct Clearcoat {
  float strength = 0.0f;          // [0, 1]; 0: none
  float roughness = 0.0f;         // [0, 1]
  float normal_scale = 1.0f;      // of the normal texture's x and y
  TextureSlot strength_texture;   // R
  TextureSlot roughness_texture;  // G
  TextureSlot normal_texture;     // RGB = tangent space, linear; none: the interpolated normal
};

// Light that fibres send back at grazing angles (KHR_materials_sheen).
struct Sheen {
  glm::vec3 colour{0.0f};         // [0, 1]; 0: none
  float roughness = 0.0f;         // [0, 1]
  TextureSlot colour_texture;     // sRGB
  TextureSlot roughness_texture;  // A
};

// A highlight that is longer along one direction of the surface (KHR_materials_anisotropy).
struct Anisotropy {
  float strength = 0.0f;      // [0, 1]; 0: none
  float rotation_rad = 0.0f;  // counter-clockwise from the tangent
  TextureSlot texture;        // RG = direction, B = strength, linear
};

// What light loses on its way through a transparent body (KHR_materials_volume): after `distance_m` metres,
// in world space, `colour` is left of it.
struct Attenuation {
  glm::vec3 colour{1.0f};  // (0, 1]
  float distance_m = std::numeric_limits<float>::infinity();
};

// glTF metallic-roughness in linear light. Mapping to the paper's factors (see scenes/gltf/README.md):
// diffuse = base_colour * (1 - metallic), specular F0 = mix(0.04, base_colour, metallic) with GGX alpha =
// roughness^2; what it mirrors is by roughness, or the paper's reflection factor where `mirror` gives one.
struct Material {
  std::string name;
  glm::vec3 base_colour{0.8f};  // [0, 1]
  float metallic = 0.0f;        // [0, 1]
  float roughness = 0.8f;       // [0, 1]
  glm::vec3 emission{0.0f};     // radiance, >= 0
  // [0, 1] share of the mirror ray that is seen, times Schlick's F; 0 traces none. None: by the roughness of
  // each place.
  std::optional<float> mirror;
  int base_colour_texture = -1;         // index into Scene::textures, -1 = none
  int metallic_roughness_texture = -1;  // G = roughness, B = metallic (linear)
  float smoothest_texel = 0.0f;   // at most the least G of that texture, 0 ... 1: tells where none mirrors
  float transmission = 0.0f;      // [0, 1] share of light that passes, refracted
  float refractive_index = 1.5f;  // [1, 100], or 0: a mirror, F0 is 1 (KHR_materials_ior)
  int base_colour_uv_set = 0, metallic_roughness_uv_set = 0;  // as TextureSlot::uv_set

  float alpha = 1.0f;  // [0, 1], times the base colour texture's and the vertices'; unused where opaque
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;            // of mask
  bool double_sided = true;             // false: eyes see its front only
  bool unlit = false;                   // shows its base colour whatever the light
  float specular = 1.0f;                // [0, 1] strength of a dielectric's highlights
  glm::vec3 specular_colour{1.0f};      // >= 0, tints them
  float normal_scale = 1.0f;            // of the normal texture's x and y
  TextureSlot emission_texture;         // sRGB
  TextureSlot specular_texture;         // A = strength
  TextureSlot specular_colour_texture;  // sRGB
  TextureSlot transmission_texture;     // R
  TextureSlot normal_texture;           // RGB = tangent space, linear

  float occlusion_strength = 1.0f;  // [0, 1], of the occlusion texture
  TextureSlot occlusion_texture;    // R, linear: share of light from all sides that arrives
  Clearcoat clearcoat;
  Sheen sheen;
  Anisotropy anisotropy;
  Attenuation attenuation;
};

// Roughness from which on no mirror ray is traced: a GGX lobe is some 14 degrees wide there, and one ray no
// longer stands for it.
inline constexpr float kRoughestMirror = 0.35f;

// May some place of it send a mirror ray?
inline bool may_mirror(const Material& material) {
  if (material.mirror) return *material.mirror > 0;
  if (material.unlit || (material.metallic <= 0 && material.specular <= 0)) return false;
  const float texel = material.metallic_roughness_texture >= 0 ? material.smoothest_texel : 1.0f;
  return material.roughness * texel < kRoughestMirror;
}

// Has it lobes beyond diffuse and one isotropic highlight?
inline bool has_further_lobes(const Material& material) {
  return material.clearcoat.strength > 0 || material.sheen.colour != glm::vec3(0.0f) ||
         material.anisotropy.strength > 0;
}

}  // namespace herr
