#include "scenes/document/scene_document.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

#include "scenes/detail/simplify_mesh.h"
#include "scenes/document/document_limits.h"
#include "scenes/document/named_file.h"
#include "scenes/document/parse_change.h"
#include "scenes/document/room_scan.h"
#include "scenes/document/scene_document_parts.h"
#include "scenes/document/scene_document_paths.h"
#include "scenes/document/scene_document_shapes.h"
#include "scenes/document/scene_document_voxels.h"
#include "scenes/document/written_order.h"
#include "scenes/environment/environment_image.h"
#include "scenes/gltf/load_gltf.h"
#include "scenes/gltf/node_flattener.h"
#include "scenes/model/transform_checks.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

// A glTF file as it was appended to the scene, for entries that name it again.
// Entries that play different animations do not share.
struct LoadedFile {
  std::filesystem::path file;
  PlaybackRequest playback;
  GltfContent content;
};
struct LoadedFiles {
  TexturePixels pixels = TexturePixels::decoded;
  std::span<const std::filesystem::path> asset_roots;
  std::vector<LoadedFile> files;
};

// The material of an instance with the entry's changes; made once per entry and material.
std::uint32_t changed_material(std::uint32_t original, const MaterialOverride& change, Scene& scene,
                               std::map<std::uint32_t, std::uint32_t>& changed) {
  const auto [entry, added] = changed.try_emplace(original, 0);
  if (added) {
    entry->second = static_cast<std::uint32_t>(scene.materials.size());
    Material material = change.apply(scene.materials[original]);
    scene.materials.push_back(std::move(material));
  }
  return entry->second;
}

// A name without an ending may be a model; one of another format is none.
void refuse_other_formats(const JsonObject& entry) {
  const std::filesystem::path file = entry.text("file");
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension.empty() || extension == ".gltf" || extension == ".glb") return;
  entry.fail("file", "names " + printable(file.string()) + ", which is not of a format that can be shown",
             extension == ".vox" ? "move the entry to \"voxels\""
                                 : "name a .gltf or .glb file (convert other models to .glb first)");
}

void append_entry(const JsonObject& entry, LoadedFiles& loaded, Scene& scene) {
  entry.allow_only({"file", "name", "translation", "rotation_xyzw", "scale", "catcher", "material",
                    "detail_levels", "present", "animation", "path", "virtual_lights"});
  const Placement placement = parse_placement_change(entry).apply({});
  const std::string name = entry.text_or("name", "");
  const bool catcher = entry.boolean_or("catcher", false);
  const bool changes = entry.has("material");
  const MaterialOverride change =
      changes ? parse_material_override(entry.object("material")) : MaterialOverride{};

  refuse_other_formats(entry);
  const std::filesystem::path file = named_file(entry, "file", loaded.asset_roots);
  const PlaybackRequest playback =
      entry.has("animation") ? parse_playback(entry.object("animation")) : PlaybackRequest{};
  const auto same = [&](const LoadedFile& other) { return other.file == file && other.playback == playback; };
  auto known = std::find_if(loaded.files.begin(), loaded.files.end(), same);
  if (known == loaded.files.end())
    known = loaded.files.insert(loaded.files.end(),
                                {file, playback, append_gltf(file, scene, playback, loaded.pixels)});

  const bool detail_levels = entry.boolean_or("detail_levels", false);
  PlacedObject object{name,
                      placement,
                      static_cast<std::uint32_t>(scene.instances.size()),
                      0,
                      entry.boolean_or("present", true),
                      parse_path(entry, placement)};
  const glm::dmat4x3 world_from_gltf = object.start().matrix();
  std::map<std::uint32_t, std::uint32_t> changed;
  const bool virtual_lights = entry.boolean_or("virtual_lights", false);
  for (const AreaLight& light : known->content.lights) {
    scene.lights.push_back(placed_light(world_from_gltf, light));
    scene.lights.back().is_virtual = virtual_lights;
  }
  if (virtual_lights && known->content.lights.empty()) {
    scene.warnings.push_back(printable(entry.file().string()) + ": " + entry.where() +
                             ": virtual_lights means nothing: the glTF file has no light");
  }
  if (!known->content.lights.empty() && !object.path.empty()) {
    scene.warnings.push_back(printable(entry.file().string()) + ": " + entry.where() +
                             ": the lights of a glTF file do not follow its path: they stay where it starts");
  }
  for (Instance instance : known->content.instances) {
    check_path(entry, object.path, scene, instance);
    instance.present = object.present;
    instance.world_from_object = compose(world_from_gltf, instance.world_from_object);
    if (const auto problem = transform_problem(instance.world_from_object)) {
      entry.fail("scale", "together with the nodes of the model " + *problem, "write a larger scale");
    }
    // "teapot/lid": which entry, and which of its nodes.
    if (!name.empty()) instance.name = instance.name.empty() ? name : name + "/" + instance.name;
    instance.catcher = catcher;
    // What bends has no coarser forms: they would keep the shape of time 0.
    const bool bends = std::any_of(scene.deformations.begin(), scene.deformations.end(),
                                   [&](const MeshDeformation& one) { return one.mesh == instance.mesh; });
    if (detail_levels && !bends) add_coarser_meshes(scene, instance.mesh);
    if (changes) instance.material = changed_material(instance.material, change, scene, changed);
    scene.instances.push_back(std::move(instance));
    ++object.count;
  }
  if (object.count > 0) scene.objects.push_back(std::move(object));
}

