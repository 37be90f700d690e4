#include "renderer/lighting/shading_points.h"

#include <algorithm>

namespace herr {
namespace {

// Light of a point errs by about (its stratum's edge / distance)^2 / 24.
constexpr float kLeastDistances = 4;

int smallest_factor(int n) {
  for (int factor = 2; factor * factor <= n; ++factor) {
    if (n % factor == 0) return factor;
  }
  return n;
}

// Neighbouring strata come together along the axis where they are narrowest.
void join_strata(const LightRecord& light, int (&strata)[3]) {
  std::copy(light.strata, light.strata + 3, strata);
  while (strata[0] * strata[1] * strata[2] > kMostShadingPoints) {
    int narrowest = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto width = [&](int a) { return light.size[a] / static_cast<float>(strata[a]); };
      if (strata[axis] > 1 && (narrowest < 0 || width(axis) < width(narrowest))) narrowest = axis;
    }
    strata[narrowest] /= smallest_factor(strata[narrowest]);
  }
}

ShadingPoints points_of(const LightRecord& light) {
  ShadingPoints points;
  LightRecord& few = points.light;
  few = light;
  join_strata(light, few.strata);
  few.samples = few.first_samples = few.strata[0] * few.strata[1] * few.strata[2];
  few.in_middles = true;
  few.half_turn_m = 0;
  float widest = 0;
  for (int axis = 0; axis < 3; ++axis)
    widest = std::max(widest, few.size[axis] / static_cast<float>(few.strata[axis]));
  few.half_turn_m = 0.5f * widest;
  points.nearest2 = kLeastDistances * kLeastDistances * widest * widest;
  points.samples_each = static_cast<float>(light.samples / few.samples);
  for (int point = 0; point < few.samples; ++point)
    few.stratum_of[static_cast<std::size_t>(point)] = static_cast<std::uint16_t>(point);
  const int nx = light.strata[0], ny = light.strata[1];
  for (int stratum = 0; stratum < light.samples; ++stratum) {
    const int cell[3] = {stratum % nx, stratum / nx % ny, stratum / (nx * ny)};
    int at[3];
    for (int axis = 0; axis < 3; ++axis) at[axis] = cell[axis] * few.strata[axis] / light.strata[axis];
    const int point = at[0] + few.strata[0] * (at[1] + few.strata[1] * at[2]);
    points.of_sample[light.sample_of[static_cast<std::size_t>(stratum)]] = static_cast<std::uint8_t>(point);
  }
  return points;
}

}  // namespace

void shading_points(std::span<const LightRecord> lights, std::vector<ShadingPoints>& out) {
  out.clear();
  for (const LightRecord& light : lights)
    out.push_back(light.first_samples < light.samples ? points_of(light) : ShadingPoints{});
}

}  // namespace herr
