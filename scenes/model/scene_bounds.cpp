// How far instances and whole scenes reach.
#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "scenes/model/scene.h"

namespace herr {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Bounds nothing() {
  return {glm::dvec3(kInfinity), glm::dvec3(-kInfinity)};
}

// Half the extent of a unit shape along each world axis: of [-1, 1]^3 the sum of what its three half edges
// reach, of the unit sphere the length of the matrix's row.
glm::dvec3 reach_of(const Instance& instance) {
  const glm::dmat4x3& m = instance.world_from_object;
  glm::dvec3 reach(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 row(m[0][axis], m[1][axis], m[2][axis]);
    reach[axis] = instance.kind == ShapeKind::sphere ? glm::length(row)
                                                     : std::abs(row.x) + std::abs(row.y) + std::abs(row.z);
  }
  return reach;
}

// A grid fills [0, counts] of its object space: as a box about its middle.
Instance box_of(const VoxelGrid& grid, const Instance& instance) {
  Instance box = instance;
  const glm::dvec3 half = 0.5 * glm::dvec3(grid.counts);
  glm::dmat4x3& m = box.world_from_object;
  m[3] += m[0] * half.x + m[1] * half.y + m[2] * half.z;
  for (int axis = 0; axis < 3; ++axis) m[axis] *= half[axis];
  box.kind = ShapeKind::box;
  return box;
}

}  // namespace

Bounds instance_bounds(const Scene& scene, const Instance& instance) {
  if (instance.kind == ShapeKind::voxels) {
    return instance_bounds(scene, box_of(scene.voxel_grids[instance.grid], instance));
  }
  const glm::dmat4x3& m = instance.world_from_object;
  if (instance.kind != ShapeKind::mesh) return {m[3] - reach_of(instance), m[3] + reach_of(instance)};
  Bounds bounds = nothing();
  for (const glm::vec3& position : scene.meshes[instance.mesh].positions) {
    const glm::dvec3 world = m * glm::dvec4(glm::dvec3(position), 1.0);
    bounds.lower = glm::min(bounds.lower, world);
    bounds.upper = glm::max(bounds.upper, world);
  }
  return bounds;
}

Bounds scene_bounds(const Scene& scene) {
  const bool only_catchers =
      std::all_of(scene.instances.begin(), scene.instances.end(),
                  [](const Instance& instance) { return instance.catcher || !instance.present; });
  Bounds bounds = nothing();
  for (const Instance& instance : scene.instances) {
    if ((instance.catcher && !only_catchers) || !instance.present) continue;
    const Bounds box = instance_bounds(scene, instance);
    bounds.lower = glm::min(bounds.lower, box.lower);
    bounds.upper = glm::max(bounds.upper, box.upper);
  }
  // Nothing to show: a box of no size at the origin.
  return bounds.lower.x <= bounds.upper.x ? bounds : Bounds{};
}

}  // namespace herr
