#include "renderer/frame_plan.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "renderer/detail/detail_levels.h"
#include "renderer/geometry/shading_scene.h"
#include "renderer/geometry/surface_details.h"
#include "renderer/probes/probe_grid.h"
#include "renderer/settings_list.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

struct Traits {
  std::size_t catchers_ever = 0, instances = 0, catchers = 0, reflecting = 0, reflecting_catchers = 0,
              transparent = 0, textured = 0, specular = 0, shapes = 0, voxels = 0, detailed = 0, masked = 0,
              blended = 0, back_face_culling = 0, further_lobes = 0, glowing = 0, smooth = 0,
              by_roughness_ever = 0;
  bool catchers_may_occlude = false;
};

constexpr double kFlatShare = 1e-5;  // of a mesh's extent

bool lies_flat(const TriangleMesh& mesh) {
  // All corners in one plane: such a catcher cannot shadow itself.
  if (mesh.triangles.empty()) return true;
  const auto& t = mesh.triangles.front();
  const glm::dvec3 origin(mesh.positions[t[0]]);
  const glm::dvec3 normal =
      glm::cross(glm::dvec3(mesh.positions[t[1]]) - origin, glm::dvec3(mesh.positions[t[2]]) - origin);
  double farthest = 0, highest = 0;
  for (const glm::vec3& p : mesh.positions) {
    farthest = std::max(farthest, glm::distance(glm::dvec3(p), origin));
    highest = std::max(highest, std::abs(glm::dot(normal, glm::dvec3(p) - origin)));
  }
  return highest <= kFlatShare * glm::length(normal) * farthest;
}

bool glows(const Scene& scene, const Instance& instance) {
  return instance.present && !instance.catcher &&
         scene.materials[instance.material].emission != glm::vec3{0.0f};
}

Traits traits_of(const Scene& scene) {
  Traits traits;
  for (const Instance& instance : scene.instances) {
    if (instance.catcher) ++traits.catchers_ever;
    const Material& material = scene.materials[instance.material];
    const bool by_roughness = !material.mirror && !material.unlit && material.transmission <= 0;
    traits.by_roughness_ever += by_roughness && !instance.catcher ? 1 : 0;
    if (!instance.present) continue;
    ++traits.instances;
    traits.smooth += by_roughness && may_mirror(material) ? 1 : 0;
    traits.glowing += glows(scene, instance) ? 1 : 0;
    if (instance.kind == ShapeKind::voxels) ++traits.voxels;
    const bool is_mesh = instance.kind == ShapeKind::mesh;
    if (instance.kind == ShapeKind::sphere || instance.kind == ShapeKind::box) ++traits.shapes;
    traits.detailed += has_details(scene, instance) ? 1 : 0;
    traits.further_lobes += has_further_lobes(material) ? 1 : 0;
    traits.blended += blends(scene, instance) ? 1 : 0;
    traits.masked += has_holes(scene, instance) && !blends(scene, instance) ? 1 : 0;
    traits.back_face_culling += culls_back_faces(scene, instance) ? 1 : 0;
    traits.textured += has_textures(scene, instance) ? 1 : 0;
    if (instance.catcher) {
      ++traits.catchers;
      if (may_mirror(material)) ++traits.reflecting_catchers;
      traits.catchers_may_occlude |=
          traits.catchers > 1 || !is_mesh || !lies_flat(scene.meshes[instance.mesh]);
      continue;
    }
    ++traits.specular;  // glTF's metallic-roughness surfaces all have a specular lobe
    if (may_mirror(material)) ++traits.reflecting;
    if (material.transmission > 0) ++traits.transparent;
  }
  return traits;
}

bool is_grey(const glm::vec3& colour) {
  return colour.x == colour.y && colour.y == colour.z;
}

// Then all channels of a catcher's ratio are the same number. Under coloured light of one hue they would be
// the same but for rounding, and a plan changes no bit.
bool all_light_is_grey(const Scene& scene) {
  return is_grey(scene.ambient) &&
         std::all_of(scene.lights.begin(), scene.lights.end(),
                     [](const AreaLight& light) { return is_grey(light.intensity_w_sr); });
}

bool forces(const RenderSettings& settings, const char* name) {
  return std::find(settings.force.begin(), settings.force.end(), name) != settings.force.end();
}

