#include "renderer/geometry/instance_records.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "renderer/geometry/surface_details.h"

namespace herr {

namespace {

constexpr double kEven = 1e-3;  // of a scale: what exporters round

bool stretches(const glm::dmat4x3& m) {
  const double longest2 = std::max({glm::dot(m[0], m[0]), glm::dot(m[1], m[1]), glm::dot(m[2], m[2])});
  for (int axis = 0; axis < 3; ++axis) {
    if (glm::dot(m[axis], m[axis]) < (1 - kEven) * longest2) return true;
    if (std::abs(glm::dot(m[axis], m[(axis + 1) % 3])) > kEven * longest2) return true;
  }
  return false;
}

}  // namespace

void set_matrix(const Instance& instance, InstanceRecord& record) {
  const glm::dmat4x3& m = instance.world_from_object;
  const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(m[0], m[1], m[2])));
  // Normals are made unit afterwards: a power of two keeps squares of the largest entry in a float's range.
  double largest = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(normal_matrix[column][row]));
  }
  const int exponent = std::ilogb(largest);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      record.normal_from_object[3 * row + column] =
          static_cast<float>(std::ldexp(normal_matrix[column][row], -exponent));
    }
  }
  const double volume = std::abs(glm::determinant(glm::dmat3(m[0], m[1], m[2])));
  record.object_per_world2 = static_cast<float>(std::pow(volume, -2.0 / 3.0));
  const double stretch = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
  record.face_per_world2 = stretches(m) ? static_cast<float>(std::ldexp(1.0 / volume, -exponent)) : 0.0f;
  record.least_offset_m = static_cast<float>(stretch * double{record.object_rounding});
}

namespace {

// Of light that a body lets through after its attenuation distance: what a colour of 0 is taken as, since 0
// would ask for an infinite absorption.
constexpr float kDarkestAttenuation = 1e-6f;

void set_material(const Material& material, InstanceRecord& record) {
  for (int channel = 0; channel < 3; ++channel) {
    record.base_colour[channel] = material.base_colour[channel];
    record.emission[channel] = material.emission[channel];
  }
  record.metallic = material.metallic;
  record.roughness = material.roughness;
  record.mirror = material.unlit ? 0.0f : material.mirror.value_or(-1.0f);
  // Index 0 is no index: a mirror, of F0 1, which nothing passes.
  const bool full = material.refractive_index <= 0;
  record.transmission = full ? 0.0f : material.transmission;
  record.refractive_index = full ? 1.0f : material.refractive_index;
  const float f0_root = (material.refractive_index - 1.0f) / (material.refractive_index + 1.0f);
  record.dielectric_f0 = full ? 1.0f : f0_root * f0_root;
  for (int channel = 0; channel < 3; ++channel) {
    const float colour = std::max(material.attenuation.colour[channel], kDarkestAttenuation);
    record.absorption[channel] = -std::log(colour) / material.attenuation.distance_m;
  }
}

void set_mesh(const Material& material, const BakedMesh& baked, bool has_uvs,
              std::span<const TextureRecord> textures, InstanceRecord& record) {
  record.triangles = baked.records.data();
  for (int axis = 0; axis < 2; ++axis) {
    record.uv_lower[axis] = baked.uv_lower[axis];
    record.uv_scale[axis] = baked.uv_scale[axis] / 65535.0f;
  }
  const auto texture = [&](int index) {
    return index >= 0 && has_uvs ? &textures[static_cast<std::size_t>(index)] : nullptr;
  };
  if (material.base_colour_uv_set == 0) record.base_colour_texture = texture(material.base_colour_texture);
  if (material.metallic_roughness_uv_set == 0) {
    record.metallic_roughness_texture = texture(material.metallic_roughness_texture);
  }
}

// Where rays are met, coordinates are the object's own. On an analytic shape they are about 1: eight
// roundings (going there, crossing, coming back), and twice that. On a triangle they are its own
// (rounded_length), and in voxels up to their number along the grid: two roundings.
constexpr float kShapeRounding = 0x1p-20f, kCornerRounding = 0x1p-23f;

float object_rounding(const Scene& scene, const Instance& instance) {
  if (instance.kind == ShapeKind::mesh) return kCornerRounding;
  if (instance.kind != ShapeKind::voxels) return kShapeRounding;
  const glm::ivec3& counts = scene.voxel_grids[instance.grid].counts;
  return kCornerRounding * static_cast<float>(std::max({counts.x, counts.y, counts.z}));
}

}  // namespace

InstanceRecord instance_record(const Scene& scene, const Instance& instance, const BakedMesh* baked,
                               std::span<const TextureRecord> textures) {
  const Material& material = scene.materials[instance.material];
  InstanceRecord record;
  record.kind = instance.kind;
  record.catcher = instance.catcher;
  record.back_face_culling = culls_back_faces(scene, instance);
  record.object_rounding = object_rounding(scene, instance);
  set_matrix(instance, record);
  set_material(material, record);
  if (baked) set_mesh(material, *baked, !scene.meshes[instance.mesh].uvs.empty(), textures, record);
  return record;
}

}  // namespace herr
