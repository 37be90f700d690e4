// Grids of voxels made by formulas, and rays through them in double precision by slow obvious code.
// Before: a test says which voxels there are. After: it compares what the renderer finds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "scenes/model/voxel_grid.h"

namespace herr::test {

// colour(x, y, z) -> RGBA8, 0 for none.
template <typename Colour>
VoxelGrid voxel_grid(const glm::ivec3& counts, const Colour& colour) {
  VoxelGrid grid;
  grid.allocate(counts);
  for (int z = 0; z < counts.z; ++z) {
    for (int y = 0; y < counts.y; ++y) {
      for (int x = 0; x < counts.x; ++x) {
        const std::uint32_t rgba = colour(x, y, z);
        if (rgba >> 24 != 0) grid.set({x, y, z}, rgba);
      }
    }
  }
  return grid;
}

// A hollow ball with holes, in many colours: `wall` voxels thick.
inline VoxelGrid holed_ball(int side, double wall) {
  return voxel_grid({side, side, side}, [&](int x, int y, int z) -> std::uint32_t {
    const double r = glm::length(glm::dvec3(x, y, z) + 0.5 - 0.5 * side), outer = 0.48 * side;
    const bool hole = std::sin(0.9 * x) + std::sin(0.8 * y) + std::sin(0.7 * z) > 1.2;
    if (r > outer || r < outer - wall || hole) return 0;
    return 0xff000000u | static_cast<std::uint32_t>(x * 255 / side) |
           static_cast<std::uint32_t>(y * 255 / side) << 8 | static_cast<std::uint32_t>(z * 255 / side) << 16;
  });
}

// A hollow ball in patches of two colours, 16 voxels wide.
inline VoxelGrid patched_ball(int side, double wall) {
  return voxel_grid({side, side, side}, [&](int x, int y, int z) -> std::uint32_t {
    const double r = glm::length(glm::dvec3(x, y, z) + 0.5 - 0.5 * side), outer = 0.48 * side;
    if (r > outer || r < outer - wall) return 0;
    return (x / 16 + y / 16 + z / 16) % 2 == 0 ? 0xff4060e0u : 0xffe0c040u;
  });
}

struct ExactHit {
  double t = 0;
  int axis = 0;  // of the face by which the ray came in
  glm::ivec3 voxel{0};
};

// The first voxel that a ray from outside the grid meets: voxel by voxel, in double.
inline std::optional<ExactHit> exact_hit(const VoxelGrid& grid, const glm::dvec3& o, const glm::dvec3& d) {
  double enter = 0, leave = std::numeric_limits<double>::infinity();
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    const double a = (0 - o[i]) / d[i], b = (grid.counts[i] - o[i]) / d[i];
    if (std::min(a, b) > enter) enter = std::min(a, b), axis = i;
    leave = std::min(leave, std::max(a, b));
  }
  if (!(enter < leave)) return std::nullopt;
  ExactHit at{enter, axis, {}};
  for (int i = 0; i < 3; ++i) {
    const int last = grid.counts[i] - 1;
    at.voxel[i] = std::clamp(static_cast<int>(std::floor(o[i] + enter * d[i])), 0, last);
    if (i == axis) at.voxel[i] = d[i] > 0 ? 0 : last;
  }
  while (grid.at(at.voxel) == 0) {
    double next = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const double t = (at.voxel[i] + (d[i] > 0 ? 1 : 0) - o[i]) / d[i];
      if (t < next) next = t, at.axis = i;
    }
    at.t = next;
    at.voxel[at.axis] += d[at.axis] > 0 ? 1 : -1;
    if (at.voxel[at.axis] < 0 || at.voxel[at.axis] >= grid.counts[at.axis]) return std::nullopt;
  }
  return at;
}

}  // namespace herr::test
