#include "scenes/gltf/load_gltf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <utility>

#include "scenes/animation/bend_mesh.h"
#include "scenes/animation/model_pose.h"
#include "scenes/gltf/closed_mesh.h"
#include "scenes/gltf/file/accessor_reader.h"
#include "scenes/gltf/file/gltf_limits.h"
#include "scenes/gltf/file/read_gltf.h"
#include "scenes/gltf/material_builder.h"
#include "scenes/gltf/mesh_builder.h"
#include "scenes/gltf/mesh_unit.h"
#include "scenes/gltf/node_flattener.h"
#include "scenes/gltf/vertex_tangents.h"
#include "scenes/model/material_textures.h"
#include "scenes/model/transform_checks.h"
#include "sessions/files/input_error.h"
#include "sessions/pictures/loaded_module.h"

namespace herr {
namespace {

bool reads_textures(const Material& material) {
  const auto slots = texture_slots(material);
  return std::any_of(slots.begin(), slots.end(), [](const TextureSlot& slot) { return slot.texture >= 0; });
}

// Builds the meshes of a file when the first instance asks for them.
class PrimitiveCache {
 public:
  PrimitiveCache(const GltfModel& model, Scene& scene, MeshBudget& budget, TexturePixels pixels)
      : model_(model), scene_(scene), budget_(budget), materials_(model, scene, pixels) {}

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

  void finish() { materials_.warn_of_losses(); }

 private:
  std::optional<BuiltPrimitive> build(const GltfPrimitive& primitive, const std::string& name) {
    const std::vector<UvSource> sources = materials_.uv_sources(primitive.material, primitive);
    BuiltMesh built =
        build_mesh(model_, primitive, sources, materials_.reads_tangents(primitive.material), budget_);
    for (const std::string& warning : built.warnings) warn("mesh \"" + printable(name) + "\": " + warning);
    if (built.mesh.triangles.empty()) return std::nullopt;
    if (materials_.lacks_coordinates(primitive.material, sources)) {
      warn("mesh \"" + printable(name) +
           "\" has no texture coordinates for some of its textures; these are left out");
    }
    built.mesh.name = name;
    const std::uint32_t material = materials_.material(primitive.material, sources);
    const auto mesh = static_cast<std::uint32_t>(scene_.meshes.size());
    const Material& made = scene_.materials[material];
    const bool makes_tangents = give_tangents(made, built);
    // Textures may turn out unusable; then the coordinates have no reader.
    if (!reads_textures(made) && !follows_tangents(made)) {
      built.mesh.uvs.clear();
      built.mesh.more_uvs.clear();
    }
    if (!made.double_sided) built.mesh.closed = is_closed_outwards(built.mesh);
    warn_of_bodies(made, built.mesh);
    const bool bends = primitive.joints[0] >= 0 || !primitive.targets.empty();
    const double unit = bends ? 1 : take_unit(built.mesh);
    scene_.meshes.push_back(std::move(built.mesh));
    if (!bends) built.sources.clear();
    return BuiltPrimitive{
        mesh, material, &primitive, std::move(built.sources), tangent_uv_set(made), makes_tangents, unit};
  }

  void warn_of_bodies(const Material& material, const TriangleMesh& mesh) {
    const std::string name = "mesh \"" + printable(mesh.name) + "\" ";
    if (std::isfinite(material.attenuation.distance_m) && material.attenuation.colour != glm::vec3(1.0f) &&
        material.transmission > 0 && !mesh.closed && !is_closed(mesh))
      warn(name + "is not closed: light that leaves it through a gap loses nothing to material \"" +
           printable(material.name) + "\"");
    if (!material.double_sided && !mesh.closed && is_closed_inwards(mesh))
      warn(name + "is closed and faces inwards: its back faces, which no eye sees, shade what is inside");
  }

  // Leaves tangents where the material follows them; true: made here.
  bool give_tangents(const Material& material, BuiltMesh& built) {
    if (!follows_tangents(material)) built.mesh.tangents = {};
    if (!follows_tangents(material) || !built.mesh.tangents.empty()) return false;
    if (built.mesh.uvs.empty()) {
      warn("mesh \"" + printable(built.mesh.name) +
           "\" has neither tangents nor texture coordinates: its highlights are round, not stretched");
      return false;
    }
    make_tangents(built, tangent_uv_set(material));
    return true;
  }

  // Says each thing once, however many primitives it holds for.
  void warn(const std::string& text) {
    if (said_.insert(text).second) scene_.warnings.push_back(gltf_warning(model_, text));
  }

  const GltfModel& model_;
  Scene& scene_;
  MeshBudget& budget_;
  MaterialBuilder materials_;
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

// Places primitives as a model has them at time 0, and keeps what moves or bends them later.
class ModelBuilder {
 public:
  ModelBuilder(const GltfModel& gltf, const PlaybackRequest& playback, Scene& scene, MeshBudget& budget)
      : gltf_(gltf),
        scene_(scene),
        budget_(budget),
        model_(animated_model(gltf, playback)),
        pose_(model_),
        moved_(moved_nodes(model_)),
        index_(static_cast<int>(scene.models.size())) {}