void check_forced(const RenderSettings& settings, const FramePlan& plan) {
  for (const std::string& name : settings.force) {
    const auto named = [&](const PlanEntry& entry) { return entry.name == name; };
    if (std::any_of(plan.entries.begin(), plan.entries.end(), named)) continue;
    throw std::invalid_argument("the frame plan has no entry '" + name + "'");
  }
}

std::string share(std::size_t count, std::size_t all, const char* what) {
  return std::to_string(count) + " of " + std::to_string(all) + " instances " + what;
}

}  // namespace

static_assert(kMostAdaptiveSamples == kMostOrderedSamples, "what settings promise is what is traced");

LightSampling FramePlan::light_sampling(int samples) const {
  const bool adaptive =
      adaptive_min_samples > 0 && adaptive_min_samples < samples && samples <= kMostOrderedSamples;
  return {samples, adaptive ? adaptive_min_samples : samples, light_sampler == LightSampler::jittered};
}

FramePlan plan_frame(const Scene& scene, const RenderSettings& settings, bool session_has_camera) {
  const Traits t = traits_of(scene);
  FramePlan plan;
  const auto decide = [&](bool& feature, bool runs, const char* name, const std::string& why,
                          const std::string& why_not, bool unneeded = false) {
    const bool forced = unneeded && forces(settings, name);
    feature = runs || forced;
    plan.entries.push_back({name, feature,
                            runs     ? why
                            : forced ? why_not + ", but it is forced"
                                     : why_not,
                            unneeded});
  };
  const auto need = [&](bool& feature, const char* name, const char* user) {
    if (feature) return;
    feature = true;
    for (PlanEntry& entry : plan.entries) {
      if (entry.name == name) entry = {name, true, entry.reason + ", but " + user + " need it", true};
    }
  };
  decide(plan.polar, settings.foveation == Foveation::log_polar, "log-polar rays", "foveation is on",
         settings.scale < 1 ? "foveation is off: rays on a grid of each viewport, pixels between them"
                            : "foveation is off: one ray per viewport pixel");
  decide(plan.textures, t.textured > 0, "textures", share(t.textured, t.instances, "have textures"),
         "no instance has a texture", t.textured == 0);
  decide(plan.voxels, t.voxels > 0, "voxels", share(t.voxels, t.instances, "are grids of voxels"),
         "no instance is a grid of voxels", t.voxels == 0);
  decide(plan.shapes, t.shapes > 0, "analytic shapes", share(t.shapes, t.instances, "are spheres or boxes"),
         "no instance is a sphere or box");
  decide(plan.surface_details, t.detailed > 0, "surface details",
         share(t.detailed, t.instances,
               "have vertex colours, further textures, weighted highlights, alpha or are unlit"),
         "every surface is made of factors and at most two textures", t.detailed == 0);
  decide(plan.further_lobes, t.further_lobes > 0, "further lobes",
         share(t.further_lobes, t.instances, "have a clear coat, sheen or a stretched highlight"),
         "no surface has a clear coat, sheen or a stretched highlight", t.further_lobes == 0);
  if (plan.further_lobes) need(plan.surface_details, "surface details", "further lobes");
  decide(plan.alpha_mask, t.masked > 0, "alpha masks", share(t.masked, t.instances, "have holes"),
         "no surface has holes", t.masked == 0);
  decide(plan.alpha_blend, t.blended > 0, "alpha layers",
         share(t.blended, t.instances, "blend; eyes look through at most ") + std::to_string(kMostLayers),
         "no surface blends", t.blended == 0 && settings.adaptive_min_samples == 0);
  if (plan.alpha_blend) need(plan.surface_details, "surface details", "alpha layers");
  decide(plan.back_face_culling, t.back_face_culling > 0, "back faces left out",
         share(t.back_face_culling, t.instances, "are single-sided"),
         "every surface is double-sided or lets light pass", t.back_face_culling == 0);
  decide(plan.specular, t.specular > 0, "specular lobe",
         share(t.specular, t.instances, "have a specular lobe"), "catchers only: nothing has a highlight",
         t.specular == 0);
  bool several_lights = false;
  decide(several_lights, scene.lights.size() > 1, "several lights",
         std::to_string(scene.lights.size()) + " lights", scene.lights.empty() ? "no light" : "one light");
  bool many = false, adaptive = false;
  decide(many, settings.light_samples > 1, "light samples",
         std::to_string(settings.light_samples) + (settings.light_sampler == LightSampler::jittered
                                                       ? " jittered strata per light"
                                                       : " independent places per light"),
         "one sample: the light's centre");
  plan.light_sampler = settings.light_sampler;
  // Where surfaces blend, a sample may be seen in part, so that no block would agree; places anywhere on the
  // light are no strata that hits could take in turn.
  plan.adaptive_min_samples =
      plan.alpha_blend || settings.light_sampler == LightSampler::random ? 0 : settings.adaptive_min_samples;
  decide(adaptive, plan.light_sampling(settings.light_samples).adaptive(), "adaptive light samples",
         std::to_string(settings.adaptive_min_samples) + " strata first, more where they disagree",
         settings.adaptive_min_samples > 0 && settings.light_samples > kMostOrderedSamples
             ? "more than " + std::to_string(kMostOrderedSamples) + " samples are all traced"
         : many && plan.alpha_blend ? "blended surfaces let shares of the light pass"
         : many                     ? "all strata for every hit"
                                    : "one sample");
  bool edges = false;
  decide(edges, settings.edge_samples > 0 && plan.polar, "edge samples",
         std::to_string(settings.edge_samples) + " further rays through each sample at an edge",
         settings.edge_samples == 0 ? "not asked for" : "foveation is off");
  plan.edge_samples = edges ? settings.edge_samples : 0;
  const bool has_ambient =
      scene.ambient != glm::vec3{0.0f} || (settings.probes.on && !scene.instances.empty());
  decide(plan.occlusion, settings.occlusion_rays > 0 && has_ambient, "ambient occlusion",
         std::to_string(settings.occlusion_rays) + " short rays per hit",
         settings.occlusion_rays == 0 ? "not asked for" : "no indirect light to occlude");
  const std::size_t mirrors = t.reflecting + t.reflecting_catchers;
  decide(plan.mirror_rays, settings.reflections && mirrors > 0, "mirror rays",
         share(mirrors, t.instances, "reflect"),
         mirrors == 0 ? "no material reflects" : "switched off by settings", mirrors == 0);
  decide(plan.catcher_mirrors, plan.mirror_rays && t.reflecting_catchers > 0, "mirror rays of catchers",
         share(t.reflecting_catchers, t.instances, "are catchers that reflect"),
         t.reflecting_catchers == 0 ? "no catcher reflects" : "switched off by settings",
         t.reflecting_catchers == 0 && (settings.reflections || mirrors == 0));
  if (plan.catcher_mirrors) need(plan.mirror_rays, "mirror rays", "mirror rays of catchers");
  decide(plan.refraction, settings.refraction && t.transparent > 0, "refraction",
         share(t.transparent, t.instances, "are transparent"),
         t.transparent == 0 ? "no material is transparent" : "switched off by settings", t.transparent == 0);
  decide(plan.environment_map, !scene.environment_map.rgba.empty(), "environment picture",
         std::to_string(scene.environment_map.width_px) + "x" +
             std::to_string(scene.environment_map.height_px) + " pixels around the scene",
         "the environment has one colour");
  // Those that may come count, too: it takes long to make.
  decide(plan.filtered_environment, plan.environment_map && t.by_roughness_ever > 0, "filtered environment",
         settings.probes.on ? "highlights show the picture as their lobe blurs it, where probes know of it"
                            : "highlights show the picture as their lobe blurs it; probes are off: nothing "
                              "hides it from rough surfaces but short rays",
         plan.environment_map ? "no surface reflects by its roughness" : "the environment has one colour");
  const bool by_lobe = plan.filtered_environment || (plan.mirror_rays && t.smooth > 0);
  decide(plan.gloss, by_lobe, "gloss by roughness",
         plan.filtered_environment
             ? "highlights have their lobe's share of the environment"
             : share(t.smooth, t.instances, "are smooth: the roughness of each place counts"),
         "rough surfaces, and those that say how much they mirror, need none", !by_lobe);
  decide(plan.catchers, t.catchers > 0, "catchers", share(t.catchers, t.instances, "are catchers"),
         "the scene has no catcher", t.catchers == 0);
  decide(plan.catchers_occlude, t.catchers_may_occlude, "catcher shadow rays",
         "catchers can shadow one another",
         t.catchers > 0 ? "one flat catcher cannot shadow itself" : "no catcher", !t.catchers_may_occlude);
  const std::size_t detailed = detailed_instances(scene);
  decide(plan.detail_levels, detailed > 0, "detail levels",
         share(detailed, t.instances, "have coarser forms of their mesh"), "no mesh has coarser forms");
  const std::array<int, 3> n = probe_counts_at(scene.probes.counts, settings.probes.density);
  decide(plan.probes, settings.probes.on && !scene.instances.empty(), "probes",
         std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]) + ", " +
             std::to_string(settings.probes.rays) + " rays each",
         scene.instances.empty() ? "no surface to light" : "switched off by settings");
  bool ambient = false;
  decide(ambient, scene.ambient != glm::vec3{0.0f} && !plan.probes, "constant ambient light",
         "the same from all sides", plan.probes ? "probes gather light in its place" : "the scene has none");
  decide(plan.catcher_probes, plan.probes && t.catchers_ever > 0, "probes of catchers alone",
         "indirect light changes the feed on catchers",
         t.catchers_ever > 0 ? "probes are off" : "no catcher");
  bool glow = false;
  decide(glow, plan.probes && t.glowing > 0, "light of glowing objects",
         share(t.glowing, t.instances, "glow; probes carry their light"),
         t.glowing > 0 ? share(t.glowing, t.instances, "glow; without probes their light reaches nothing")
                       : "nothing glows");
  const auto virtual_lights = std::count_if(scene.lights.begin(), scene.lights.end(),
                                            [](const AreaLight& l) { return l.is_virtual; });
  const std::string of_lights = std::to_string(virtual_lights) + " of " +
                                std::to_string(scene.lights.size()) +
                                (virtual_lights == 1 ? " lights is virtual" : " lights are virtual");
  decide(plan.virtual_lights, t.catchers > 0 && virtual_lights > 0, "virtual lights on the feed", of_lights,
         virtual_lights > 0 ? of_lights + ", and no catcher receives them" : "no light is virtual");
  const bool coloured = plan.catcher_probes || !all_light_is_grey(scene);
  decide(plan.coloured_ratio, t.catchers > 0 && coloured, kColouredRatio,
         plan.catcher_probes ? "surfaces colour the light between them" : "some light is coloured",
         t.catchers > 0 ? "all light is white or grey" : "no catcher", t.catchers == 0 || !coloured);
  const bool painted = settings.see_through_colour.has_value();
  decide(plan.camera, settings.camera && session_has_camera && !painted, "camera composite",
         "the session has a camera feed",
         !session_has_camera ? "the session has no camera feed"
         : painted           ? "one colour is painted in its place"
                             : "switched off by settings");
  // Catchers mirror virtual objects alone.
  const bool shows = (plan.mirror_rays && t.reflecting > 0) || plan.refraction;
  decide(plan.mirrored_feed, plan.camera && shows, kMirroredFeed,
         "inside the camera's view; beyond it the environment, or a catcher's colour",
         shows ? "no camera feed is shown: they show the environment"
               : "no object reflects, and none is transparent",
         !plan.camera || !shows);
  decide(plan.gaze_marker, settings.gaze_marker, "gaze marker", "asked for", "not asked for");
  decide(plan.density_overlay, settings.density_overlay, "density overlay", "asked for", "not asked for");
  check_forced(settings, plan);
  return plan;
}

