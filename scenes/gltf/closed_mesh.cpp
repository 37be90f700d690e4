#include "scenes/gltf/closed_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

namespace herr {
namespace {

// Of the area^1.5 of a part; a ball has 0.094, a square sheet of a ten-thousandth of its side 3.5e-5. Less is
// no volume but rounding.
constexpr double kThinnest = 1e-7;

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

// Its ends in the order of their numbers, which way it is passed, and by which triangle.
struct PassedEdge {
  std::uint64_t ends;
  std::int32_t direction;
  std::uint32_t triangle;
};

// Of all triangles that have three places, sorted by their ends.
std::vector<PassedEdge> passed_edges(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> place = places_of(mesh.positions);
  std::vector<PassedEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const std::uint32_t corner[3] = {place[triangle[0]], place[triangle[1]], place[triangle[2]]};
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t a = corner[i], b = corner[(i + 1) % 3];
      edges.push_back({std::min(a, b) << 32 | std::max(a, b), a < b ? 1 : -1, static_cast<std::uint32_t>(t)});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const PassedEdge& a, const PassedEdge& b) { return a.ends < b.ends; });
  return edges;
}

// Calls visit(edges that have the same ends) for each, until one returns false.
template <typename Visit>
bool for_each_edge(std::span<PassedEdge> edges, const Visit& visit) {
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].ends == edges[i].ends) ++end;
    if (!visit(edges.subspan(i, end - i))) return false;
    i = end;
  }
  return true;
}

bool passed_both_ways(std::span<const PassedEdge> same) {
  std::int64_t balance = 0;
  for (const PassedEdge& edge : same) balance += edge.direction;
  return balance == 0;
}

bool all_passed_both_ways(std::span<PassedEdge> edges) {
  return !edges.empty() && for_each_edge(edges, passed_both_ways);
}

// Triangles that hang together by edges of two triangles.
class SurfaceParts {
 public:
  SurfaceParts(std::size_t triangles, std::span<PassedEdge> edges) : parent_(triangles) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    for_each_edge(edges, [&](std::span<const PassedEdge> same) {
      if (same.size() == 2) parent_[part_of(same[0].triangle)] = part_of(same[1].triangle);
      return true;
    });
  }
  std::uint32_t part_of(std::uint32_t triangle) {
    while (parent_[triangle] != triangle) {
      triangle = parent_[triangle] = parent_[parent_[triangle]];
    }
    return triangle;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// Is each part closed by itself? Edges where several parts meet are sorted by part.
bool parts_are_closed(std::span<PassedEdge> edges, SurfaceParts& parts) {
  return for_each_edge(edges, [&](std::span<PassedEdge> same) {
    if (same.size() == 2) return true;
    std::sort(same.begin(), same.end(), [&](const PassedEdge& a, const PassedEdge& b) {
      return parts.part_of(a.triangle) < parts.part_of(b.triangle);
    });
    for (std::size_t i = 0; i < same.size();) {
      std::size_t end = i + 1;
      while (end < same.size() && parts.part_of(same[end].triangle) == parts.part_of(same[i].triangle)) ++end;
      if (!passed_both_ways(same.subspan(i, end - i))) return false;
      i = end;
    }
    return true;
  });
}

// Signed volume of each part by the divergence theorem: tetrahedra over its triangles with their tip at one
// of its own corners.
bool parts_enclose_volume(const TriangleMesh& mesh, std::span<const PassedEdge> edges, SurfaceParts& parts) {
  struct Measure {
    double volume6 = 0, area2 = 0;
    bool used = false;
  };
  std::vector<Measure> measures(mesh.triangles.size());
  for (const PassedEdge& edge : edges) measures[edge.triangle].used = true;
  const auto corner = [&](std::uint32_t triangle, std::size_t i) {
    return glm::dvec3(mesh.positions[mesh.triangles[triangle][i]]);
  };
  for (std::uint32_t t = 0; t < measures.size(); ++t) {
    if (!measures[t].used) continue;
    const std::uint32_t part = parts.part_of(t);
    const glm::dvec3 tip = corner(part, 0), a = corner(t, 0);
    const glm::dvec3 normal = glm::cross(corner(t, 1) - a, corner(t, 2) - a);
    measures[part].volume6 += glm::dot(normal, a - tip);
    measures[part].area2 += glm::length(normal);
  }
  return std::all_of(measures.begin(), measures.end(), [](const Measure& part) {
    return part.area2 == 0 || part.volume6 / 6 > kThinnest * std::pow(part.area2 / 2, 1.5);
  });
}

}  // namespace

bool is_closed(const TriangleMesh& mesh) {
  std::vector<PassedEdge> edges = passed_edges(mesh);
  return all_passed_both_ways(edges);
}

bool is_closed_outwards(const TriangleMesh& mesh) {
  std::vector<PassedEdge> edges = passed_edges(mesh);
  if (!all_passed_both_ways(edges)) return false;
  SurfaceParts parts(mesh.triangles.size(), edges);
  return parts_are_closed(edges, parts) && parts_enclose_volume(mesh, edges, parts);
}

bool is_closed_inwards(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return false;
  double volume = 0;
  const glm::dvec3 from(mesh.positions.front());
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 a = glm::dvec3(mesh.positions[t[0]]) - from, b = glm::dvec3(mesh.positions[t[1]]) - from,
                     c = glm::dvec3(mesh.positions[t[2]]) - from;
    volume += glm::dot(a, glm::cross(b, c));
  }
  return volume < 0 && is_closed(mesh);
}

}  // namespace herr
