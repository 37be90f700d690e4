// Where a thing stands, as documents and events write it, and what an event changes about that.
// Before: scene_document_parts, scene_change. After: Scene::objects, world.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x3.hpp>
#include <optional>

namespace herr {

// Applied in the order scale, rotation, translation.
struct Placement {
  glm::dvec3 translation{0.0};              // metres
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  // unit
  glm::dvec3 scale{1.0};                    // not 0

  glm::dmat4x3 matrix() const {
    const glm::dmat3 r = glm::mat3_cast(rotation);
    return {r[0] * scale.x, r[1] * scale.y, r[2] * scale.z, translation};
  }
  bool operator==(const Placement&) const = default;
};

// Parts that are not given stay as they are.
struct PlacementChange {
  std::optional<glm::dvec3> translation;
  std::optional<glm::dquat> rotation;
  std::optional<glm::dvec3> scale;

  bool any() const { return translation || rotation || scale; }
  Placement apply(Placement placement) const {
    if (translation) placement.translation = *translation;
    if (rotation) placement.rotation = *rotation;
    if (scale) placement.scale = *scale;
    return placement;
  }
};

}  // namespace herr
