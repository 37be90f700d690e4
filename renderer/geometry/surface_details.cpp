#include "renderer/geometry/surface_details.h"

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
  return m.emission_texture.texture >= 0 || m.normal_texture.texture >= 0 ||
         m.specular_texture.texture >= 0 || m.specular_colour_texture.texture >= 0 ||
         m.transmission_texture.texture >= 0 || (m.base_colour_texture >= 0 && m.base_colour_uv_set != 0) ||
         (m.metallic_roughness_texture >= 0 && m.metallic_roughness_uv_set != 0);
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
         material.specular != 1.0f || material.specular_colour != glm::vec3(1.0f);
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
  if (baked == nullptr) return record;
  record.alpha = material.alpha;
  record.alpha_cutoff = material.alpha_cutoff;
  record.alpha_mode = material.alpha_mode;
  if (!baked->colours.empty()) record.colours = baked->colours.data();
  if (scene.meshes[instance.mesh].uvs.empty()) return record;
  const auto use = [&](int texture, int uv_set) {
    TextureUse to;
    if (texture < 0) return to;
    const BakedCoordinates& set = uv_set == 0 ? *baked : baked->more[static_cast<std::size_t>(uv_set) - 1];
    to.texture = &textures[static_cast<std::size_t>(texture)];
    to.coordinates = set.records.data();
    for (int axis = 0; axis < 2; ++axis) {
      to.uv_lower[axis] = set.uv_lower[axis];
      to.uv_scale[axis] = set.uv_scale[axis] / 65535.0f;
    }
    return to;
  };
  const auto slot = [&](const TextureSlot& from) { return use(from.texture, from.uv_set); };
  record.emission = slot(material.emission_texture);
  record.specular_use = slot(material.specular_texture);
  record.specular_colour = slot(material.specular_colour_texture);
  record.transmission = slot(material.transmission_texture);
  if (!baked->tangents.empty() && material.normal_texture.texture >= 0) {
    record.normal = slot(material.normal_texture);
    record.normal_scale = material.normal_scale;
    record.tangents = baked->tangents.data();
  }
  record.coverage = use(material.base_colour_texture, material.base_colour_uv_set);
  if (material.base_colour_uv_set != 0) record.base_colour = record.coverage;
  if (material.metallic_roughness_uv_set != 0) {
    record.metallic_roughness = use(material.metallic_roughness_texture, material.metallic_roughness_uv_set);
  }
  return record;
}

}  // namespace herr
