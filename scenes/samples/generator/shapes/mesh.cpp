#include "scenes/samples/generator/shapes/mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

namespace herr::samples {

std::uint32_t add_vertex(Mesh& mesh, const Vertex& vertex) {
  mesh.positions.push_back(vertex.position);
  mesh.normals.push_back(vertex.normal);
  mesh.uvs.push_back(vertex.uv);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

glm::vec3 area_normal(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  const glm::vec3 a = mesh.positions[triangle[0]];
  return glm::cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  // 1e-12 m2 is a square of one micrometre: only collapsed triangles are smaller.
  if (glm::length(area_normal(mesh, {a, b, c})) > 1e-12f) mesh.triangles.push_back({a, b, c});
}

void append(Mesh& object, const Mesh& part, const glm::mat4& object_from_part, const UvRect& rect) {
  const auto base = static_cast<std::uint32_t>(object.positions.size());
  const glm::mat3 linear(object_from_part);
  const glm::mat3 normal_matrix = glm::transpose(glm::inverse(linear));
  const bool mirrored = glm::determinant(linear) < 0.0f;
  for (std::size_t i = 0; i < part.positions.size(); ++i) {
    const glm::vec3 moved(object_from_part * glm::vec4(part.positions[i], 1.0f));
    const glm::vec2 uv = rect.lower + part.uvs[i] * (rect.upper - rect.lower);
    add_vertex(object, {moved, glm::normalize(normal_matrix * part.normals[i]), uv});
  }
  for (auto [a, b, c] : part.triangles) {
    if (mirrored) std::swap(b, c);
    object.triangles.push_back({base + a, base + b, base + c});
  }
}

void stand_on_ground(Mesh& mesh) {
  float lowest = std::numeric_limits<float>::max();
  for (const glm::vec3& p : mesh.positions) lowest = std::min(lowest, p.y);
  for (glm::vec3& p : mesh.positions) p.y -= lowest;
}

void compute_normals(Mesh& mesh) {
  std::fill(mesh.normals.begin(), mesh.normals.end(), glm::vec3(0.0f));
  for (const auto& triangle : mesh.triangles) {
    const glm::vec3 normal = area_normal(mesh, triangle);
    for (const std::uint32_t index : triangle) mesh.normals[index] += normal;
  }
  for (glm::vec3& normal : mesh.normals) {
    const float length = glm::length(normal);
    normal = length > 0.0f ? normal / length : glm::vec3(0.0f, 1.0f, 0.0f);
  }
}

}  // namespace herr::samples
