#include "scenes/gltf/closed_mesh.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <vector>

namespace herr {
namespace {

// For each vertex a number that all vertices at its place share.
std::vector<std::uint32_t> places_of(const std::vector<glm::vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size()), place(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    const glm::vec3& p = positions[i];
    return std::tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    place[order[i]] = same ? place[order[i - 1]] : static_cast<std::uint32_t>(i);
  }
  return place;
}

}  // namespace

bool is_closed(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return false;
  const std::vector<std::uint32_t> place = places_of(mesh.positions);
  // Its ends in the order of their numbers, and which way it is passed.
  struct Edge {
    std::uint64_t ends;
    int direction;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const std::uint32_t corner[3] = {place[triangle[0]], place[triangle[1]], place[triangle[2]]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t a = corner[i], b = corner[(i + 1) % 3];
      edges.push_back({std::min(a, b) << 32 | std::max(a, b), a < b ? 1 : -1});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  for (std::size_t i = 0; i < edges.size();) {
    int balance = 0;
    const std::uint64_t ends = edges[i].ends;
    for (; i < edges.size() && edges[i].ends == ends; ++i) balance += edges[i].direction;
    if (balance != 0) return false;
  }
  return !edges.empty();
}

}  // namespace herr
