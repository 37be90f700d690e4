#include "server/frames/warnings/picture_warnings.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>

#include "server/frames/warnings/lamp_warnings.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"
#include "sessions/text/fixed_text.h"

namespace herr {
namespace {

std::string no_lights(const Scene& scene, const FramePlan& plan) {
  if (!scene.lights.empty()) return {};
  const glm::vec3 dark(0.0f);
  const bool surrounded = scene.environment != dark || !scene.environment_map.rgba.empty();
  const bool ambient = scene.ambient != dark;
  if (plan.probes)
    return std::string("no lights, and probes take the place of ambient: ") +
           (surrounded ? "only emission and environment light it" : "pictures are black but for emission") +
           "; add a light" + (ambient ? ", or give --no-probes" : "");
  if (ambient) return "no lights: only ambient and emission light it; add a light";
  return std::string("no lights and no ambient: pictures are black but for emission") +
         (surrounded ? " and the environment behind" : "") + "; add a light";
}

std::string catchers_without_feed(const Scene& scene, const FramePlan& plan, const RenderSettings& settings) {
  // Without the feed on purpose, their shadows are in the pictures' alpha.
  if (plan.camera || !settings.camera || settings.see_through_colour) return {};
  const auto catchers =
      std::count_if(scene.instances.begin(), scene.instances.end(),
                    [](const Instance& instance) { return instance.catcher && instance.present; });
  if (catchers == 0) return {};
  return counted(catchers, "catcher", "catchers") +
         " and no camera feed: catchers are not drawn; use \"shapes\" for surfaces that shall be seen";
}

std::string vector_text(const glm::dvec3& v) {
  return "(" + fixed_text(v.x, 2) + ", " + fixed_text(v.y, 2) + ", " + fixed_text(v.z, 2) + ")";
}

// Between `forward` and the nearest of the corners and the middle of a box.
double angle_to(const Bounds& box, const glm::dvec3& from, const glm::dvec3& forward) {
  double largest_cosine = -1;
  const auto see = [&](const glm::dvec3& point) {
    const glm::dvec3 way = point - from;
    const double distance = glm::length(way);
    if (distance > 0) largest_cosine = std::max(largest_cosine, glm::dot(way, forward) / distance);
  };
  see(0.5 * (box.lower + box.upper));
  for (int corner = 0; corner < 8; ++corner) {
    see({(corner & 1) != 0 ? box.upper.x : box.lower.x, (corner & 2) != 0 ? box.upper.y : box.lower.y,
         (corner & 4) != 0 ? box.upper.z : box.lower.z});
  }
  return glm::degrees(std::acos(std::min(1.0, largest_cosine)));
}

constexpr double kAhead_deg = 45;  // nearer is in view of most displays, were it larger

double across(const Bounds& box) {
  const glm::dvec3 sides = box.upper - box.lower;
  return std::max({sides.x, sides.y, sides.z});
}

double distance_to_middle(const Bounds& box, const glm::dvec3& place) {
  return glm::length(0.5 * (box.lower + box.upper) - place);
}

bool is_around(const Bounds& box, const glm::dvec3& p) {
  return glm::all(glm::greaterThanEqual(p, box.lower)) && glm::all(glm::lessThanEqual(p, box.upper));
}

// "0.5 mm", "12 cm", "1.7 m", "300 m".
std::string length_text(double m) {
  if (m <= 0) return "0 mm";
  if (m < 0.01)
    return fixed_text(m * 1e3, std::clamp(static_cast<int>(std::ceil(-std::log10(m * 1e3))), 1, 12)) + " mm";
  if (m < 1) return fixed_text(m * 100, 0) + " cm";
  return fixed_text(m, m < 10 ? 1 : 0) + " m";
}

// How wide something of that size looks, in pixels of the finest viewport at its forward axis.
double pixels_across(const Bounds& box, const glm::dvec3& place, const DisplayProfile& profile) {
  double pixels_per_tangent = 0;
  for (const Viewport& viewport : profile.viewports)
    pixels_per_tangent =
        std::max(pixels_per_tangent, viewport.width_px / (viewport.tan_right - viewport.tan_left));
  return across(box) / std::max(distance_to_middle(box, place), 1e-9) * pixels_per_tangent;
}

std::string tiny_words(const Bounds& box, const glm::dvec3& place, double pixels) {
  return "is " + length_text(across(box)) + " across, " + length_text(distance_to_middle(box, place)) +
         " away: " +
         (pixels < 1 ? std::string("smaller than a pixel")
                     : "about " + fixed_text(pixels, 0) + " pixels wide") +
         "; is the model in another unit than metres? give a \"scale\", such as 1000";
}

std::string around_words(const std::string& name, const Bounds& box) {
  return "the head stands inside" + (name.empty() ? " an object" : " \"" + printable(name) + "\"") + " (" +
         length_text(across(box)) + " across)" +
         (across(box) >= kHuge_m ? "; is the model in millimetres? give a \"scale\", such as 0.001" : "");
}

// Boxes of what is there and no catcher, by entries of the scene document.
std::map<std::string, Bounds> boxes_of_objects(const Scene& scene) {
  std::map<std::string, Bounds> boxes;
  for (const Instance& instance : scene.instances) {
    if (instance.catcher || !instance.present) continue;
    const Bounds part = instance_bounds(scene, instance);
    const auto [at, is_first] = boxes.try_emplace(instance.name.substr(0, instance.name.find('/')), part);
    if (!is_first)
      at->second = {glm::min(at->second.lower, part.lower), glm::max(at->second.upper, part.upper)};
  }
  return boxes;
}

}  // namespace

std::vector<std::string> size_warnings(const Scene& scene, const std::filesystem::path& file,
                                       const glm::dvec3& place, const DisplayProfile& profile) {
  std::string tiny, huge;
  double fewest = kFewPixels, largest = kHuge_m;
  for (const auto& [name, box] : boxes_of_objects(scene)) {
    const double pixels = pixels_across(box, place, profile);
    if (pixels < fewest) {
      fewest = pixels;
      tiny =
          (name.empty() ? "an object" : "\"" + printable(name) + "\"") + " " + tiny_words(box, place, pixels);
    }
    if (is_around(box, place) && across(box) >= largest) {
      largest = across(box);
      huge = around_words(name, box);
    }
  }
  std::vector<std::string> warnings;
  for (const std::string& text : {tiny, huge})
    if (!text.empty()) warnings.push_back(printable(file.string()) + ": " + text);
  return warnings;
}

std::vector<std::string> picture_warnings(const Scene& scene, const std::filesystem::path& file,
                                          const FramePlan& plan, const RenderSettings& settings,
                                          bool feed_known) {
  std::vector<std::string> warnings;
  const auto add = [&](const std::string& sentence) {
    if (!sentence.empty()) warnings.push_back(printable(file.string()) + ": " + sentence);
  };
  add(no_lights(scene, plan));
  for (const std::string& line : lamp_warnings(scene)) add(line);
  if (feed_known) add(catchers_without_feed(scene, plan, settings));
  if (const std::string glow = glow_without_light(scene, plan); !glow.empty())
    add(glow + "; switch probes on");
  return warnings;
}

std::string feed_distance_warning(const RenderSettings& asked, bool has_camera, const std::string& session) {
  if (!asked.feed_distance_m || has_camera || !asked.camera) return {};
  return "--feed-distance: " + printable(session) +
         " has no camera, so there is no feed to show; leave it out";
}

std::string nothing_measured_warning(double object_samples) {
  if (object_samples != 0) return {};
  return "no virtual object was in view in any frame that was measured: this tells of empty frames alone; "
         "take a "
         "stretch that shows some (--start of check; 'herr inspect SESSION --scene FILE' says when an object "
         "is "
         "most central), or set world_from_session";
}

std::string nothing_seen_warning(const Scene& scene, std::int64_t frames,
                                 const std::optional<Pose>& world_from_head, const DisplayProfile& profile) {
  std::string text =
      "no virtual object was in view in " +
      (frames == 1 ? std::string("the one frame") : "any of the " + std::to_string(frames) + " frames");
  const Instance* nearest = nullptr;
  double least_deg = 181;
  const glm::dvec3 forward =
      world_from_head ? world_from_head->orientation * glm::dvec3(0, 0, -1) : glm::dvec3(0, 0, -1);
  if (world_from_head)
    text += "; the head stood at " + vector_text(world_from_head->position) +
            " in the scene and looked along " + vector_text(forward);
  bool any = false;
  for (const Instance& instance : scene.instances) {
    if (instance.catcher || !instance.present) continue;
    any = true;
    if (!world_from_head) break;
    const double deg = angle_to(instance_bounds(scene, instance), world_from_head->position, forward);
    if (deg >= least_deg) continue;
    least_deg = deg;
    nearest = &instance;
  }
  if (!any)
    return text + "; the scene has none but catchers, which are not drawn: add \"gltf\" or \"shapes\"";
  if (nearest != nullptr) {
    const Bounds box = instance_bounds(scene, *nearest);
    const glm::dvec3& place = world_from_head->position;
    if (is_around(box, place)) return text + "; " + around_words(nearest->name, box);
    const double pixels = pixels_across(box, place, profile);
    if (pixels < kFewPixels && least_deg < kAhead_deg)
      return text + "; the nearest object" +
             (nearest->name.empty() ? "" : " \"" + printable(nearest->name) + "\"") + " " +
             tiny_words(box, place, pixels);
    text += ", the nearest object" + (nearest->name.empty() ? "" : " \"" + printable(nearest->name) + "\"") +
            " is " + fixed_text(least_deg, 0) + " degrees away";
  }
  return text +
         "; move it, or set world_from_session ('herr inspect SESSION --scene FILE' prints one that brings "
         "it into view)";
}

}  // namespace herr
