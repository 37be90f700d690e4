// Light adds up: light times k, the sum of lights, lights inside and on surfaces.
#include <algorithm>
#include <cmath>
#include <string>

#include "server/study/relations/light/counted_pictures.h"
#include "server/study/relations/light/plain_scene.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kBrightnesses[] = {4, 0.25, 10};
constexpr const char* kNoLight = "nothing shines: no light, ambient light, emission or environment";
constexpr const char* kNothingSeenLit = "nothing lit is seen";
constexpr std::size_t kMostParts = 4;

std::vector<LinearPicture> times(std::vector<LinearPicture> pictures, double factor) {
  for (LinearPicture& picture : pictures) {
    for (auto& plane : picture.plane) {
      for (float& value : plane) value = static_cast<float>(factor * double{value});
    }
  }
  return pictures;
}

bool shines(const RelationCase& subject) {
  const auto is_light = [](const AreaLight& light) { return light.intensity_w_sr != glm::vec3(0.0f); };
  const auto glows = [](const Material& material) { return material.emission != glm::vec3(0.0f); };
  const Scene& scene = subject.scene;
  return std::any_of(subject.state.lights.begin(), subject.state.lights.end(), is_light) ||
         std::any_of(scene.materials.begin(), scene.materials.end(), glows) ||
         scene.ambient != glm::vec3(0.0f) || scene.environment != glm::vec3(0.0f) ||
         !scene.environment_map.rgba.empty();
}

// `to` += factor * `from`.
void add_times(std::vector<LinearPicture>& to, double factor, const std::vector<LinearPicture>& from) {
  for (std::size_t v = 0; v < to.size(); ++v) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < to[v].pixels(); ++i) {
        to[v].plane[c][i] += static_cast<float>(factor * double{from[v].plane[c][i]});
      }
    }
  }
}

Relation brighter(const char* light, double k, bool probes) {
  Relation relation;
  relation.name = std::string(light) + " light times " + shortest_text(k);
  relation.holds = "all that shines times " + shortest_text(k) + " gives the picture times " +
                   shortest_text(k) + (probes ? ", probes included" : "");
  relation.bound = probes ? 0x1p-8 : 0x1p-9;
  relation.unit = "of a value, or of the smallest normal half float";
  relation.bound_from =
      "samples and pixels are half floats, each of which can be rounded one step of 2^-10 apart";
  if (probes) {
    relation.bound_from +=
        ", and probes keep 13 bits of their light, which 16 bounces can round 2^-13 apart each";
  }
  return relation;
}

// Probes that react forget faster beyond a threshold: a yes or no, which rounding may turn.
RelationCase steady(RelationCase subject) {
  subject.settings.probes.react = false;
  trace_few_probe_rays(subject.settings);
  return subject;
}

void measure_brighter(const char* light, const RelationCase& bright, bool probes, CountedPictures& counted,
                      RelationLog& log) {
  const std::vector<LinearPicture> once = counted.of(bright);
  const double largest = largest_value(once);
  for (const double k : kBrightnesses) {
    const Relation relation = brighter(light, k, probes);
    if (largest == 0) {
      log.not_applicable(relation, shines(bright) ? kNothingSeenLit : kNoLight);
      continue;
    }
    RelationCase brightened = bright;
    scale_light(brightened, static_cast<float>(k));
    const std::vector<LinearPicture> got = counted.of(brightened), wanted = times(once, k);
    const double floor = kSmallestNormalHalf * std::max(1.0, k) / (k * largest);
    const PictureDistance apart = largest_relative(got, wanted, floor, bright.profile);
    log.measured(relation, apart.error, apart.where,
                 worst_pictures(apart, got, wanted, "brighter light | picture times k | difference"));
  }
}

// Empty where catchers receive light over a camera feed.
std::string why_no_feed(const FramePlan& plan) {
  const std::string why = why_left_out(plan, "camera composite");
  return why.empty() ? why_left_out(plan, "catchers") : why;
}

