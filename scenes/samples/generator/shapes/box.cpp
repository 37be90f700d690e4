#include "scenes/samples/generator/shapes/box.h"

#include <glm/geometric.hpp>

namespace herr::samples {

Mesh quad(const std::array<glm::vec3, 4>& corners, const glm::vec2& repeat) {
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
  constexpr std::array<glm::vec2, 4> kUv{glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)};
  Mesh mesh;
  for (std::size_t i = 0; i < 4; ++i) add_vertex(mesh, {corners[i], normal, kUv[i] * repeat});
  add_triangle(mesh, 0, 1, 2);
  add_triangle(mesh, 0, 2, 3);
  return mesh;
}

Mesh box(const glm::vec3& lower, const glm::vec3& upper, float metres_per_picture) {
  Mesh mesh;
  const glm::vec3 size = upper - lower;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    for (const bool high : {false, true}) {
      glm::vec3 corner = lower, right(0.0f), up(0.0f);
      if (high) corner[axis] = upper[axis];
      // next x last points along +axis; the low side swaps them.
      right[high ? next : last] = size[high ? next : last];
      up[high ? last : next] = size[high ? last : next];
      const glm::vec2 repeat = glm::vec2(glm::length(right), glm::length(up)) / metres_per_picture;
      append(mesh, quad({corner, corner + right, corner + right + up, corner + up}, repeat), glm::mat4(1.0f));
    }
  }
  return mesh;
}

}  // namespace herr::samples
