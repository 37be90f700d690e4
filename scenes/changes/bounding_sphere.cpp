#include "scenes/changes/bounding_sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <unordered_map>
#include <vector>

#include "scenes/animation/bend_mesh.h"

namespace herr {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
// A floor is flat: its thickness is at most a tenth of its breadth. It is far larger than what stands on it
// when it is three times as long: framed with it, that would fill a third of a picture.
constexpr double kFlat = 0.1, kFarLarger = 3;

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

struct Box {
  glm::dvec3 lower{kEndless}, upper{-kEndless};

  void hold(const glm::dvec3& point, double radius) {
    lower = glm::min(lower, point - radius);
    upper = glm::max(upper, point + radius);
  }
  bool empty() const { return !(lower.x <= upper.x); }
  glm::dvec3 sides() const { return upper - lower; }
  double longest() const { return std::max({sides().x, sides().y, sides().z}); }
};

bool is_flat(const Box& box) {
  std::array<double, 3> sides{box.sides().x, box.sides().y, box.sides().z};
  std::sort(sides.begin(), sides.end());
  return sides[0] <= kFlat * sides[1];
}

// About the middle of the box around the instances that `counts` accepts.
template <typename Counts>
BoundingSphere sphere_about(const Scene& scene, const Reach& reach, const Counts& counts) {
  const auto each = [&](const auto& visit) {
    for (const Instance& instance : scene.instances)
      if (counts(instance)) reach.visit(instance, visit);
  };
  Box box;
  each([&](const glm::dvec3& point, double radius) { box.hold(point, radius); });
  if (box.empty()) return {};
  BoundingSphere sphere{0.5 * (box.lower + box.upper), 0};
  each([&](const glm::dvec3& point, double radius) {
    sphere.radius = std::max(sphere.radius, glm::distance(sphere.centre, point) + radius);
  });
  return sphere;
}

// Per object its box; empty: nothing of it is seen.
std::vector<Box> boxes_of_objects(const Scene& scene, const Reach& reach) {
  std::vector<Box> boxes;
  for (const PlacedObject& object : scene.objects) {
    Box box;
    for (std::uint32_t i = object.first; i < object.first + object.count; ++i) {
      const Instance& instance = scene.instances[i];
      if (instance.present && !instance.catcher)
        reach.visit(instance, [&](const glm::dvec3& point, double radius) { box.hold(point, radius); });
    }
    boxes.push_back(box);
  }
  return boxes;
}

// The objects that are flat and far larger than all that is not, by index; none where all are flat.
std::vector<std::size_t> backdrops(const std::vector<Box>& boxes) {
  Box rest;
  for (const Box& box : boxes) {
    if (box.empty() || is_flat(box)) continue;
    rest.hold(box.lower, 0);
    rest.hold(box.upper, 0);
  }
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!rest.empty() && !boxes[i].empty() && is_flat(boxes[i]) &&
        boxes[i].longest() >= kFarLarger * rest.longest())
      found.push_back(i);
  }
  return found;
}

}  // namespace

BoundingSphere bounding_sphere(const Scene& scene, const SceneState& state) {
  const bool only_catchers = std::all_of(scene.instances.begin(), scene.instances.end(),
                                         [](const Instance& i) { return i.catcher || !i.present; });
  return sphere_about(scene, Reach(scene, state), [only_catchers](const Instance& instance) {
    return instance.present && (only_catchers || !instance.catcher);
  });
}

FramedSphere framed_sphere(const Scene& scene, const SceneState& state) {
  const Reach reach(scene, state);
  const std::vector<std::size_t> aside = backdrops(boxes_of_objects(scene, reach));
  FramedSphere framed;
  if (aside.empty()) {
    framed.sphere = bounding_sphere(scene, state);
    return framed;
  }
  for (const std::size_t index : aside) framed.left_out.push_back(scene.objects[index].name);
  framed.sphere = sphere_about(scene, reach, [&](const Instance& instance) {
    if (!instance.present || instance.catcher) return false;
    const auto number = static_cast<std::size_t>(&instance - scene.instances.data());
    return std::none_of(aside.begin(), aside.end(), [&](std::size_t index) {
      const PlacedObject& object = scene.objects[index];
      return number >= object.first && number < std::size_t{object.first} + object.count;
    });
  });
  return framed;
}

}  // namespace herr
