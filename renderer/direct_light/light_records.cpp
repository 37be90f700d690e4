#include "renderer/direct_light/light_records.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>

#include "renderer/broken_on_purpose.h"
#include "renderer/direct_light/strata_order.h"

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
      // The diagonal of a stratum: the smaller, the more even the samples.
      const double x = static_cast<double>(size.x) / nx, y = static_cast<double>(size.y) / ny,
                   z = static_cast<double>(size.z) / nz;
      const double misfit = x * x + y * y + z * z;
      if (misfit < best_misfit * (1 - 1e-12)) best_misfit = misfit, best = {nx, ny, nz};
    }
  }
  return best;
}

namespace {

constexpr double kNearestShare = 0x1p-24;  // of coordinates: a float does not tell nearer places apart
constexpr float kMostIrradiance = 1e29f;   // what it is multiplied by must not leave a float's range
constexpr float kSmallestSquare = 1e-36f;  // so that its inverse is finite

// Below this squared distance a light gets no brighter. A place near the light is rounded as the light's own,
// and as the eye's whose ray leads there: what lies far away is no matter.
float nearest2(const AreaLight& light, const glm::vec3& centre, const LightReach& reach) {
  const glm::vec3& i = light.intensity_w_sr;
  const double largest_m = 2 * (double{glm::length(centre)} + reach.eyes_m);
  const double nearest_m = kNearestShare * std::min(reach.beyond_scene_m, largest_m);
  return std::max({static_cast<float>(nearest_m * nearest_m), std::max({i.x, i.y, i.z}) / kMostIrradiance,
                   kSmallestSquare});
}

}  // namespace

void light_records(std::span<const AreaLight> lights, const glm::dvec3& anchor, LightSampling sampling,
                   const LightReach& reach, std::vector<LightRecord>& out) {
  out.clear();
  for (const AreaLight& light : lights) {
    if (light.intensity_w_sr == glm::vec3{0.0f}) continue;
    LightRecord record;
    record.kind = light.kind;
    record.is_virtual = light.is_virtual;
    const glm::vec3 centre(light.centre - anchor);
    for (int axis = 0; axis < 3; ++axis) {
      record.centre[axis] = centre[axis];
      record.lower[axis] = centre[axis] - 0.5f * light.size[axis];
      record.size[axis] = light.size[axis];
      record.intensity[axis] = light.intensity_w_sr[axis];
    }
    const float half = 0.5f * std::max({light.size.x, light.size.y, light.size.z});
    record.min_distance2 = std::max(half * half, nearest2(light, centre, reach));
    if constexpr (kFault == Fault::singular_falloff) record.min_distance2 = nearest2(light, centre, reach);
    for (int axis = 0; axis < 3; ++axis) record.direction[axis] = static_cast<float>(light.direction[axis]);
    if (light.range_m > 0) record.inverse_range2 = static_cast<float>(1.0 / (light.range_m * light.range_m));
    if (light.kind == LightKind::spot) {
      // KHR_lights_punctual: clamp((cos - cos_outer) / (cos_inner - cos_outer))^2.
      const double inner = std::cos(light.inner_cone_rad), outer = std::cos(light.outer_cone_rad);
      const double scale = 1.0 / std::max(1e-3, inner - outer);
      record.cone_scale = static_cast<float>(scale);
      record.cone_offset = static_cast<float>(-outer * scale);
    }
    record.reach = static_cast<float>(reach.beyond_scene_m);
    // All samples of a light without extent would be the same.
    const bool extended = light.size.x > 0 || light.size.y > 0 || light.size.z > 0;
    record.samples = extended ? sampling.samples : 1;
    record.first_samples = extended ? sampling.first : 1;
    record.stratified = sampling.stratified;
    const auto strata = strata_for(light.size, record.samples);
    std::copy(strata.begin(), strata.end(), record.strata);
    // The half vector turns by half of what the light's direction does. Others than one lie anywhere in their
    // strata. One lies in the middle, and its highlight is to send half of its light as near to its own
    // middle as a square lamp's: GGX does within alpha, a square within sqrt(2 / pi) of half its edge.
    const float across = record.samples == 1 ? 0.25f * std::sqrt(2.0f * std::numbers::inv_pi_v<float>) : 0.5f;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float stratum = record.size[axis] / static_cast<float>(strata[axis]);
      record.half_turn_m = std::max(record.half_turn_m, across * stratum);
    }
    if (record.first_samples < record.samples) order_strata(record);
    record.key = static_cast<std::uint32_t>(&light - lights.data())
                 << 20;  // 3 numbers for each of 4096 samples
    out.push_back(record);
  }
}

glm::vec3 farthest_irradiance(std::span<const AreaLight> lights, std::span<const Bounds> boxes) {
  glm::vec3 sum{0.0f};
  for (const AreaLight& light : lights) {
    if (light.is_virtual) continue;
    if (light.kind == LightKind::sun) {
      sum += light.intensity_w_sr;
      continue;
    }
    double farthest2 = 0;
    for (const Bounds& box : boxes) {
      const glm::dvec3 reach =
          glm::max(glm::abs(box.lower - light.centre), glm::abs(box.upper - light.centre));
      farthest2 = std::max(farthest2, glm::dot(reach, reach));
    }
    sum += light.intensity_w_sr / std::max(static_cast<float>(farthest2), kSmallestSquare);
  }
  return sum;
}

}  // namespace herr
