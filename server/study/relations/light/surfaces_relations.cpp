// Materials at their limits: roughness 0, index of refraction 1 and 10, albedo 0 and 1.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "renderer/frame_plan.h"
#include "server/study/relations/light/counted_pictures.h"
#include "server/study/relations/light/plain_scene.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/study/report/figure_text.h"

namespace herr {
namespace {

constexpr float kGlow = 0.75f;
constexpr std::size_t kMostKeptBodies = 6;
constexpr const char* kNoSurface = "no surface to light";

bool has_surfaces(const RelationCase& subject) {
  return std::any_of(subject.scene.instances.begin(), subject.scene.instances.end(),
                     [](const Instance& instance) { return instance.present && !instance.catcher; });
}

// All surfaces polished, and highlights of full strength, under lights of `size` times their size.
RelationCase polished(const RelationCase& subject, float size) {
  RelationCase out = hard_light(subject);
  show_plainly(out);
  for (Material& material : out.scene.materials) {
    material.roughness = material.clearcoat.roughness = material.sheen.roughness = 0;
    material.specular = 1;
  }
  for (std::vector<AreaLight>* lights : {&out.scene.lights, &out.state.lights}) {
    for (AreaLight& light : *lights) light.size *= size;
  }
  return out;
}

void measure_polished(const RelationCase& subject, RelationLog& log) {
  const Relation numbers =
      only_numbers("roughness 0 under a small light",
                   "polished surfaces under lights of 1e-3 of their size give finite values");
  Relation limit;
  limit.name = "roughness 0 under a light of no size";
  limit.holds = "polished surfaces show lights of 1e-5 of their size as they show those of 1e-4";
  limit.bound = 1e-3;
  limit.unit = "share of pixels beyond one 8-bit step";
  limit.bound_from =
      "highlights are spread to what a ray stands for, 1e-3 (radians) at least, beside which such lights are "
      "points: only surfaces nearer to a light than its size can change";
  const std::string why = !has_surfaces(subject)         ? kNoSurface
                          : subject.state.lights.empty() ? why_left_out(plan_of(subject), "several lights")
                                                         : "";
  if (!why.empty()) {
    log.not_applicable(numbers, why);
    log.not_applicable(limit, why);
    return;
  }
  CountedPictures counted;
  counted.of(polished(subject, 1e-3f));
  log.measured(numbers, counted.no_numbers());
  const std::vector<LinearPicture> got = picture_of(polished(subject, 1e-5f)),
                                   wanted = picture_of(polished(subject, 1e-4f));
  const PictureDistance apart = share_beyond_one_step(got, wanted, subject.profile);
  log.measured(limit, apart.error, apart.where,
               worst_pictures(apart, got, wanted, "lights of 1e-5 | of 1e-4 of their size | difference"));
}

// Transparent materials become clear glass of one index, all others matte, under constant light and what
// shines by itself: no light that glass casts a shadow of. What lies outside is shown, as glass shows it.
RelationCase glass_case(const RelationCase& subject, float index) {
  RelationCase glass = hard_light(subject);
  show_plainly(glass);
  glass.settings.camera = true;  // without a feed
  Scene& scene = glass.scene;
  std::vector<Material> before = scene.materials;
  make_matte(scene);
  take_catchers_away(scene);
  switch_lights_off(glass);
  scene.ambient = glm::vec3(0.25f);
  for (Material& material : scene.materials) {
    material.double_sided = true;
    // Eyes see blended surfaces by their alpha, rays through glass whole or not at all.
    if (material.alpha_mode == AlphaMode::blend) material.alpha_mode = AlphaMode::opaque;
  }
  for (std::size_t m = 0; m < before.size(); ++m) {
    if (!(before[m].transmission > 0)) continue;
    Material clear;
    clear.name = before[m].name;
    clear.base_colour = glm::vec3(1.0f);
    clear.roughness = 0;
    clear.transmission = 1;
    clear.refractive_index = index;
    scene.materials[m] = clear;
  }
  for (const Instance& instance : scene.instances) {
    const bool is_clear = scene.materials[instance.material].transmission > 0;
    if (is_clear && instance.kind == ShapeKind::mesh) scene.meshes[instance.mesh].colours.clear();
  }
  return glass;
}

double smallest_value(const std::vector<LinearPicture>& pictures) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const LinearPicture& picture : pictures) {
    for (const auto& plane : picture.plane) {
      for (const float value : plane) smallest = std::min(smallest, double{value});
    }
  }
  return smallest;
}

std::string no_glass(const RelationCase& glass) {
  return why_left_out(plan_of(glass), "refraction");
}

