#include "scenes/gltf/load_gltf.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <utility>

#include "scenes/gltf/accessor_reader.h"
#include "scenes/gltf/closed_mesh.h"
#include "scenes/gltf/gltf_limits.h"
#include "scenes/gltf/material_builder.h"
#include "scenes/gltf/mesh_builder.h"
#include "scenes/gltf/node_flattener.h"
#include "scenes/gltf/read_gltf.h"
#include "sessions/input_error.h"

namespace herr {
namespace {

// A primitive once built: where it stands in the scene.
struct BuiltPrimitive {
  std::uint32_t mesh, material;
};

bool reads_coordinates(const Material& material) {
  const int textures[] = {material.base_colour_texture,         material.metallic_roughness_texture,
                          material.emission_texture.texture,    material.normal_texture.texture,
                          material.specular_texture.texture,    material.specular_colour_texture.texture,
                          material.transmission_texture.texture};
  return std::any_of(std::begin(textures), std::end(textures), [](int texture) { return texture >= 0; });
}

// Builds the meshes of a file when the first instance asks for them.
class PrimitiveCache {
 public:
  PrimitiveCache(const GltfModel& model, Scene& scene)
      : model_(model), scene_(scene), materials_(model, scene) {}

  bool has(int mesh) const { return built_.count(mesh) != 0; }

  const std::vector<BuiltPrimitive>& primitives(int mesh) {
    const auto [entry, added] = built_.try_emplace(mesh);
    if (!added) return entry->second;
    const GltfMesh& from = model_.meshes[static_cast<std::size_t>(mesh)];
    for (const GltfPrimitive& primitive : from.primitives) {
      const auto built = build(primitive, from.name);
      if (built) entry->second.push_back(*built);
    }
    return entry->second;
  }

 private:
  std::optional<BuiltPrimitive> build(const GltfPrimitive& primitive, const std::string& name) {
    const std::vector<UvSource> sources = materials_.uv_sources(primitive.material, primitive);
    BuiltMesh built = build_mesh(model_, primitive, sources, budget_);
    for (const std::string& warning : built.warnings) warn("mesh \"" + printable(name) + "\": " + warning);
    if (built.mesh.triangles.empty()) return std::nullopt;
    if (materials_.lacks_coordinates(primitive.material, sources)) {
      warn("mesh \"" + printable(name) +
           "\" has no texture coordinates for some of its textures; these are left out");
    }
    built.mesh.name = name;
    const std::uint32_t material =
        materials_.material(primitive.material, sources, !built.mesh.colours.empty());
    const auto mesh = static_cast<std::uint32_t>(scene_.meshes.size());
    const Material& made = scene_.materials[material];
    // Textures may turn out unusable; then the coordinates have no reader.
    if (!reads_coordinates(made)) {
      built.mesh.uvs.clear();
      built.mesh.more_uvs.clear();
    }
    if (!made.double_sided) built.mesh.closed = is_closed(built.mesh);
    scene_.meshes.push_back(std::move(built.mesh));
    return BuiltPrimitive{mesh, material};
  }

  // Says each thing once, however many primitives it holds for.
  void warn(const std::string& text) {
    if (said_.insert(text).second) scene_.warnings.push_back(gltf_warning(model_, text));
  }

  const GltfModel& model_;
  Scene& scene_;
  MaterialBuilder materials_;
  MeshBudget budget_;
  std::map<int, std::vector<BuiltPrimitive>> built_;
  std::set<std::string> said_;
};

// A mesh that nothing shows is not built, but its indices must lead to vertices all the same.
void check_unshown_indices(const GltfModel& model, const PrimitiveCache& cache) {
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    if (cache.has(static_cast<int>(i))) continue;
    for (const GltfPrimitive& primitive : model.meshes[i].primitives) {
      if (primitive.indices < 0 || primitive.position < 0) continue;
      read_indices(model, primitive.indices,
                   model.accessors[static_cast<std::size_t>(primitive.position)].count);
    }
  }
}

GltfContent append(const std::filesystem::path& file, Scene& scene) {
  const GltfModel model = read_gltf(file);
  scene.files.insert(scene.files.end(), model.files.begin(), model.files.end());
  scene.warnings.insert(scene.warnings.end(), model.warnings.begin(), model.warnings.end());

  PrimitiveCache cache(model, scene);
  FlattenedNodes nodes = flatten_nodes(model);
  GltfContent content{{}, std::move(nodes.lights)};
  std::vector<Instance>& instances = content.instances;
  for (const PlacedMesh& placed : nodes.meshes) {
    for (const BuiltPrimitive& primitive : cache.primitives(placed.mesh)) {
      instances.push_back({placed.name, primitive.mesh, primitive.material, placed.gltf_from_mesh, false});
    }
    if (static_cast<std::int64_t>(instances.size()) > kMaxInstances) {
      throw InputError(file, 0, "has more than a million instances", "merge some of its nodes");
    }
  }
  check_unshown_indices(model, cache);
  if (instances.empty() && content.lights.empty())
    scene.warnings.push_back(gltf_warning(model, "shows nothing: its scene has no triangles"));
  return content;
}

}  // namespace

GltfContent append_gltf(const std::filesystem::path& file, Scene& scene) {
  // Whatever a library throws over this file is the file's fault, except a lack of memory within our own
  // limits.
  try {
    return append(file, scene);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(file, 0, "cannot be read as glTF: " + printable(error.what()), "export the model again");
  }
}

}  // namespace herr
