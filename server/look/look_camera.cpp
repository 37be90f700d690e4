#include "server/look/look_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

namespace herr {

LookCamera look_camera(const LookOptions& options, const LookDirection& from, const BoundingSphere& sphere) {
  const double tan_half = std::tan(glm::radians(0.5 * options.fov_deg));
  const double per_px = tan_half / (0.5 * std::min(options.width_px, options.height_px));
  Viewport viewport;
  viewport.name = "look";
  viewport.width_px = options.width_px;
  viewport.height_px = options.height_px;
  viewport.tan_right = 0.5 * per_px * options.width_px;
  viewport.tan_up = 0.5 * per_px * options.height_px;
  viewport.tan_left = -viewport.tan_right;
  viewport.tan_down = -viewport.tan_up;

  LookCamera camera;
  camera.profile.name = "look";
  camera.profile.viewports = {viewport};
  camera.distance = options.distance * sphere.radius / std::sin(std::atan(kFilledShare * tan_half));
  const glm::dquat turned = glm::angleAxis(glm::radians(from.azimuth_deg), glm::dvec3(0, 1, 0)) *
                            glm::angleAxis(glm::radians(-from.elevation_deg), glm::dvec3(1, 0, 0));
  camera.world_from_camera.orientation = turned;
  camera.world_from_camera.position = sphere.centre + turned * glm::dvec3(0, 0, camera.distance);
  return camera;
}

}  // namespace herr
