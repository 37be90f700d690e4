#include "scenes/gltf/vertex_tangents.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

namespace herr {
namespace {

constexpr std::size_t kAlike = 0, kMirrored = 1;

// How the coordinates lie on a triangle.
struct Chart {
  glm::dvec3 along_u{0.0};  // unit; zero where the coordinates say nothing
  bool mirrored = false;
};

const std::vector<glm::vec2>& coordinates_of(const TriangleMesh& mesh, int uv_set) {
  return uv_set == 0 ? mesh.uvs : mesh.more_uvs[static_cast<std::size_t>(uv_set) - 1];
}

Chart chart_of(const TriangleMesh& mesh, const std::vector<glm::vec2>& uvs,
               const std::array<std::uint32_t, 3>& t) {
  const glm::dvec3 a(mesh.positions[t[0]]);
  const glm::dvec3 e = glm::dvec3(mesh.positions[t[1]]) - a, f = glm::dvec3(mesh.positions[t[2]]) - a;
  const glm::dvec2 p(uvs[t[0]]);
  const glm::dvec2 q = glm::dvec2(uvs[t[1]]) - p, r = glm::dvec2(uvs[t[2]]) - p;
  const double area = q.x * r.y - q.y * r.x;
  const glm::dvec3 along_u = (area < 0 ? -1.0 : 1.0) * (r.y * e - q.y * f);
  const double length = glm::length(along_u);
  if (area == 0 || !(length > 0) || !std::isfinite(length)) return {};
  // v points down in a picture: one that is not mirrored has a negative area in coordinates.
  return {along_u / length, area > 0};
}

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  const double lengths = glm::length(a) * glm::length(b);
  return lengths > 0 ? std::acos(std::clamp(glm::dot(a, b) / lengths, -1.0, 1.0)) : 0.0;
}

// Perpendicular to a unit normal; the same for the same normal.
glm::vec3 any_tangent(const glm::vec3& normal) {
  // The axis that the normal is farthest from, made perpendicular.
  const glm::vec3 size = glm::abs(normal);
  glm::vec3 axis(1, 0, 0);
  if (size.y < size.x && size.y <= size.z) axis = {0, 1, 0};
  if (size.z < size.x && size.z < size.y) axis = {0, 0, 1};
  return glm::normalize(axis - glm::dot(axis, normal) * normal);
}

template <typename T>
void repeat(std::vector<T>& values, std::size_t index) {
  if (!values.empty()) values.push_back(T(values[index]));
}

// A second vertex like `vertex`.
std::uint32_t add_twin(BuiltMesh& built, std::uint32_t vertex) {
  TriangleMesh& mesh = built.mesh;
  const auto twin = static_cast<std::uint32_t>(mesh.positions.size());
  repeat(mesh.positions, vertex);
  repeat(mesh.normals, vertex);
  repeat(mesh.uvs, vertex);
  for (auto& set : mesh.more_uvs) repeat(set, vertex);
  repeat(mesh.colours, vertex);
  repeat(built.sources, vertex);
  return twin;
}

// Gives triangles with mirrored coordinates vertices of their own; true per vertex of these. Triangles whose
// coordinates say nothing stay with the vertices that they have.
std::vector<bool> part_mirrored(BuiltMesh& built, const std::vector<Chart>& charts) {
  TriangleMesh& mesh = built.mesh;
  std::vector<std::array<bool, 2>> used(mesh.positions.size());
  for (std::size_t t = 0; t < charts.size(); ++t) {
    if (charts[t].along_u == glm::dvec3(0.0)) continue;
    for (const std::uint32_t vertex : mesh.triangles[t])
      used[vertex][charts[t].mirrored ? kMirrored : kAlike] = true;
  }
  std::vector<bool> mirrored(mesh.positions.size());
  std::vector<std::uint32_t> twins(mesh.positions.size());
  for (std::uint32_t vertex = 0; vertex < used.size(); ++vertex) {
    twins[vertex] = vertex;
    if (!used[vertex][kMirrored]) continue;
    if (used[vertex][kAlike]) {
      twins[vertex] = add_twin(built, vertex);
      mirrored.push_back(true);
    } else {
      mirrored[vertex] = true;
    }
  }
  for (std::size_t t = 0; t < charts.size(); ++t) {
    if (!charts[t].mirrored) continue;
    for (std::uint32_t& vertex : mesh.triangles[t]) vertex = twins[vertex];
  }
  return mirrored;
}

std::vector<Chart> charts_of(const TriangleMesh& mesh, int uv_set) {
  std::vector<Chart> charts;
  charts.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
    charts.push_back(chart_of(mesh, coordinates_of(mesh, uv_set), triangle));
  return charts;
}

// For each vertex the number of one that is at its place, with its normal, coordinates and handedness.
std::vector<std::uint32_t> shared_vertices(const TriangleMesh& mesh, int uv_set) {
  const std::vector<glm::vec2>& uvs = coordinates_of(mesh, uv_set);
  const auto key = [&](std::uint32_t i) {
    const glm::vec3 &p = mesh.positions[i], &n = mesh.normals[i];
    return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, uvs[i].x, uvs[i].y, mesh.tangents[i].w);
  };
  std::vector<std::uint32_t> order(mesh.positions.size()), shared(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple_cat(key(a), std::tuple(a)) < std::tuple_cat(key(b), std::tuple(b));
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    shared[order[i]] = same ? shared[order[i - 1]] : order[i];
  }
  return shared;
}

}  // namespace

void make_tangents(BuiltMesh& built, int uv_set) {
  TriangleMesh& mesh = built.mesh;
  const std::vector<bool> mirrored = part_mirrored(built, charts_of(mesh, uv_set));
  mesh.tangents.reserve(mirrored.size());
  for (const bool other_way : mirrored) mesh.tangents.emplace_back(0, 0, 0, other_way ? -1.0f : 1.0f);
  const std::vector<glm::vec3> directions = tangent_directions(mesh, uv_set);
  for (std::size_t i = 0; i < directions.size(); ++i)
    mesh.tangents[i] = glm::vec4(directions[i], mesh.tangents[i].w);
}

std::vector<glm::vec3> tangent_directions(const TriangleMesh& mesh, int uv_set) {
  const std::vector<Chart> charts = charts_of(mesh, uv_set);
  const std::vector<std::uint32_t> shared = shared_vertices(mesh, uv_set);
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (std::size_t t = 0; t < charts.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[t][corner];
      const glm::dvec3 at(mesh.positions[vertex]), normal(mesh.normals[vertex]);
      const glm::dvec3 across = charts[t].along_u - glm::dot(charts[t].along_u, normal) * normal;
      const double length = glm::length(across);
      if (length < 1e-6) continue;  // along the normal, but for rounding
      const glm::dvec3 next(mesh.positions[mesh.triangles[t][(corner + 1) % 3]]),
          last(mesh.positions[mesh.triangles[t][(corner + 2) % 3]]);
      sums[shared[vertex]] += angle_between(next - at, last - at) / length * across;
    }
  }
  std::vector<glm::vec3> directions;
  directions.reserve(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const glm::dvec3& sum = sums[shared[i]];
    const double length = glm::length(sum);
    directions.push_back(length > 1e-6 ? glm::vec3(sum / length) : any_tangent(mesh.normals[i]));
  }
  return directions;
}

}  // namespace herr
