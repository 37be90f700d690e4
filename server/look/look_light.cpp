#include "server/look/look_light.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/environment/environment_image.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr double kPi = 3.141592653589793;
// Where the studio's sun stands, seen from the model, when the camera is at azimuth 0.
constexpr double kSunAzimuth_deg = -35, kSunElevation_deg = 45;

// Mean over the sphere: rows count by the sine of their polar angle.
glm::vec3 mean_radiance(const EnvironmentImage& image) {
  glm::dvec3 sum(0.0);
  double weights = 0;
  const float* texel = image.rgba.data();
  for (int y = 0; y < image.height_px; ++y) {
    const double weight = std::sin(kPi * (y + 0.5) / image.height_px);
    for (int x = 0; x < image.width_px; ++x, texel += 4)
      sum += weight * glm::dvec3(texel[0], texel[1], texel[2]);
    weights += weight * image.width_px;
  }
  return glm::vec3(sum / weights);
}

}  // namespace

void add_environment(const LookOptions& options, Scene& scene) {
  if (options.environment.empty()) return;
  std::vector<std::string> remarks;
  scene.environment_map = read_environment_image(options.environment, remarks);
  scene.files.emplace_back(options.environment);
  scene.ambient = mean_radiance(scene.environment_map);
  for (const std::string& remark : remarks) {
    scene.warnings.push_back(printable(options.environment) + ": " + remark);
  }
}

bool needs_studio(const Scene& scene) {
  return scene.lights.empty() && scene.ambient == glm::vec3(0.0f) && scene.environment_map.rgba.empty();
}

std::vector<AreaLight> studio_lights(double azimuth_deg) {
  const double azimuth = glm::radians(azimuth_deg + kSunAzimuth_deg),
               elevation = glm::radians(kSunElevation_deg);
  AreaLight sun;
  sun.name = "studio";
  sun.kind = LightKind::sun;
  sun.direction = -glm::dvec3(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                              std::cos(azimuth) * std::cos(elevation));
  sun.intensity_w_sr = glm::vec3(static_cast<float>(kPi * (1 - kStudioAmbient)));
  return {sun};
}

}  // namespace herr
