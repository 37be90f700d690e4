#include "server/inspect/scene_facts.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

namespace herr {
namespace {

bool has_no_area(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& corners) {
  const glm::dvec3 a = mesh.positions[corners[0]], b = mesh.positions[corners[1]],
                   c = mesh.positions[corners[2]];
  return glm::cross(b - a, c - a) == glm::dvec3(0.0);
}

void add_meshes(const Scene& scene, SceneFacts& facts) {
  facts.meshes = static_cast<std::int64_t>(scene.meshes.size());
  for (const TriangleMesh& mesh : scene.meshes) {
    facts.stored_triangles += static_cast<std::int64_t>(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles)
      facts.degenerate_triangles += has_no_area(mesh, triangle) ? 1 : 0;
    facts.geometry_bytes += static_cast<std::int64_t>(
        mesh.positions.size() * sizeof(mesh.positions[0]) + mesh.normals.size() * sizeof(mesh.normals[0]) +
        mesh.uvs.size() * sizeof(mesh.uvs[0]) + mesh.tangents.size() * sizeof(mesh.tangents[0]) +
        mesh.colours.size() * sizeof(mesh.colours[0]) + mesh.triangles.size() * sizeof(mesh.triangles[0]));
    for (const auto& set : mesh.more_uvs)
      facts.geometry_bytes += static_cast<std::int64_t>(set.size() * sizeof(set[0]));
  }
}

void add_grids(const Scene& scene, SceneFacts& facts) {
  for (const VoxelGrid& grid : scene.voxel_grids) {
    facts.grids.push_back({grid.name, grid.counts, grid.voxels(), grid.bytes()});
    facts.voxel_bytes += grid.bytes();
  }
}

void add_objects(const Scene& scene, SceneFacts& facts) {
  std::map<std::string, SceneObject> objects;
  for (const Instance& instance : scene.instances) {
    SceneObject& object = objects[instance.name.substr(0, instance.name.find('/'))];
    ++object.instances;
    if (instance.kind == ShapeKind::mesh)
      object.triangles += static_cast<std::int64_t>(scene.meshes[instance.mesh].triangles.size());
    if (instance.kind == ShapeKind::voxels) object.voxels += facts.grids[instance.grid].voxels;
    facts.spheres += instance.kind == ShapeKind::sphere ? 1 : 0;
    facts.boxes += instance.kind == ShapeKind::box ? 1 : 0;
    object.catcher = object.catcher || instance.catcher;
    facts.catchers += instance.catcher ? 1 : 0;
  }
  for (auto& [name, object] : objects) {
    object.name = name;
    facts.objects.push_back(object);
  }
  std::stable_sort(facts.objects.begin(), facts.objects.end(),
                   [](const SceneObject& a, const SceneObject& b) {
                     return a.triangles != b.triangles ? a.triangles > b.triangles : a.voxels > b.voxels;
                   });
}

}  // namespace

SceneFacts facts_of(const Scene& scene) {
  SceneFacts facts;
  facts.name = scene.name;
  facts.instances = static_cast<std::int64_t>(scene.instances.size());
  facts.triangles = triangle_count(scene, false);
  facts.catcher_triangles = triangle_count(scene, true) - facts.triangles;
  add_meshes(scene, facts);
  add_grids(scene, facts);
  add_objects(scene, facts);
  facts.materials = static_cast<std::int64_t>(scene.materials.size());
  for (const Material& material : scene.materials) {
    facts.mirrors += may_mirror(material) ? 1 : 0;
    facts.emitters += material.emission != glm::vec3(0.0f) ? 1 : 0;
  }
  facts.textures = static_cast<std::int64_t>(scene.textures.size());
  for (const TextureImage& texture : scene.textures) {
    const std::int64_t pixels = static_cast<std::int64_t>(texture.width_px) * texture.height_px;
    facts.texture_pixels += pixels;
    facts.texture_bytes += 4 * pixels;
  }
  facts.lights = static_cast<std::int64_t>(scene.lights.size());
  for (const AreaLight& light : scene.lights) {
    facts.moving_lights += light.path_radius_m > 0 && light.path_period_s != 0 ? 1 : 0;
    facts.virtual_lights += light.is_virtual ? 1 : 0;
  }
  for (const PlacedObject& object : scene.objects) facts.moving_objects += object.path.empty() ? 0 : 1;
  facts.ambient = scene.ambient;
  facts.environment = scene.environment;
  facts.exposure = scene.exposure;
  facts.bounds = scene_bounds(scene);
  facts.files = scene.files;
  return facts;
}

}  // namespace herr
