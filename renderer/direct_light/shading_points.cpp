#include "renderer/direct_light/shading_points.h"

#include <algorithm>
#include <cmath>

namespace herr {
namespace {

// Least distances from a lamp, in edges of a point's stratum. Along an axis of two points or more light errs
// by about the fourth power of edge over distance; along one of a single point by an eighth to a quarter of
// its square.
constexpr float kOfSeveral = 4, kOfOne = 12;

// The divisors of the lamp's strata that leave at most kMostShadingPoints, as near to cubes as may be.
void join_strata(const LightRecord& light, int (&strata)[3]) {
  const auto most = [&](int axis) { return std::min(light.strata[axis], kMostShadingPoints); };
  double best = 1e300;
  for (int x = 1; x <= most(0); ++x) {
    for (int y = 1; y <= most(1); ++y) {
      for (int z = 1; z <= most(2); ++z) {
        const bool divides = light.strata[0] % x == 0 && light.strata[1] % y == 0 && light.strata[2] % z == 0;
        if (!divides || x * y * z > kMostShadingPoints) continue;
        const double a = double{light.size[0]} / x, b = double{light.size[1]} / y,
                     c = double{light.size[2]} / z;
        const double misfit = a * a + b * b + c * c;
        if (misfit < best * (1 - 1e-12)) best = misfit, strata[0] = x, strata[1] = y, strata[2] = z;
      }
    }
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

// Where the middle of stratum `cell` of `strata` lies along an edge that light comes from evenly.
float place_along(float edge_over_whole, int cell, int strata) {
  const float from_middle = (static_cast<float>(cell) + 0.5f) / static_cast<float>(strata) - 0.5f;
  return std::sqrt(12.0f) * edge_over_whole * from_middle;
}

void place_strata(const LightRecord& light, ShadingPoints& points) {
  const LightRecord& few = points.light;
  const auto place = [](const LightRecord& of, std::size_t axis, int stratum, float edge_over_whole) {
    const int nx = of.strata[0], ny = of.strata[1];
    const int cell[3] = {stratum % nx, stratum / nx % ny, stratum / (nx * ny)};
    return of.strata[axis] == 1 ? 0.0f : place_along(edge_over_whole, cell[axis], of.strata[axis]);
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int stratum = 0; stratum < light.samples; ++stratum)
      points.stratum_at[axis][static_cast<std::size_t>(stratum)] = place(light, axis, stratum, 1);
    const float spread = light.size[axis] > 0 ? few.size[axis] / light.size[axis] : 1;
    for (int point = 0; point < few.samples; ++point)
      points.point_at[axis][static_cast<std::size_t>(point)] = place(few, axis, point, spread);
  }
}

ShadingPoints points_of(const LightRecord& light) {
  ShadingPoints points;
  LightRecord& few = points.light;
  few = light;
  join_strata(light, few.strata);
  few.samples = few.first_samples = few.strata[0] * few.strata[1] * few.strata[2];
  few.in_middles = true;
  float widest = 0, nearest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float width = few.size[axis] / static_cast<float>(few.strata[axis]);
    widest = std::max(widest, width);
    nearest = std::max(nearest, (few.strata[axis] > 1 ? kOfSeveral : kOfOne) * width);
  }
  few.half_turn_m = 0.5f * widest;
  spread_middles(few);
  points.nearest2 = nearest * nearest;
  place_strata(light, points);
  return points;
}

}  // namespace

void shading_points(std::span<const LightRecord> lights, std::vector<ShadingPoints>& out) {
  out.clear();
  for (const LightRecord& light : lights)
    out.push_back(light.first_samples < light.samples ? points_of(light) : ShadingPoints{});
}

}  // namespace herr
