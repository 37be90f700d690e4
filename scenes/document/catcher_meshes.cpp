#include "scenes/document/catcher_meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace herr {
namespace {

// Appends a flat quadrilateral whose corners run counter-clockwise as seen from the side of `normal`.
void append_quad(TriangleMesh& mesh, const std::array<glm::vec3, 4>& corners, const glm::vec3& normal) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const glm::vec3& corner : corners) {
    mesh.positions.push_back(corner);
    mesh.normals.push_back(normal);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

}  // namespace

PlacedCatcher box_catcher(const glm::dvec3& lower, const glm::dvec3& upper) {
  PlacedCatcher catcher;
  catcher.centre = 0.5 * (lower + upper);
  const glm::vec3 half(0.5 * (upper - lower));
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;  // u x v = axis
    for (const float side : {1.0f, -1.0f}) {
      if (side < 0 && half[axis] == 0) continue;
      if (half[u] == 0 || half[v] == 0) continue;
      glm::vec3 normal(0.0f), centre(0.0f), across(0.0f), up(0.0f);
      normal[axis] = side;
      centre[axis] = side * half[axis];
      across[u] = side * half[u];  // turned on the far side, so that the order stays counter-clockwise
      up[v] = half[v];
      append_quad(catcher.mesh,
                  {centre - across - up, centre + across - up, centre + across + up, centre - across + up},
                  normal);
    }
  }
  return catcher;
}

PlacedCatcher quad_catcher(const std::array<glm::dvec3, 4>& corners) {
  PlacedCatcher catcher;
  catcher.centre = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  const glm::dvec3 normal = glm::normalize(glm::cross(corners[2] - corners[0], corners[3] - corners[1]));
  std::array<glm::vec3, 4> local{};
  for (std::size_t i = 0; i < 4; ++i) local[i] = glm::vec3(corners[i] - catcher.centre);
  append_quad(catcher.mesh, local, glm::vec3(normal));
  return catcher;
}

std::optional<std::string> quad_problem(const std::array<glm::dvec3, 4>& corners) {
  // The cross product of the diagonals is twice the area, along the normal.
  const glm::dvec3 diagonal_a = corners[2] - corners[0], diagonal_b = corners[3] - corners[1];
  const glm::dvec3 cross = glm::cross(diagonal_a, diagonal_b);
  const double longest = std::max(glm::length(diagonal_a), glm::length(diagonal_b));
  if (!(glm::length(cross) > 1e-9 * longest * longest)) return "has no area";
  const glm::dvec3 normal = glm::normalize(cross);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 edge = corners[(i + 1) % 4] - corners[i];
    const glm::dvec3 next = corners[(i + 2) % 4] - corners[(i + 1) % 4];
    // One millimetre per metre: measured rooms are not exact, and the camera image hides what is less.
    if (std::abs(glm::dot(edge, normal)) > 1e-3 * longest) return "is not flat";
    if (glm::dot(glm::cross(edge, next), normal) <= 0)
      return "is not convex, or its corners are out of order";
  }
  return std::nullopt;
}

}  // namespace herr
