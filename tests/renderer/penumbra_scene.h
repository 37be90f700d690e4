// A straight edge under a large light: how much of the light each place of the floor sees, in double and as
// rendered. Before: tests choose light and samples. After: errors of soft shadows, and how they fall.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/renderer/half_pixels.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {

inline constexpr double kLightHeight_m = 2.0, kEdgeHeight_m = 1.0, kEyeHeight_m = 0.9;

// The floor y = 0 under a screen at y = 1 that covers x < 0, and a light at y = 2; the
// eye lies below the screen.
inline Scene edge_scene(const glm::vec3& light_size) {
  Scene scene;
  Material dull = matte(glm::vec3{0.8f});
  add(scene, floor_quad(50), dull);
  add(scene, quad({-50, kEdgeHeight_m, 50}, {50, 0, 0}, {0, 0, -100}), dull);
  scene.lights = {light_at({0, kLightHeight_m, 0}, glm::vec3{10.0f}, light_size)};
  return scene;
}

// Irradiance at (x, 0, z) by the midpoint rule over the light, of what the edge lets through or of all. Along
// x the rule's cells are cut where the edge cuts them, so that visibility is exact.
inline double irradiance(const AreaLight& light, double x, double z, bool behind_edge, int cells = 48) {
  const glm::dvec3 size(light.size), lower = light.centre - 0.5 * size;
  const int cells_y = size.y > 0 ? cells : 1, cells_z = size.z > 0 ? cells : 1;
  double sum = 0;
  for (int j = 0; j < cells_y; ++j) {
    const double y = lower.y + size.y * (j + 0.5) / cells_y;
    // A point of the light at height y is seen where x + (lx - x) edge / y > 0.
    const double first_seen = behind_edge ? x * (1 - y / kEdgeHeight_m) : -1e9;
    for (int k = 0; k < cells_z; ++k) {
      const double lz = lower.z + size.z * (k + 0.5) / cells_z;
      for (int i = 0; i < cells; ++i) {
        const double from = std::max(lower.x + size.x * i / cells, first_seen);
        const double to = lower.x + size.x * (i + 1) / cells;
        if (to <= from) continue;
        const glm::dvec3 way = glm::dvec3{0.5 * (from + to), y, lz} - glm::dvec3{x, 0, z};
        const double d2 = glm::dot(way, way);
        sum += (to - from) / size.x * way.y / (d2 * std::sqrt(d2));
      }
    }
  }
  return sum / (cells_y * cells_z);
}

// 0.6 m to both sides of the edge's projection: the penumbra of a light of 1 m reaches 0.5 m.
inline DisplayProfile penumbra_view(int width_px, int height_px) {
  DisplayProfile profile;
  profile.name = "penumbra";
  const double half_deg = std::atan2(0.6, kEyeHeight_m) * kDegreesPerRadian;
  profile.viewports = {viewport_deg(Eye::left, width_px, height_px, -half_deg, half_deg, -5, 5)};
  return profile;
}

inline FrameSample penumbra_sample() {
  return looking_down({0, kEyeHeight_m, 0});
}

// The exact visible share of the light at each pixel, row by row.
inline std::vector<double> exact_shares(const AreaLight& light, const Viewport& viewport, int cells = 48) {
  std::vector<double> shares;
  for (int y = 0; y < viewport.height_px; ++y) {
    for (int x = 0; x < viewport.width_px; ++x) {
      const glm::dvec3 d = direction_of_pixel(viewport, x, y);
      const double floor_x = kEyeHeight_m * d.x / -d.z, floor_z = -kEyeHeight_m * d.y / -d.z;
      shares.push_back(irradiance(light, floor_x, floor_z, true, cells) /
                       irradiance(light, floor_x, floor_z, false, cells));
    }
  }
  return shares;
}

// The visible share of a picture, against the same without the screen.
inline std::vector<double> shares_of(const ViewportImage& picture, const ViewportImage& unshadowed) {
  std::vector<double> shares;
  for_each_pixel(picture, [&](int x, int y, const Pixel& pixel) {
    shares.push_back(pixel[0] / pixel_at(unshadowed, x, y)[0]);
  });
  return shares;
}

}  // namespace herr::test