std::vector<std::string> left_out(const FramePlan& plan) {
  std::vector<std::string> names;
  for (const PlanEntry& entry : plan.entries) {
    if (entry.unneeded && !entry.runs) names.push_back(entry.name);
  }
  return names;
}

std::string glow_without_light(const Scene& scene, const FramePlan& plan) {
  constexpr std::size_t kNamed = 5;
  if (plan.probes || !plan.catchers) return {};
  std::vector<std::string> names;
  for (const Instance& instance : scene.instances) {
    if (!glows(scene, instance)) continue;
    const std::string object = instance.name.substr(0, instance.name.find('/'));
    if (std::find(names.begin(), names.end(), object) == names.end()) names.push_back(object);
  }
  if (names.empty()) return {};
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i)
    text += (i == 0 ? "\"" : ", \"") + printable(names[i]) + "\"";
  if (names.size() > kNamed) text += " and " + std::to_string(names.size() - kNamed) + " more";
  return text + (names.size() == 1 ? " glows" : " glow") +
         (names.size() == 1 ? ", but lights" : ", but light") +
         " neither the camera feed nor other objects: probes are off";
}

std::vector<PlanEntry> differing_entries(const FramePlan& before, const FramePlan& after) {
  std::vector<PlanEntry> changed;
  for (std::size_t i = 0; i < std::min(before.entries.size(), after.entries.size()); ++i) {
    if (before.entries[i].runs != after.entries[i].runs) changed.push_back(after.entries[i]);
  }
  return changed;
}

}  // namespace herr