// Largest |P4 - P2 - 2 (P2 - P1)| / (P4 + 3 P2 + 2 P1).
void measure_over_feed(const RelationCase& subject, RelationCase lit, CountedPictures& counted,
                       RelationLog& log) {
  Relation relation;
  relation.name = "hard light over the camera feed";
  relation.holds =
      "over a feed the picture is affine in the light's strength k: P(4) - P(2) = 2 (P(2) - P(1))";
  relation.bound = 0x1p-10;
  relation.unit = "of the pictures that are added";
  relation.bound_from =
      "sample and pixel of each picture are rounded to half floats, by 2^-11 of them at most";
  lit.camera = subject.camera;
  lit.settings.camera = subject.settings.camera;
  const std::string why = why_no_feed(plan_of(lit));
  if (!why.empty()) return log.not_applicable(relation, why);
  std::vector<LinearPicture> pictures[3];
  for (auto& picture : pictures) {
    picture = counted.of(lit);
    scale_light(lit, 2);
  }
  std::vector<LinearPicture> wanted = times(pictures[1], 3), all = wanted;
  add_times(wanted, -2, pictures[0]);
  add_times(all, 2, pictures[0]);
  add_times(all, 1, pictures[2]);
  const PictureDistance apart =
      largest_of_sum(pictures[2], wanted, all, 6 * kSmallestNormalHalf, lit.profile);
  log.measured(relation, apart.error, apart.where,
               worst_pictures(apart, pictures[2], wanted, "light times 4 | from times 1 and 2 | difference"));
}

// Those lights of which every `parts`-th from `part` on shines; none where there are not as many parts.
std::vector<AreaLight> only_part(std::vector<AreaLight> lights, std::size_t part, std::size_t parts) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (i % parts != part) lights[i].intensity_w_sr = glm::vec3(0.0f);
  }
  return lights;
}

// Beside itself, and shining from elsewhere if it is a sun.
AreaLight moved_copy(AreaLight light, double extent_m) {
  light.name += " again";
  light.centre += extent_m * glm::dvec3(0.11, 0.02, -0.07);
  if (light.kind == LightKind::sun)
    light.direction = {light.direction.z, light.direction.y, -light.direction.x};
  return light;
}

double extent_of(const Scene& scene) {
  const Bounds box = scene_bounds(scene);
  const glm::dvec3 size = box.upper - box.lower;
  const double extent_m = std::max({size.x, size.y, size.z, 0.0});
  return std::isfinite(extent_m) ? extent_m : 1;
}

// The scene's virtual lights, or a virtual copy of each light beside it.
void add_virtual_lights(RelationCase& lit) {
  const auto is_virtual = [](const AreaLight& light) { return light.is_virtual; };
  if (std::any_of(lit.state.lights.begin(), lit.state.lights.end(), is_virtual)) return;
  const double extent_m = extent_of(lit.scene);
  for (std::vector<AreaLight>* lights : {&lit.scene.lights, &lit.state.lights}) {
    const std::size_t real = lights->size();
    for (std::size_t i = 0; i < real; ++i) {
      lights->push_back(moved_copy((*lights)[i], extent_m));
      lights->back().is_virtual = true;
    }
  }
}

// Largest amount by which a value is lower with virtual lights than without, as a share of it.
void measure_virtual(const RelationCase& subject, RelationCase lit, CountedPictures& counted,
                     RelationLog& log) {
  Relation relation;
  relation.name = "virtual lights over the camera feed";
  relation.holds = "over a feed a virtual light brightens or changes nothing, in its shadow too";
  relation.bound = 0x1p-10;
  relation.unit = "of the value without it";
  relation.bound_from = "sample and pixel of both pictures are rounded to half floats";
  lit.camera = subject.camera;
  lit.settings.camera = subject.settings.camera;
  const std::string why = why_no_feed(plan_of(lit));
  if (!why.empty()) return log.not_applicable(relation, why);
  if (lit.state.lights.empty()) return log.not_applicable(relation, "the scene has no light");
  add_virtual_lights(lit);
  std::vector<LinearPicture> with = counted.of(lit);
  for (std::vector<AreaLight>* lights : {&lit.scene.lights, &lit.state.lights}) {
    for (AreaLight& light : *lights) {
      if (light.is_virtual) light.intensity_w_sr = glm::vec3(0.0f);
    }
  }
  const std::vector<LinearPicture> without = counted.of(lit);
  for (std::size_t v = 0; v < with.size(); ++v) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t i = 0; i < with[v].pixels(); ++i)
        with[v].plane[c][i] = std::min(with[v].plane[c][i], without[v].plane[c][i]);
    }
  }
  const PictureDistance apart = largest_of_sum(with, without, without, 2 * kSmallestNormalHalf, lit.profile);
  log.measured(relation, apart.error, apart.where,
               worst_pictures(apart, with, without, "darker with virtual lights | without | difference"));
}

