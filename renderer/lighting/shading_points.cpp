#include "renderer/lighting/shading_points.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

// In edges of a point's stratum: light of all points errs by about the fourth power of edge over distance.
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

// The middles of n equal parts vary by 1 - 1 / n^2 of what the whole does: spread by its root, so that light
// which changes with the square of the way across the lamp comes out exactly (of two parts: Gauss's points).
void spread_middles(LightRecord& few) {
  for (int axis = 0; axis < 3; ++axis) {
    if (few.strata[axis] < 2) continue;
    const float n = static_cast<float>(few.strata[axis]);
    const float size = few.size[axis] / std::sqrt(1 - 1 / (n * n));
    few.lower[axis] -= 0.5f * (size - few.size[axis]);
    few.size[axis] = size;
  }
}

ShadingPoints points_of(const LightRecord& light) {
  ShadingPoints points;
  LightRecord& few = points.light;
  few = light;
  join_strata(light, few.strata);
  few.samples = few.first_samples = few.strata[0] * few.strata[1] * few.strata[2];
  few.in_middles = true;
  float widest = 0;
  for (int axis = 0; axis < 3; ++axis)
    widest = std::max(widest, few.size[axis] / static_cast<float>(few.strata[axis]));
  few.half_turn_m = 0.5f * widest;
  spread_middles(few);
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
