#include "renderer/lighting/light_records.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace herr {

std::array<int, 3> strata_for(const glm::vec3& size, int samples) {
  std::array<int, 3> best{samples, 1, 1};
  double best_misfit = 1e300;
  for (int nx = 1; nx <= samples; ++nx) {
    if (samples % nx != 0 || (nx > 1 && !(size.x > 0))) continue;
    for (int ny = 1; ny <= samples / nx; ++ny) {
      if (samples / nx % ny != 0 || (ny > 1 && !(size.y > 0))) continue;
      const int nz = samples / nx / ny;
      if (nz > 1 && !(size.z > 0)) continue;
      // The longest edge of a stratum: the smaller, the more even the samples.
      const double longest = std::max({static_cast<double>(size.x) / nx, static_cast<double>(size.y) / ny,
                                       static_cast<double>(size.z) / nz});
      if (longest < best_misfit) best_misfit = longest, best = {nx, ny, nz};
    }
  }
  return best;
}

void light_records(std::span<const AreaLight> lights, const glm::dvec3& anchor, int samples,
                   std::vector<LightRecord>& out) {
  out.clear();
  for (const AreaLight& light : lights) {
    if (light.intensity_w_sr == glm::vec3{0.0f}) continue;
    LightRecord record;
    const glm::vec3 centre(light.centre - anchor);
    for (int axis = 0; axis < 3; ++axis) {
      record.centre[axis] = centre[axis];
      record.lower[axis] = centre[axis] - 0.5f * light.size[axis];
      record.size[axis] = light.size[axis];
      record.intensity[axis] = light.intensity_w_sr[axis];
    }
    const float half = 0.5f * std::max({light.size.x, light.size.y, light.size.z});
    record.min_distance2 = std::max(half * half, 1e-12f);
    const auto strata = strata_for(light.size, samples);
    std::copy(strata.begin(), strata.end(), record.strata);
    record.key = static_cast<std::uint32_t>(&light - lights.data())
                 << 20;  // 3 numbers for each of 4096 samples
    out.push_back(record);
  }
}

glm::vec3 farthest_irradiance(std::span<const AreaLight> lights, std::span<const Bounds> boxes) {
  glm::vec3 sum{0.0f};
  for (const AreaLight& light : lights) {
    double farthest2 = 1e-12;
    for (const Bounds& box : boxes) {
      const glm::dvec3 reach =
          glm::max(glm::abs(box.lower - light.centre), glm::abs(box.upper - light.centre));
      farthest2 = std::max(farthest2, glm::dot(reach, reach));
    }
    sum += light.intensity_w_sr / static_cast<float>(farthest2);
  }
  return sum;
}

}  // namespace herr