// Present instances that are clear, those nearest to the line of the left eye's gaze first.
std::vector<std::size_t> clear_bodies(const RelationCase& glass) {
  const Pose world_from_eye =
      glass.scene.world_from_session * glass.sample.head.world_from_head * glass.sample.head_from_eye[0];
  const glm::dvec3 gaze =
      glass.scene.world_from_session.orientation *
      (glass.sample.head.world_from_head.orientation * glass.sample.gaze.head_direction[0]);
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t i = 0; i < glass.scene.instances.size(); ++i) {
    const Instance& instance = glass.scene.instances[i];
    if (!instance.present || !(glass.scene.materials[instance.material].transmission > 0)) continue;
    const Bounds box = instance_bounds(glass.scene, instance);
    const glm::dvec3 way = 0.5 * (box.lower + box.upper) - world_from_eye.position;
    found.emplace_back(-glm::dot(gaze, way) / std::max(glm::length(way), 1e-300), i);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::size_t> bodies;
  for (const auto& [angle, instance] : found) bodies.push_back(instance);
  return bodies;
}

void take_away(RelationCase& subject, std::span<const std::size_t> instances) {
  for (const std::size_t instance : instances) subject.scene.instances[instance].present = false;
}

// Fewer and fewer clear bodies, until no path through them ends at a limit. The number that stays, and their
// picture.
std::size_t keep_what_paths_follow(RelationCase& glass, std::vector<LinearPicture>& picture) {
  const std::vector<std::size_t> bodies = clear_bodies(glass);
  for (std::size_t kept = bodies.size(); kept > 0; kept = std::min(kept / 2, kMostKeptBodies)) {
    take_away(glass, std::span(bodies).subspan(kept));
    CountedPictures counted;
    picture = counted.of(glass);
    if (counted.cut_paths() == 0) return kept;
  }
  return 0;
}

void measure_index_of_one(const RelationCase& subject, RelationLog& log) {
  Relation relation;
  relation.name = "index of refraction 1";
  relation.holds = "clear glass of index 1 cannot be seen: the picture is that without it";
  relation.bound = 2e-3;
  relation.unit = "share of pixels beyond one 8-bit step";
  relation.bound_from =
      "behind a surface rays start 2^-16 of their way aside: only those that pass an edge as closely change; "
      "bodies are taken away where paths would end at a limit";
  RelationCase glass = glass_case(subject, 1);
  const std::string why = no_glass(glass);
  if (!why.empty()) return log.not_applicable(relation, why);
  const std::vector<std::size_t> bodies = clear_bodies(glass);
  RelationCase without = glass;
  take_away(without, bodies);
  std::vector<LinearPicture> got;
  const std::size_t kept = keep_what_paths_follow(glass, got);
  if (kept == 0) {
    return log.not_applicable(relation, bodies.empty() ? "no transparent surface is present"
                                                       : "paths through glass end at a limit of " +
                                                             std::to_string(kMostInterfaces) + " surfaces");
  }
  const std::vector<LinearPicture> wanted = picture_of(without);
  const PictureDistance apart = share_beyond_one_step(got, wanted, subject.profile);
  std::string where = apart.where;
  if (kept < bodies.size()) {
    where = std::to_string(kept) + " of " + std::to_string(bodies.size()) +
            " clear bodies, for no more than " + std::to_string(kMostInterfaces) + " surfaces on a path" +
            (where.empty() ? "" : "; " + where);
  }
  log.measured(relation, apart.error, where,
               worst_pictures(apart, got, wanted, "glass of index 1 | without it | difference"));
}

// The most radiance that anything sends out under constant light.
double brightest_source(const Scene& scene) {
  double environment = 0, emission = 0;
  for (int c = 0; c < 3; ++c) environment = std::max(environment, double{scene.environment[c]});
  if (!scene.environment_map.rgba.empty()) environment = 0;
  for (std::size_t i = 0; i < scene.environment_map.rgba.size(); ++i) {
    if (i % 4 < 3) environment = std::max(environment, double{scene.environment_map.rgba[i]});
  }
  for (const Material& material : scene.materials) {
    for (int c = 0; c < 3; ++c) emission = std::max(emission, double{material.emission[c]});
  }
  return std::max(environment, emission + double{scene.ambient.x});
}

void measure_index_of_ten(const RelationCase& subject, RelationLog& log) {
  Relation relation;
  relation.name = "index of refraction 10";
  relation.holds = "glass of index 10 is finite, and no brighter than the brightest thing that it can show";
  relation.bound = 0x1p-9;
  relation.unit = "of the brightest source, beyond it";
  relation.bound_from =
      "reflected and refracted shares sum to 1, so glass shows a mean; sample and pixel are rounded to half "
      "floats";
  RelationCase glass = glass_case(subject, 10);
  const std::string why = no_glass(glass);
  if (!why.empty()) return log.not_applicable(relation, why);
  CountedPictures counted;
  const std::vector<LinearPicture> picture = counted.of(glass);
  const double no_numbers = counted.no_numbers();
  const double share = largest_value(picture) / brightest_source(glass.scene);
  log.measured(relation, no_numbers > 0 ? std::nan("") : std::max(0.0, share - 1),
               no_numbers > 0 ? "values that are no numbers" : figure(share) + " of the brightest source");
}

