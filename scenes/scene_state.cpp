// The scene at a time, and what can be counted about it.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "scenes/scene.h"

namespace herr {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;

// Counter-clockwise as seen from above, from +X at phase 0. fmod is exact, so hours lose no more than t
// itself has.
glm::dvec3 centre_at(const AreaLight& light, double time_s) {
  if (light.path_radius_m == 0 || light.path_period_s == 0) return light.centre;
  const double turns =
      std::fmod(time_s, light.path_period_s) / light.path_period_s + light.path_phase_deg / 360.0;
  const double angle = kTwoPi * (turns - std::floor(turns));
  return light.centre + light.path_radius_m * glm::dvec3(std::cos(angle), 0.0, -std::sin(angle));
}

}  // namespace

void scene_state_at(const Scene& scene, double time_s, SceneState& out) {
  out.lights = scene.lights;
  for (AreaLight& light : out.lights) light.centre = centre_at(light, time_s);
}

Bounds scene_bounds(const Scene& scene) {
  const bool only_catchers = std::all_of(scene.instances.begin(), scene.instances.end(),
                                         [](const MeshInstance& instance) { return instance.catcher; });
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
  for (const MeshInstance& instance : scene.instances) {
    if (instance.catcher && !only_catchers) continue;
    for (const glm::vec3& position : scene.meshes[instance.mesh].positions) {
      const glm::dvec3 world = instance.world_from_object * glm::dvec4(glm::dvec3(position), 1.0);
      bounds.lower = glm::min(bounds.lower, world);
      bounds.upper = glm::max(bounds.upper, world);
    }
  }
  // Nothing to show: a box of no size at the origin.
  return bounds.lower.x <= bounds.upper.x ? bounds : Bounds{};
}

std::int64_t triangle_count(const Scene& scene, bool catchers) {
  std::int64_t count = 0;
  for (const MeshInstance& instance : scene.instances) {
    if (instance.catcher && !catchers) continue;
    count += static_cast<std::int64_t>(scene.meshes[instance.mesh].triangles.size());
  }
  return count;
}

}  // namespace herr