void measure_sum(RelationCase lit, CountedPictures& counted, RelationLog& log) {
  Relation relation;
  relation.name = "sum of lights";
  relation.holds =
      "the picture of all lights is the sum of those of each alone, less what is there without lights, glass "
      "opaque";
  relation.bound = 0x1p-10;
  relation.unit = "of the pictures that are added";
  relation.bound_from =
      "sample and pixel of each picture are rounded to half floats, by 2^-11 of them at most";
  const std::string no_light = lit.state.lights.empty() ? why_left_out(plan_of(lit), "several lights") : "";
  if (!no_light.empty()) return log.not_applicable(relation, no_light);
  if (lit.state.lights.size() == 1) {
    const double extent_m = extent_of(lit.scene);
    for (std::vector<AreaLight>* lights : {&lit.scene.lights, &lit.state.lights})
      lights->push_back(moved_copy(lights->front(), extent_m));
  }
  // What catchers show of a background is a ratio of lights, not their sum; and which glints in glass are too
  // weak to be seen is asked of all lights together.
  take_catchers_away(lit.scene);
  lit.settings.refraction = false;
  const std::size_t parts = std::min(kMostParts, lit.state.lights.size());
  const auto renderer = renderer_of(lit);
  const std::vector<LinearPicture> got = counted.next(*renderer, lit);
  if (largest_value(got) == 0) return log.not_applicable(relation, "no light reaches what is seen");
  const auto with_lights = [&](const std::vector<AreaLight>& lights) {
    RelationCase moment;  // lights are part of the state alone, from frame to frame
    moment.state = lit.state, moment.state.lights = lights;
    moment.sample = lit.sample;
    moment.profile = lit.profile;
    return counted.next(*renderer, moment);
  };
  const std::vector<LinearPicture> none = with_lights(only_part(lit.state.lights, parts, parts));
  const double less = static_cast<double>(parts) - 1;
  std::vector<LinearPicture> wanted = times(none, -less), all = times(none, less);
  add_times(all, 1, got);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::vector<LinearPicture> alone = with_lights(only_part(lit.state.lights, part, parts));
    add_times(wanted, 1, alone);
    add_times(all, 1, alone);
  }
  const PictureDistance apart =
      largest_of_sum(got, wanted, all, 2 * static_cast<double>(parts) * kSmallestNormalHalf, lit.profile);
  log.measured(relation, apart.error, apart.where,
               worst_pictures(apart, got, wanted, "all lights | sum of each alone | difference"));
}

}  // namespace

void measure_light(const RelationCase& subject, RelationLog& log) {
  RelationCase lit = hard_light(subject);
  show_plainly(lit);
  moderate_light(lit);
  CountedPictures counted;
  measure_brighter("hard", lit, false, counted, log);
  measure_over_feed(subject, lit, counted, log);
  measure_virtual(subject, lit, counted, log);
  measure_sum(lit, counted, log);
  measure_brighter("all", steady(all_light(lit)), true, counted, log);
  log.measured(only_numbers("light gives numbers",
                            "all pictures of light times k and of lights one by one are finite"),
               counted.no_numbers());
  measure_light_near(subject, log);
}

}  // namespace herr