// Surfaces of one albedo that nothing but light from outside reaches.
RelationCase painted(RelationCase subject, float albedo) {
  show_plainly(subject);
  paint_all(subject.scene, albedo);
  stop_emission(subject.scene);
  take_catchers_away(subject.scene);
  return subject;
}

void measure_black(const RelationCase& subject, RelationLog& log) {
  Relation relation;
  relation.name = "albedo 0";
  relation.holds = "black matte surfaces are black under all light, probes included, and so is a black sky";
  relation.unit = "of white";
  relation.bound_from = "each light is multiplied by an albedo of 0";
  if (!has_surfaces(subject)) return log.not_applicable(relation, kNoSurface);
  RelationCase black = painted(all_light(subject), 0);
  make_environment_black(black.scene);
  black.scene.ambient = glm::vec3(1.0f);
  trace_few_probe_rays(black.settings);
  CountedPictures counted;
  const std::vector<LinearPicture> picture = counted.of(black);
  const double no_numbers = counted.no_numbers();
  log.measured(relation, no_numbers > 0 ? std::nan("") : largest_value(picture));
}

void measure_twice_as_white(const RelationCase& subject, RelationLog& log) {
  Relation relation;
  relation.name = "albedo 1 is twice 1/2";
  relation.holds = "without probes matte surfaces of albedo 1 send back twice what those of 1/2 do";
  relation.bound = 0x1p-9;
  relation.unit = "of a value, or of the smallest normal half float";
  relation.bound_from =
      "a factor of 2 is exact but for the smallest half floats, which can round samples and pixels 2^-10 "
      "apart";
  RelationCase white = painted(hard_light(subject), 1);
  make_environment_black(white.scene);
  const double largest = has_surfaces(subject) ? moderate_light(white) : 0;
  if (largest == 0) {
    return log.not_applicable(relation, has_surfaces(subject) ? "no light reaches what is seen" : kNoSurface);
  }
  RelationCase grey = white;
  for (Material& material : grey.scene.materials) material.base_colour *= 0.5f;
  const std::vector<LinearPicture> got = picture_of(white);
  std::vector<LinearPicture> wanted = picture_of(grey);
  for (LinearPicture& picture : wanted) {
    for (auto& plane : picture.plane) {
      for (float& value : plane) value *= 2;
    }
  }
  const PictureDistance apart =
      largest_relative(got, wanted, 2 * kSmallestNormalHalf / largest, subject.profile);
  log.measured(relation, apart.error, apart.where,
               worst_pictures(apart, got, wanted, "albedo 1 | twice albedo 1/2 | difference"));
}

void measure_furnace(const RelationCase& subject, RelationLog& log) {
  Relation relation;
  relation.name = "furnace";
  relation.holds =
      "matte surfaces of albedo 1/4 that send out 3/4, with probes and white light from outside: nothing is "
      "brighter than white, nor darker than what it sends out";
  relation.bound = 0x1p-7;
  relation.unit = "of white, beyond what may be";
  relation.bound_from =
      "3/4 + 1/4 of white is white, and look-ups are means of what was gathered; each of 64 updates rounds "
      "it "
      "up by 2^-14 at most";
  if (!has_surfaces(subject)) return log.not_applicable(relation, kNoSurface);
  RelationCase furnace = painted(all_light(subject), 1 - kGlow);
  switch_lights_off(furnace);
  for (Material& material : furnace.scene.materials) material.emission = glm::vec3(kGlow);
  make_environment_black(furnace.scene);
  furnace.scene.environment = glm::vec3(1.0f);
  furnace.scene.ambient = glm::vec3(0.0f);
  furnace.settings.occlusion_rays = 0;
  furnace.settings.camera = true;  // without a feed: what lies outside is shown
  trace_few_probe_rays(furnace.settings);
  CountedPictures counted;
  const std::vector<LinearPicture> picture = counted.of(furnace);
  const double no_numbers = counted.no_numbers();
  const double darkest = smallest_value(picture), brightest = largest_value(picture);
  log.measured(relation,
               no_numbers > 0 ? std::nan("") : std::max({0.0, brightest - 1, double{kGlow} - darkest}),
               "from " + figure(darkest) + " to " + figure(brightest));
}

}  // namespace

void measure_surfaces(const RelationCase& subject, RelationLog& log) {
  measure_polished(subject, log);
  measure_index_of_one(subject, log);
  measure_index_of_ten(subject, log);
  measure_black(subject, log);
  measure_twice_as_white(subject, log);
  measure_furnace(subject, log);
}

}  // namespace herr
