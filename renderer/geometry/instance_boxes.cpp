#include "renderer/geometry/instance_boxes.h"

#include <glm/common.hpp>

namespace herr {
namespace {

constexpr double kFar = 1e300;

void include(Bounds& bounds, const glm::dvec3& point) {
  bounds.lower = glm::min(bounds.lower, point);
  bounds.upper = glm::max(bounds.upper, point);
}

}  // namespace

Bounds box_around(const Bounds& box, const glm::dmat4x3& place) {
  Bounds around{glm::dvec3{kFar}, glm::dvec3{-kFar}};
  if (box.lower.x > box.upper.x) return around;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 at((corner & 1) != 0 ? box.upper.x : box.lower.x,
                        (corner & 2) != 0 ? box.upper.y : box.lower.y,
                        (corner & 4) != 0 ? box.upper.z : box.lower.z, 1.0);
    include(around, place * at);
  }
  return around;
}

InstanceBoxes::InstanceBoxes(const Scene& scene) : scene_(scene) {
  for (const TriangleMesh& mesh : scene.meshes) {
    Bounds box{glm::dvec3{kFar}, glm::dvec3{-kFar}};
    for (const glm::vec3& position : mesh.positions) include(box, glm::dvec3(position));
    mesh_boxes_.push_back(box);
  }
  boxes_.resize(scene.instances.size());
  for (std::size_t slot = 0; slot < boxes_.size(); ++slot) measure(slot);
  sum_up();
}

void InstanceBoxes::measure(std::size_t slot) {
  const Instance& instance = scene_.instances[slot];
  if (instance.kind != ShapeKind::mesh) {
    boxes_[slot] = instance_bounds(scene_, instance);
    return;
  }
  boxes_[slot] = box_around(mesh_boxes_[instance.mesh], instance.world_from_object);
}

void InstanceBoxes::sum_up() {
  all_ = {glm::dvec3{kFar}, glm::dvec3{-kFar}};
  catchers_.clear();
  for (std::size_t slot = 0; slot < boxes_.size(); ++slot) {
    const Instance& instance = scene_.instances[slot];
    if (!instance.present) continue;
    all_.lower = glm::min(all_.lower, boxes_[slot].lower);
    all_.upper = glm::max(all_.upper, boxes_[slot].upper);
    if (instance.catcher) catchers_.push_back(boxes_[slot]);
  }
}

void InstanceBoxes::update(std::span<const ChangedSlot> changed) {
  if (changed.empty()) return;
  boxes_.resize(scene_.instances.size());
  for (const ChangedSlot& change : changed) measure(change.slot);
  sum_up();
}

}  // namespace herr