// A room cannot be scaled: it is real.
void read_room_scan(const JsonObject& entry, std::span<const std::filesystem::path> asset_roots,
                    Scene& scene) {
  entry.allow_only(
      {"file", "name", "translation", "rotation_xyzw", "base_colour", "metallic", "roughness", "mirror"});
  const glm::dmat4x3 world_from_scan = parse_placement(entry);
  const Material material = parse_catcher_material(entry, entry.text_or("name", "room"));
  append_room_scan(named_file(entry, "file", asset_roots), world_from_scan, material, scene);
}

void read_environment(const JsonObject& entry, std::span<const std::filesystem::path> asset_roots,
                      Scene& scene) {
  entry.allow_only({"file", "turn_deg", "scale"});
  const std::filesystem::path file = named_file(entry, "file", asset_roots);
  const auto turn_deg = static_cast<float>(entry.number_or("turn_deg", -360, 360, 0));
  const auto scale = static_cast<float>(entry.number_or("scale", 0, kBrightest, 1));
  std::vector<std::string> remarks;
  scene.environment_map = read_environment_image(file, remarks);
  scene.environment_map.turn_deg = turn_deg;
  for (float& value : scene.environment_map.rgba) value *= scale;
  scene.files.push_back(file);
  for (const std::string& remark : remarks) {
    scene.warnings.push_back(printable(file.string()) + ": " + remark);
  }
}

}  // namespace

Scene read_scene_document(const std::filesystem::path& file, TexturePixels pixels,
                          std::span<const std::filesystem::path> asset_roots) {
  const JsonDocument document(file);
  const JsonObject root = document.root();
  root.require_version(1);  // first: in a newer version any other field may have a new meaning
  root.allow_only({"format_version", "name", "gltf", "shapes", "voxels", "catchers", "room_scan", "lights",
                   "ambient", "environment", "environment_map", "world_from_session", "probes", "timeline",
                   "exposure_ev", "auto_exposure"});
  Scene scene;
  scene.files.push_back(file);
  scene.name = root.text("name");
  if (std::string warning = w_first_warning(root); !warning.empty())
    scene.warnings.push_back(std::move(warning));
  scene.ambient = glm::vec3(root.vec3_or("ambient", 0, kBrightest, glm::dvec3(0.0)));
  scene.environment = glm::vec3(root.vec3_or("environment", 0, kBrightest, glm::dvec3(0.0)));
  if (root.has("environment_map")) {
    if (root.has("environment")) {
      root.fail("environment_map", "stands beside an environment of one colour", "write only one of them");
    }
    read_environment(root.object("environment_map"), asset_roots, scene);
  }
  scene.exposure = parse_exposure(root);
  if (root.has("probes")) scene.probes = parse_probes(root.object("probes"));
  if (root.has("world_from_session"))
    scene.world_from_session = parse_pose(root.object("world_from_session"));
  for (const JsonObject& light : root.objects("lights")) scene.lights.push_back(parse_light(light));
  for (const JsonObject& catcher : root.objects("catchers")) append_catcher(catcher, scene);
  for (const JsonObject& shape : root.objects("shapes")) append_shape(shape, scene);
  if (root.has("room_scan")) read_room_scan(root.object("room_scan"), asset_roots, scene);

  LoadedFiles loaded{pixels, asset_roots, {}};
  for (const JsonObject& entry : root.objects("gltf")) append_entry(entry, loaded, scene);
  append_voxel_entries(root.objects("voxels"), asset_roots, scene);
  scene.timeline = parse_timeline(root);
  return scene;
}

}  // namespace herr
