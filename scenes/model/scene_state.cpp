// The scene at a time, and what can be counted about it.
#include <cmath>

#include "scenes/model/scene.h"

namespace herr {
namespace {

constexpr double kTwoPi = 6.283185307179586476925;

// Counter-clockwise as seen from above, from +X at phase 0. fmod is exact, so hours lose
// no more than t itself has.
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

std::int64_t triangle_count(const Scene& scene, bool catchers) {
  std::int64_t count = 0;
  for (const Instance& instance : scene.instances) {
    if (!instance.present || (instance.catcher && !catchers)) continue;
    if (instance.kind != ShapeKind::mesh) continue;
    count += static_cast<std::int64_t>(scene.meshes[instance.mesh].triangles.size());
  }
  return count;
}

}  // namespace herr
