// Where the probes of a volume stand: a regular grid over a box, probe i of an axis at min + (i + 1/2) *
// extent / n, so that none lies in the box's own walls.
// Before: scenes/ states the grid or the scene's bounds are taken. After: probe_placement moves single probes
// out of the way of geometry.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "scenes/model/scene.h"

namespace herr {

struct ProbeGrid {
  glm::ivec3 counts{1};     // >= 1 per axis
  glm::dvec3 lower{0.0};    // world, metres
  glm::dvec3 spacing{1.0};  // metres between neighbours, > 0; the extent is counts * spacing

  int size() const { return counts.x * counts.y * counts.z; }
  int index(const glm::ivec3& at) const { return (at.z * counts.y + at.y) * counts.x + at.x; }
  glm::ivec3 place(int index) const {
    return {index % counts.x, index / counts.x % counts.y, index / (counts.x * counts.y)};
  }
  // Unmoved position of a probe, metres from `lower`.
  glm::dvec3 position(const glm::ivec3& at) const { return (glm::dvec3(at) + 0.5) * spacing; }
  double smallest_spacing() const { return glm::min(spacing.x, glm::min(spacing.y, spacing.z)); }
};

// A grid of `counts` over `box`. An axis along which the box is thinner than 1/16 of its longest is widened
// to that, about its middle: probes in the plane of a flat scene would see nothing of it.
ProbeGrid grid_over(const Bounds& box, const glm::ivec3& counts);

// `counts` times `density` along each axis, rounded, 1 at least; where that makes more than kMostProbes, the
// largest of 0.99, 0.99^2, ... times that density that does not.
std::array<int, 3> probe_counts_at(const std::array<int, 3>& counts, double density);

// The grid of a scene: what its document states, else 16 x 8 x 16 over the scene's bounds; at `density`.
ProbeGrid probe_grid_of(const Scene& scene, double density = 1);

// Indices along Morton's curve, the order in which probes share ray packets: any 16 of it that lie on a wall
// are neighbours there.
std::vector<std::int32_t> neighbour_order(const ProbeGrid& grid);

// For each probe: does geometry reach into one of the cells around it? A cell is the box between eight
// probes, or what lies beyond the outermost, unbounded; light is only ever looked up at surfaces, from the
// probes of their cell, and beyond the outermost from these alone.
std::vector<bool> probes_near_geometry(const ProbeGrid& grid, const Scene& scene);

}  // namespace herr
