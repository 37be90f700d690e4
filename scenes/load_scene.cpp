#include "scenes/load_scene.h"

// Which reader a path gets, and the light of a bare glTF file.
#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "scenes/changes/check_changes.h"
#include "scenes/document/named_file.h"
#include "scenes/document/scene_document.h"
#include "scenes/gltf/load_gltf.h"
#include "scenes/model/placed_objects.h"
#include "scenes/model/transform_checks.h"
#include "scenes/voxels/load_vox.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

// One light above the middle, as far from it as the model's own diagonal, so that it stays clear of it. Its
// irradiance at the middle is pi W/m^2: a white diffuse surface there has radiance 1.
AreaLight light_above(const Bounds& bounds) {
  const glm::dvec3 extent = bounds.upper - bounds.lower;
  double diagonal_m = glm::length(extent);
  if (!(diagonal_m > 0)) diagonal_m = 1;  // nothing, or a point
  const double distance_m = 0.5 * extent.y + diagonal_m;
  AreaLight light;
  light.name = "above";
  light.centre = 0.5 * (bounds.lower + bounds.upper) + glm::dvec3(0, distance_m, 0);
  light.size = glm::vec3(static_cast<float>(0.25 * diagonal_m), 0.0f, static_cast<float>(0.25 * diagonal_m));
  light.intensity_w_sr = glm::vec3(static_cast<float>(3.14159265358979 * distance_m * distance_m));
  return light;
}

void light_by_default(DefaultLight light, Scene& scene) {
  if (light == DefaultLight::none && scene.lights.empty()) return;
  if (scene.lights.empty()) scene.lights.push_back(light_above(scene_bounds(scene)));
  // A fifth of full light in shadows and all around: shapes stay readable.
  scene.ambient = scene.environment = glm::vec3(0.2f);
}

// The outermost probes of a model alone stand half a spacing outside it: its surfaces are seen from there,
// where those of a room are seen from within.
void put_probes_around(Scene& scene) {
  if (scene.instances.empty()) return;
  Bounds box = scene_bounds(scene);
  for (int axis = 0; axis < 3; ++axis) {
    const int inner = scene.probes.counts[static_cast<std::size_t>(axis)] - 2;
    const double spacing = (box.upper[axis] - box.lower[axis]) / inner;
    box.lower[axis] -= spacing, box.upper[axis] += spacing;
  }
  scene.probes.box = box;
}

Scene load_bare_gltf(const std::filesystem::path& file, TexturePixels pixels, DefaultLight light) {
  Scene scene;
  scene.name = file.stem().string();
  GltfContent content = append_gltf(file, scene, {}, pixels);
  scene.instances = std::move(content.instances);
  if (!scene.instances.empty())
    scene.objects.push_back({scene.name, {}, 0, static_cast<std::uint32_t>(scene.instances.size()), true});
  scene.lights = std::move(content.lights);
  light_by_default(light, scene);
  put_probes_around(scene);
  return scene;
}

// A .vox file alone: a voxel is 0.1 m long, as in a scene document, and it is lit like a bare glTF.
Scene load_bare_vox(const std::filesystem::path& file, DefaultLight light) {
  Scene scene;
  scene.name = file.stem().string();
  scene.instances = append_vox(file, scene);
  const double size = kVoxSize_m;
  const glm::dmat4x3 metres{glm::dvec3{size, 0, 0}, glm::dvec3{0, size, 0}, glm::dvec3{0, 0, size},
                            glm::dvec3{0.0}};
  for (Instance& instance : scene.instances)
    instance.world_from_object = compose(metres, instance.world_from_object);
  light_by_default(light, scene);
  put_probes_around(scene);
  return scene;
}

std::string lower_case_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// What a document that has real surfaces and virtual lights alone means for the feed on them.
void warn_of_virtual_light_alone(const std::filesystem::path& file, Scene& scene) {
  const bool all = std::all_of(scene.lights.begin(), scene.lights.end(),
                               [](const AreaLight& light) { return light.is_virtual; });
  const bool catchers = std::any_of(scene.instances.begin(), scene.instances.end(),
                                    [](const Instance& instance) { return instance.catcher; });
  if (scene.lights.empty() || !all || !catchers) return;
  const bool dark = scene.ambient == glm::vec3(0.0f) && scene.environment == glm::vec3(0.0f) &&
                    scene.environment_map.rgba.empty();
  scene.warnings.push_back(printable(file.string()) + ": every light is virtual: " +
                           (dark ? "the document states no light of the real room, so that virtual light is "
                                   "added to the feed by the "
                                   "catchers' stated colours; state the room's lamps, or ambient"
                                 : "the feed counts as lit by ambient alone (with probes by environment); "
                                   "state the room's lamps, or "
                                   "all of their light as ambient"));
}

void warn_of_asset_roots_without_effect(const std::filesystem::path& file, Scene& scene) {
  scene.warnings.push_back(printable(file.string()) +
                           ": --asset-root has no effect on a model alone, whose files lie beside it; only "
                           "a scene document looks there");
}

// No vertex may lie so far out that the ray tracer's floats overflow.
void check_bounds(const Scene& scene, const std::filesystem::path& file) {
  const Bounds bounds = scene_bounds(scene);
  const double farthest = std::max(glm::length(bounds.lower), glm::length(bounds.upper));
  if (!(farthest <= kFarthest_m)) {
    throw InputError(file, 0, "reaches farther than 1e12 m", "check its units and scales");
  }
}

}  // namespace

bool is_scene_document(const std::filesystem::path& file) {
  return lower_case_extension(file) == ".json";
}

Scene load_scene(const std::filesystem::path& file, TexturePixels pixels, DefaultLight light,
                 std::span<const std::filesystem::path> asset_roots) {
  check_asset_roots(asset_roots);
  const std::string extension = lower_case_extension(file);
  Scene scene;
  if (extension == ".json") {
    scene = read_scene_document(file, pixels, asset_roots);
    warn_of_virtual_light_alone(file, scene);
  } else if (extension == ".gltf" || extension == ".glb") {
    scene = load_bare_gltf(file, pixels, light);
  } else if (extension == ".vox") {
    scene = load_bare_vox(file, light);
  } else {
    throw InputError(file, 0, "is not of a format that can be shown",
                     "name a .scene.json, .gltf, .glb or .vox file (convert other "
                     "models to .glb first)");
  }
  if (extension != ".json" && !asset_roots.empty()) warn_of_asset_roots_without_effect(file, scene);
  check_bounds(scene, file);
  complete_objects(scene);
  scene.changes = !scene.timeline.empty() || !scene.models.empty() ||
                  std::any_of(scene.objects.begin(), scene.objects.end(),
                              [](const PlacedObject& object) { return !object.path.empty(); });
  if (!scene.timeline.empty()) check_timeline(scene);
  return scene;
}

}  // namespace herr