  Instance place(const PlacedMesh& placed, const BuiltPrimitive& primitive) {
    Instance instance;
    instance.name = placed.name;
    instance.mesh = primitive.mesh;
    instance.material = primitive.material;
    instance.world_from_object = in_units(placed.gltf_from_mesh, primitive.unit);
    std::optional<MeshDeformation> bent;
    if (!primitive.sources.empty()) {
      bent = mesh_deformation(gltf_, primitive, placed.node, rest_of(primitive.mesh), budget_);
    }
    const bool skinned = bent && bent->skin >= 0;
    if (!skinned) check(instance, placed.node);
    if (bent) instance.mesh = bend(std::move(*bent), primitive.mesh);
    // A skin alone says where its mesh stands, whatever its node says.
    if (skinned) {
      instance.world_from_object = glm::dmat4x3(1.0);
    } else if (plays() && moved_[static_cast<std::size_t>(placed.node)]) {
      instance.model = index_;
      instance.node = placed.node;
      instance.placed_from_object = in_units(placed.node_from_mesh, primitive.unit);
      const glm::dmat4x3 posed = compose(pose_.model_from_node(placed.node), instance.placed_from_object);
      if (!transform_problem(posed)) instance.world_from_object = posed;
      return instance;
    }
    instance.placed_from_object = instance.world_from_object;
    return instance;
  }

  void finish() {
    if (plays()) scene_.models.push_back(std::move(model_));
  }

 private:
  bool plays() const { return model_.playback.clip >= 0; }

  void check(const Instance& instance, int node) const {
    const auto problem = transform_problem(instance.world_from_object);
    if (!problem) return;
    const std::string& name = gltf_.nodes[static_cast<std::size_t>(node)].name;
    throw InputError(
        gltf_.file, 0,
        "the transform of nodes[" + std::to_string(node) + "] \"" + printable(name) + "\" " + *problem,
        "give the node a scale that is not 0, or remove it");
  }

  // The shape at rest of a mesh that may have been bent already.
  TriangleMesh rest_of(std::uint32_t mesh) {
    const auto known = rest_.find(mesh);
    return known == rest_.end() ? scene_.meshes[mesh] : known->second;
  }

  // A mesh of the scene in this pose; each bent node has one of its own.
  std::uint32_t bend(MeshDeformation bent, std::uint32_t mesh) {
    if (rest_.count(mesh) == 0) {
      rest_.emplace(mesh, scene_.meshes[mesh]);
    } else {
      TriangleMesh copy = rest_.at(mesh);
      mesh = static_cast<std::uint32_t>(scene_.meshes.size());
      scene_.meshes.push_back(std::move(copy));
    }
    bent.mesh = mesh;
    bent.model = index_;
    DeformationPose pose;
    pose_.bend(bent, pose);
    bend_mesh(bent, pose, scene_.meshes[mesh]);
    if (plays()) scene_.deformations.push_back(std::move(bent));
    return mesh;
  }

  const GltfModel& gltf_;
  Scene& scene_;
  MeshBudget& budget_;
  AnimatedModel model_;
  ModelPose pose_;
  std::vector<bool> moved_;
  int index_;
  std::map<std::uint32_t, TriangleMesh> rest_;
};

GltfContent append(const std::filesystem::path& file, Scene& scene, const PlaybackRequest& playback,
                   TexturePixels pixels) {
  const GltfModel model = read_gltf(file);
  scene.files.insert(scene.files.end(), model.files.begin(), model.files.end());
  scene.warnings.insert(scene.warnings.end(), model.warnings.begin(), model.warnings.end());

  MeshBudget budget;
  PrimitiveCache cache(model, scene, budget, pixels);
  ModelBuilder builder(model, playback, scene, budget);
  FlattenedNodes nodes = flatten_nodes(model);
  GltfContent content{{}, std::move(nodes.lights)};
  std::vector<Instance>& instances = content.instances;
  for (const PlacedMesh& placed : nodes.meshes) {
    for (const BuiltPrimitive& primitive : cache.primitives(placed.mesh)) {
      instances.push_back(builder.place(placed, primitive));
    }
    if (static_cast<std::int64_t>(instances.size()) > kMaxInstances) {
      throw InputError(file, 0, "has more than a million instances", "merge some of its nodes");
    }
  }
  builder.finish();
  cache.finish();
  check_unshown_indices(model, cache);
  if (instances.empty() && content.lights.empty())
    scene.warnings.push_back(gltf_warning(model, "shows nothing: its scene has no triangles"));
  return content;
}

}  // namespace

GltfContent append_gltf(const std::filesystem::path& file, Scene& scene, const PlaybackRequest& playback,
                        TexturePixels pixels) {
  // Whatever a library throws over this file is the file's fault, except a lack of memory within our own
  // limits and of the module that decodes pictures.
  try {
    return append(file, scene, playback, pixels);
  } catch (const InputError&) {
    throw;
  } catch (const ModuleError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(file, 0, "cannot be read as glTF: " + printable(error.what()), "export the model again");
  }
}

}  // namespace herr
