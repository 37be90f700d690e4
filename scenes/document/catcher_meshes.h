// Meshes of catchers that a scene document describes by numbers: a box or a flat quadrilateral.
// Before: scene_document. After: Scene::meshes, placed by a translation so that far
// rooms keep their precision.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "scenes/model/scene.h"

namespace herr {

struct PlacedCatcher {
  TriangleMesh mesh;       // about its own centre
  glm::dvec3 centre{0.0};  // in the world
};

// Six faces with outward normals; of an axis without thickness only the face towards plus. At most one axis
// may have none: the others give no area.
PlacedCatcher box_catcher(const glm::dvec3& lower, const glm::dvec3& upper);

// Two triangles; the corners run counter-clockwise as seen from the front.
PlacedCatcher quad_catcher(const std::array<glm::dvec3, 4>& corners);

// What is wrong with four corners (no area, not flat, not convex); empty when they are good.
std::optional<std::string> quad_problem(const std::array<glm::dvec3, 4>& corners);

}  // namespace herr
