#include "scenes/changes/bounding_sphere.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>

#include "scenes/animation/bend_mesh.h"

namespace herr {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

// Points of an instance in the world, and how far each reaches.
class Reach {
 public:
  Reach(const Scene& scene, const SceneState& state) : scene_(scene) {
    for (std::size_t i = 0; i < std::min(scene.deformations.size(), state.poses.size()); ++i) {
      const std::uint32_t mesh = scene.deformations[i].mesh;
      TriangleMesh bent = scene.meshes[mesh];
      bend_mesh(scene.deformations[i], state.poses[i], bent);
      bent_.insert_or_assign(mesh, std::move(bent.positions));
    }
  }

  template <typename Visit>
  void visit(const Instance& instance, const Visit& visit) const {
    const glm::dmat4x3& m = instance.world_from_object;
    if (instance.kind == ShapeKind::sphere) {
      double radius = 0;
      for (int axis = 0; axis < 3; ++axis) radius = std::max(radius, glm::length(m[axis]));
      return visit(m[3], radius);
    }
    if (instance.kind == ShapeKind::mesh) {
      const auto bent = bent_.find(instance.mesh);
      for (const glm::vec3& p : bent != bent_.end() ? bent->second : scene_.meshes[instance.mesh].positions)
        visit(m * glm::dvec4(glm::dvec3(p), 1.0), 0.0);
      return;
    }
    const bool grid = instance.kind == ShapeKind::voxels;
    const glm::dvec3 upper = grid ? glm::dvec3(scene_.voxel_grids[instance.grid].counts) : glm::dvec3(1.0);
    const glm::dvec3 lower = grid ? glm::dvec3(0.0) : glm::dvec3(-1.0);
    for (unsigned corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p((corner & 1u) != 0 ? upper.x : lower.x, (corner & 2u) != 0 ? upper.y : lower.y,
                         (corner & 4u) != 0 ? upper.z : lower.z);
      visit(m * glm::dvec4(p, 1.0), 0.0);
    }
  }

 private:
  const Scene& scene_;
  std::unordered_map<std::uint32_t, std::vector<glm::vec3>> bent_;  // by mesh
};

}  // namespace

BoundingSphere bounding_sphere(const Scene& scene, const SceneState& state) {
  const bool only_catchers = std::all_of(scene.instances.begin(), scene.instances.end(),
                                         [](const Instance& i) { return i.catcher || !i.present; });
  const Reach reach(scene, state);
  const auto each = [&](const auto& visit) {
    for (const Instance& instance : scene.instances) {
      if (instance.present && (only_catchers || !instance.catcher)) reach.visit(instance, visit);
    }
  };
  glm::dvec3 lower(kEndless), upper(-kEndless);
  each([&](const glm::dvec3& point, double radius) {
    lower = glm::min(lower, point - radius);
    upper = glm::max(upper, point + radius);
  });
  if (!(lower.x <= upper.x)) return {};
  BoundingSphere sphere{0.5 * (lower + upper), 0};
  each([&](const glm::dvec3& point, double radius) {
    sphere.radius = std::max(sphere.radius, glm::distance(sphere.centre, point) + radius);
  });
  return sphere;
}

}  // namespace herr
