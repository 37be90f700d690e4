#include "server/look/look_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/environment/environment_image.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr int kRoomWidth_px = 128, kRoomHeight_px = 64;
// Where the sun stands, seen from the model, when the camera is at azimuth 0; and the strip of light.
constexpr double kSunAzimuth_deg = -35, kSunElevation_deg = 45, kStripAzimuth_deg = 70;

glm::dvec3 direction_to(double azimuth_deg, double elevation_deg) {
  const double a = glm::radians(azimuth_deg), e = glm::radians(elevation_deg);
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

// Mean over the sphere: rows count by the sine of their polar angle.
glm::dvec3 mean_radiance(const EnvironmentImage& image) {
  glm::dvec3 sum(0.0);
  double weights = 0;
  const float* texel = image.rgba.data();
  for (int y = 0; y < image.height_px; ++y) {
    const double weight = std::sin(glm::pi<double>() * (y + 0.5) / image.height_px);
    for (int x = 0; x < image.width_px; ++x, texel += 4)
      sum += weight * glm::dvec3(texel[0], texel[1], texel[2]);
    weights += weight * image.width_px;
  }
  return sum / weights;
}

// From 0 to 1 about `edge`, over `width`.
double soft_step(double value, double edge, double width) {
  const double t = std::clamp((value - edge) / width + 0.5, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Radiance of the room, before its mean is brought to kStudioAmbient; azimuths are the camera's.
double room_radiance(const glm::dvec3& direction) {
  const double up = direction.y;
  double light = 0.15 + 0.55 * soft_step(up, 0.25, 1.5) - 0.08 * soft_step(-up, 0.0, 0.1);
  const double box = glm::dot(direction, direction_to(kSunAzimuth_deg, kSunElevation_deg));
  light += 2.5 * soft_step(box, std::cos(glm::radians(22.0)), 0.03);
  const double azimuth = std::atan2(direction.x, direction.z);
  const double aside =
      std::abs(std::remainder(azimuth - glm::radians(kStripAzimuth_deg), 2 * glm::pi<double>()));
  light += 1.2 * soft_step(-aside, -glm::radians(12.0), 0.08) * soft_step(-std::abs(up), -0.6, 0.2);
  return light;
}

// As it stands about a camera at azimuth 0.
void paint_room(EnvironmentImage& image) {
  image.width_px = kRoomWidth_px;
  image.height_px = kRoomHeight_px;
  image.rgba.resize(std::size_t{4} * kRoomWidth_px * kRoomHeight_px);
  float* texel = image.rgba.data();
  for (int y = 0; y < kRoomHeight_px; ++y) {
    const double elevation_deg = 90 - 180 * (y + 0.5) / kRoomHeight_px;
    for (int x = 0; x < kRoomWidth_px; ++x, texel += 4) {
      // The middle column lies towards -Z, azimuth 180; columns run clockwise, azimuths against it.
      const double azimuth = 180 - (360 * (x + 0.5) / kRoomWidth_px - 180);
      std::fill_n(texel, 3, static_cast<float>(room_radiance(direction_to(azimuth, elevation_deg))));
    }
  }
  const auto scale = static_cast<float>(kStudioAmbient / mean_radiance(image).x);
  for (float& value : image.rgba) value *= scale;
}

}  // namespace

bool needs_studio(const Scene& scene, bool bare_model) {
  const glm::vec3 dark(0.0f);
  if (!scene.lights.empty() || scene.ambient != dark || !scene.environment_map.rgba.empty()) return false;
  if (bare_model) return true;
  return scene.environment == dark &&
         std::none_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
           const Material& of = scene.materials[instance.material];
           return of.emission != dark || of.unlit;
         });
}

void light_studio(double azimuth_deg, Scene& scene) {
  AreaLight sun;
  sun.name = "studio";
  sun.kind = LightKind::sun;
  sun.direction = -direction_to(azimuth_deg + kSunAzimuth_deg, kSunElevation_deg);
  sun.intensity_w_sr = glm::vec3(static_cast<float>(glm::pi<double>() * (1 - kStudioAmbient)));
  scene.lights = {sun};
  scene.ambient = scene.environment = glm::vec3(static_cast<float>(kStudioAmbient));
  // Painted once: renderers blur the picture when they are made, and turn what they made of it.
  if (scene.environment_map.rgba.empty()) paint_room(scene.environment_map);
  scene.environment_map.turn_deg = static_cast<float>(azimuth_deg);
}

void add_environment(const LookOptions& options, bool studio, Scene& scene) {
  if (studio) light_studio(options.from.azimuth_deg, scene);
  std::vector<std::string> remarks;
  scene.environment_map = read_environment_image(options.environment, remarks);
  for (const std::string& remark : remarks)
    scene.warnings.push_back(printable(options.environment) + ": " + remark);
  scene.files.emplace_back(options.environment);
  const glm::dvec3 mean = mean_radiance(scene.environment_map);
  if (studio) {
    const double brightness = (mean.x + mean.y + mean.z) / 3;
    scene.lights.front().intensity_w_sr *= static_cast<float>(brightness / kStudioAmbient);
  }
  scene.ambient = glm::vec3(mean);
}

}  // namespace herr
