#include "scenes/samples/generator/shapes/grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace herr::samples {

Mesh grid_mesh(int columns, int rows, const std::function<Vertex(float u, float v)>& surface) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      add_vertex(mesh, surface(static_cast<float>(i) / static_cast<float>(columns),
                               static_cast<float>(j) / static_cast<float>(rows)));
    }
  }
  const auto width = static_cast<std::uint32_t>(columns) + 1;
  for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(rows); ++j) {
    for (std::uint32_t i = 0; i + 1 < width; ++i) {
      const std::uint32_t corner = j * width + i;
      add_triangle(mesh, corner, corner + 1, corner + width + 1);
      add_triangle(mesh, corner, corner + width + 1, corner + width);
    }
  }
  return mesh;
}

Mesh smooth_grid_mesh(int columns, int rows, const std::function<Vertex(float u, float v)>& surface) {
  return grid_mesh(columns, rows, [&](float u, float v) {
    Vertex vertex = surface(u, v);
    // Steps of 1e-3: far above float rounding of positions near 1 m, far below any curvature here. At a
    // pole one derivative vanishes, so the normal is taken a little inside.
    const float step = 1e-3f;
    const glm::vec2 at = glm::clamp(glm::vec2(u, v), glm::vec2(2.0f * step), glm::vec2(1.0f - 2.0f * step));
    const glm::vec3 du = surface(at.x + step, at.y).position - surface(at.x - step, at.y).position;
    const glm::vec3 dv = surface(at.x, at.y + step).position - surface(at.x, at.y - step).position;
    vertex.normal = glm::normalize(glm::cross(du, dv));
    return vertex;
  });
}

}  // namespace herr::samples
