#include "renderer/geometry/surface_details.h"

#include <algorithm>
#include <cmath>

#include "scenes/model/material_textures.h"

namespace herr {
namespace {

const TriangleMesh* mesh_of(const Scene& scene, const Instance& instance) {
  return instance.kind == ShapeKind::mesh ? &scene.meshes[instance.mesh] : nullptr;
}

bool has_colours(const Scene& scene, const Instance& instance) {
  const TriangleMesh* mesh = mesh_of(scene, instance);
  return mesh != nullptr && !mesh->colours.empty();
}

bool has_further_textures(const Material& m) {
  const auto slots = texture_slots(m);
  const bool further = std::any_of(slots.begin() + kBaseTextures, slots.end(),
                                   [](const TextureSlot& slot) { return slot.texture >= 0; });
  return further || (m.base_colour_texture >= 0 && m.base_colour_uv_set != 0) ||
         (m.metallic_roughness_texture >= 0 && m.metallic_roughness_uv_set != 0);
}

void set_lobe_factors(const Material& m, LobeRecord& to) {
  to.coat = m.clearcoat.strength;
  to.coat_roughness = m.clearcoat.roughness;
  to.coat_normal_scale = m.clearcoat.normal_scale;
  for (int channel = 0; channel < 3; ++channel) to.sheen[channel] = m.sheen.colour[channel];
  to.sheen_roughness = m.sheen.roughness;
  to.stretch = m.anisotropy.strength;
  to.stretch_cos = std::cos(m.anisotropy.rotation_rad);
  to.stretch_sin = std::sin(m.anisotropy.rotation_rad);
}

// The textures of an instance, where they are and with the coordinates that they read.
class TextureUses {
 public:
  TextureUses(const BakedMesh& baked, std::span<const TextureRecord> textures)
      : baked_(baked), textures_(textures) {}

  TextureUse operator()(const TextureSlot& from) const {
    TextureUse to;
    if (from.texture < 0) return to;
    const BakedCoordinates& set =
        from.uv_set == 0 ? baked_ : baked_.more[static_cast<std::size_t>(from.uv_set) - 1];
    to.texture = &textures_[static_cast<std::size_t>(from.texture)];
    to.coordinates = set.records.data();
    for (int axis = 0; axis < 2; ++axis) {
      to.uv_lower[axis] = set.uv_lower[axis];
      to.uv_scale[axis] = set.uv_scale[axis] / 65535.0f;
    }
    return to;
  }

 private:
  const BakedMesh& baked_;
  std::span<const TextureRecord> textures_;
};

void set_textures(const Material& material, const TextureUses& use, DetailRecord& record) {
  record.emission = use(material.emission_texture);
  record.specular_use = use(material.specular_texture);
  record.specular_colour = use(material.specular_colour_texture);
  record.transmission = use(material.transmission_texture);
  record.occlusion = use(material.occlusion_texture);
  record.coverage = use({material.base_colour_texture, material.base_colour_uv_set});
  if (material.base_colour_uv_set != 0) record.base_colour = record.coverage;
  if (material.metallic_roughness_uv_set != 0) {
    record.metallic_roughness =
        use({material.metallic_roughness_texture, material.metallic_roughness_uv_set});
  }
  record.lobes.coat_texture = use(material.clearcoat.strength_texture);
  record.lobes.coat_roughness_texture = use(material.clearcoat.roughness_texture);
  record.lobes.sheen_texture = use(material.sheen.colour_texture);
  record.lobes.sheen_roughness_texture = use(material.sheen.roughness_texture);
  record.lobes.stretch_texture = use(material.anisotropy.texture);
  if (record.tangents == nullptr) return;
  record.normal = use(material.normal_texture);
  record.lobes.coat_normal = use(material.clearcoat.normal_texture);
}

}  // namespace

bool culls_back_faces(const Scene& scene, const Instance& instance) {
  const Material& material = scene.materials[instance.material];
  const TriangleMesh* mesh = mesh_of(scene, instance);
  return mesh != nullptr && !material.double_sided && material.transmission == 0 && !instance.catcher;
}

bool shows_backs(const Scene& scene, const Instance& instance) {
  return culls_back_faces(scene, instance) && !scene.meshes[instance.mesh].closed;
}

bool has_textures(const Scene& scene, const Instance& instance) {
  const Material& material = scene.materials[instance.material];
  const TriangleMesh* mesh = mesh_of(scene, instance);
  return mesh != nullptr && !mesh->uvs.empty() &&
         (material.base_colour_texture >= 0 || material.metallic_roughness_texture >= 0 ||
          has_further_textures(material));
}

bool has_holes(const Scene& scene, const Instance& instance) {
  const Material& material = scene.materials[instance.material];
  return instance.kind == ShapeKind::mesh && material.alpha_mode != AlphaMode::opaque;
}

bool blends(const Scene& scene, const Instance& instance) {
  return has_holes(scene, instance) && scene.materials[instance.material].alpha_mode == AlphaMode::blend;
}

bool has_details(const Scene& scene, const Instance& instance) {
  const Material& material = scene.materials[instance.material];
  const TriangleMesh* mesh = mesh_of(scene, instance);
  const bool textured = mesh != nullptr && !mesh->uvs.empty() && has_further_textures(material);
  return textured || has_colours(scene, instance) || has_holes(scene, instance) || material.unlit ||
         has_further_lobes(material) || material.specular != 1.0f ||
         material.specular_colour != glm::vec3(1.0f);
}

std::optional<DetailRecord> detail_record(const Scene& scene, const Instance& instance,
                                          const BakedMesh* baked, std::span<const TextureRecord> textures) {
  if (!has_details(scene, instance)) return std::nullopt;
  const Material& material = scene.materials[instance.material];
  DetailRecord record;
  record.unlit = material.unlit;
  record.specular = material.specular;
  for (int channel = 0; channel < 3; ++channel)
    record.specular_rgb[channel] = material.specular_colour[channel];
  set_lobe_factors(material, record.lobes);
  if (baked == nullptr) return record;
  record.alpha = material.alpha;
  record.alpha_cutoff = material.alpha_cutoff;
  record.alpha_mode = material.alpha_mode;
  record.normal_scale = material.normal_scale;
  record.occlusion_strength = material.occlusion_strength;
  if (!baked->colours.empty()) record.colours = baked->colours.data();
  if (!baked->tangents.empty()) record.tangents = baked->tangents.data();
  if (!scene.meshes[instance.mesh].uvs.empty()) set_textures(material, TextureUses(*baked, textures), record);
  return record;
}

}  // namespace herr
