// The octahedral map of directions with its nodes on the folds: a grid of (N + 1) x (N + 1) nodes over
// [-1, 1]^2, N even, so that axes and folds run through nodes. Interpolation is by triangles cut parallel to
// the outer fold: what is linear in p = d / (|dx| + |dy| + |dz|) is then interpolated without error on the
// whole sphere. The inverse distance to a plane is such a function. Border nodes that mean one direction
// appear several times. Octahedral map: Cigolle et al. 2014. Every function is pure.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace herr {

// Direction of any length but zero -> place in [-1, 1]^2.
inline glm::dvec2 octahedral_from_direction(const glm::dvec3& d) {
  const glm::dvec3 p = d / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  if (p.z >= 0) return {p.x, p.y};
  return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
}

// Place in [-1, 1]^2 -> unit direction.
inline glm::dvec3 direction_from_octahedral(const glm::dvec2& place) {
  const double z = 1 - std::abs(place.x) - std::abs(place.y);
  if (z >= 0) return glm::normalize(glm::dvec3{place.x, place.y, z});
  return glm::normalize(glm::dvec3{std::copysign(1 - std::abs(place.y), place.x),
                                   std::copysign(1 - std::abs(place.x), place.y), z});
}

// Steradians per unit of the map's area there: 1 / |p|^3 with |p| the length of the direction's point on the
// octahedron.
inline double octahedral_density(const glm::dvec2& place) {
  const glm::dvec3 d = direction_from_octahedral(place);
  const double length = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  return 1 / (length * length * length);
}

template <int N>
struct OctahedralNodes {
  static_assert(N % 2 == 0);
  static constexpr int kStride = N + 1;
  static constexpr int kCount = kStride * kStride;
  static constexpr int kDirections = N * N + 2;  // (N - 1)^2 inside, 2 N border pairs and middles, 1 corner

  static constexpr int at(int column, int row) { return row * kStride + column; }
  static glm::dvec3 direction(int node) {
    return direction_from_octahedral({2.0 * (node % kStride) / N - 1, 2.0 * (node / kStride) / N - 1});
  }
  // The first node (in order of index) that means the same direction.
  static constexpr int first_of(int node) {
    const int column = node % kStride, row = node / kStride;
    const bool side = column == 0 || column == N, end = row == 0 || row == N;
    if (side && end) return 0;
    if (end) return column <= N / 2 ? node : at(N - column, row);
    if (side) return row <= N / 2 ? node : at(column, N - row);
    return node;
  }
};

}  // namespace herr
