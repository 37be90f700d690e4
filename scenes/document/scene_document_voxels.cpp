#include "scenes/document/scene_document_voxels.h"

#include <map>
#include <string>
#include <utility>

#include "scenes/document/named_file.h"
#include "scenes/document/scene_document_parts.h"
#include "scenes/document/scene_document_paths.h"
#include "scenes/model/transform_checks.h"
#include "scenes/voxels/load_vox.h"
#include "scenes/voxels/raw_grid.h"
#include "scenes/voxels/voxel_limits.h"
#include "scenes/voxels/voxelise_mesh.h"

namespace herr {
namespace {

glm::dmat4x3 scaled(double scale) {
  return {glm::dvec3{scale, 0, 0}, glm::dvec3{0, scale, 0}, glm::dvec3{0, 0, scale}, glm::dvec3{0.0}};
}

// What an entry shows before it is placed, by what it names: file, and resolution of a mesh.
class VoxelSources {
 public:
  VoxelSources(std::span<const std::filesystem::path> asset_roots, Scene& scene)
      : asset_roots_(asset_roots), scene_(&scene) {}

  // Instances in metres.
  const std::vector<Instance>& of(const JsonObject& entry) {
    const int named = (entry.has("file") ? 1 : 0) + (entry.has("grid") ? 1 : 0) + (entry.has("mesh") ? 1 : 0);
    if (named != 1) {
      entry.fail(nullptr, "needs one of file, grid and mesh",
                 "write \"file\" for a .vox file, \"grid\" or \"mesh\"");
    }
    if (entry.has("file")) return known(named_file(entry, "file", asset_roots_), 0, &VoxelSources::vox);
    if (entry.has("grid")) return known(named_file(entry, "grid", asset_roots_), 0, &VoxelSources::raw);
    const JsonObject mesh = entry.object("mesh");
    mesh.allow_only({"file", "resolution"});
    return known(named_file(mesh, "file", asset_roots_),
                 static_cast<int>(mesh.integer("resolution", 1, kMaxMeshResolution)), &VoxelSources::mesh);
  }

 private:
  using Make = std::vector<Instance> (VoxelSources::*)(const std::filesystem::path&, int);

  const std::vector<Instance>& known(const std::filesystem::path& file, int resolution, Make make) {
    const auto key = std::pair{file, resolution};
    const auto found = made_.find(key);
    return found != made_.end() ? found->second
                                : made_.emplace(key, (this->*make)(file, resolution)).first->second;
  }

  std::vector<Instance> vox(const std::filesystem::path& file, int) {
    std::vector<Instance> instances = append_vox(file, *scene_);
    for (Instance& instance : instances)
      instance.world_from_object = compose(scaled(kVoxSize_m), instance.world_from_object);
    return instances;
  }
  std::vector<Instance> raw(const std::filesystem::path& file, int) {
    const RawGrid raw = append_raw_grid(file, *scene_);
    return {single(raw.grid, scaled(raw.voxel_size_m))};
  }
  std::vector<Instance> mesh(const std::filesystem::path& file, int resolution) {
    const VoxelisedMesh made = append_voxelised_mesh(file, resolution, *scene_);
    return {single(made.grid, made.gltf_from_grid)};
  }
  Instance single(std::uint32_t grid, const glm::dmat4x3& metres_from_grid) {
    Instance instance;
    instance.kind = ShapeKind::voxels;
    instance.grid = grid;
    instance.name = scene_->voxel_grids[grid].name;
    instance.material = append_voxel_material(instance.name, *scene_);
    instance.world_from_object = metres_from_grid;
    return instance;
  }

  std::span<const std::filesystem::path> asset_roots_;
  Scene* scene_;
  std::map<std::pair<std::filesystem::path, int>, std::vector<Instance>> made_;
};

// The colour is the voxels' own, and what is behind one is not refracted: these fields mean nothing here.
MaterialOverride voxel_material(const JsonObject& object) {
  object.allow_only({"metallic", "roughness", "mirror", "emission"});
  return parse_material_override(object);
}

void append_entry(const JsonObject& entry, VoxelSources& sources, Scene& scene) {
  entry.allow_only({"file", "grid", "mesh", "name", "translation", "rotation_xyzw", "scale", "catcher",
                    "material", "present", "path"});
  const std::string name = entry.text_or("name", "");
  const Placement placement = parse_placement_change(entry).apply({});
  const bool present = entry.boolean_or("present", true);
  PlacedObject object{name, placement, static_cast<std::uint32_t>(scene.instances.size()),
                      0,    present,   parse_path(entry, placement)};
  const glm::dmat4x3 world_from_entry = object.start().matrix();
  const bool catcher = entry.boolean_or("catcher", false);
  std::optional<MaterialOverride> change;
  if (entry.has("material")) change = voxel_material(entry.object("material"));

  std::map<std::uint32_t, std::uint32_t> changed;
  const std::vector<Instance>& parts = sources.of(entry);
  for (Instance instance : parts) {
    check_path(entry, object.path, scene, instance);
    instance.placed_from_object = instance.world_from_object;
    instance.world_from_object = compose(world_from_entry, instance.world_from_object);
    if (const auto problem = transform_problem(instance.world_from_object)) {
      entry.fail("scale", "together with the size of a voxel " + *problem, "write a larger scale");
    }
    if (!name.empty()) instance.name = name + "/" + instance.name;
    instance.catcher = catcher;
    instance.present = present;
    if (change) {
      const auto [made, added] =
          changed.try_emplace(instance.material, static_cast<std::uint32_t>(scene.materials.size()));
      if (added) {
        Material material = change->apply(scene.materials[instance.material]);
        scene.materials.push_back(std::move(material));
      }
      instance.material = made->second;
    }
    scene.instances.push_back(std::move(instance));
    ++object.count;
  }
  if (name.empty() && parts.size() == 1) object.name = parts.front().name;
  if (object.count > 0) scene.objects.push_back(std::move(object));
}

}  // namespace

void append_voxel_entries(const std::vector<JsonObject>& entries,
                          std::span<const std::filesystem::path> asset_roots, Scene& scene) {
  VoxelSources sources(asset_roots, scene);
  for (const JsonObject& entry : entries) append_entry(entry, sources, scene);
}

}  // namespace herr
