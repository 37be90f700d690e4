#include "scenes/samples/generator/shapes/mesh_check.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace herr::samples {

namespace {

void require(bool holds, const std::string& name, const std::string& what) {
  if (!holds) throw std::runtime_error("generated mesh '" + name + "': " + what);
}

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void check_mesh(const std::string& name, const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  require(!mesh.triangles.empty(), name, "no triangles");
  require(mesh.normals.size() == count && mesh.uvs.size() == count, name, "arrays differ in length");
  for (std::size_t i = 0; i < count; ++i) {
    const std::string where = " at vertex " + std::to_string(i);
    require(finite(mesh.positions[i]), name, "position is not finite" + where);
    require(std::isfinite(mesh.uvs[i].x) && std::isfinite(mesh.uvs[i].y), name, "uv is not finite" + where);
    // A NaN fails the comparison as well.
    require(std::abs(glm::length(mesh.normals[i]) - 1.0f) < 1e-4f, name, "normal is not unit" + where);
  }
  std::size_t flat = 0, inside_out = 0;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t index : triangle) require(index < count, name, "index out of range");
    const glm::vec3 face = area_normal(mesh, triangle);
    const glm::vec3 mean = mesh.normals[triangle[0]] + mesh.normals[triangle[1]] + mesh.normals[triangle[2]];
    if (!(glm::length(face) > 0.0f)) {
      ++flat;
    } else if (glm::dot(face, mean) < 0.0f) {
      ++inside_out;
    }
  }
  require(flat * 100 <= mesh.triangles.size(), name, "more than 1 % of the triangles have no area");
  require(inside_out * 100 <= mesh.triangles.size(), name, "more than 1 % of the triangles are inside out");
}

double enclosed_volume_m3(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 p(mesh.positions[a]), q(mesh.positions[b]), r(mesh.positions[c]);
    volume += glm::dot(p, glm::cross(q, r)) / 6.0;
  }
  return volume;
}

}  // namespace herr::samples
