// Clear glass the slow way, in double: every branch of the light's path through triangles is followed until
// it carries next to nothing. Shares nothing with the renderer's code.
// Before: a test has a mesh and what surrounds it. After: it compares pictures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numeric>
#include <vector>

#include "scenes/model/scene.h"

namespace herr::test {

// A body of glass in a surrounding that `outside(direction)` describes.
template <typename Outside>
class SlowGlass {
 public:
  static constexpr double kLeast = 2e-4;  // a branch that carries less is dropped

  SlowGlass(const TriangleMesh& mesh, double index, const Outside& outside)
      : mesh_(mesh), index_(index), outside_(outside), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, order_.size());
  }

  // Radiance along a ray that starts in air. `dropped` grows by the weight of what was not followed.
  glm::dvec3 radiance(const glm::dvec3& origin, const glm::dvec3& direction, double& dropped) const {
    return follow(origin, direction, 1.0, 0, dropped);
  }
  bool meets(const glm::dvec3& origin, const glm::dvec3& direction) const {
    return nearest(origin, direction).t < kFar;
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  struct Node {
    glm::dvec3 lower{kFar}, upper{-kFar};
    std::size_t first = 0, count = 0, right = 0;  // count 0: children are the next node and `right`
  };
  struct Hit {
    double t = kFar, u = 0, v = 0;
    std::size_t triangle = 0;
  };

  glm::dvec3 corner(std::size_t triangle, std::size_t i) const {
    return mesh_.positions[mesh_.triangles[triangle][i]];
  }

  std::size_t build(std::size_t first, std::size_t count) {
    const std::size_t at = nodes_.size();
    nodes_.emplace_back();
    Node node{.first = first, .count = count};
    for (std::size_t i = first; i < first + count; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        node.lower = glm::min(node.lower, corner(order_[i], c));
        node.upper = glm::max(node.upper, corner(order_[i], c));
      }
    }
    if (count > 4) {
      const glm::dvec3 size = node.upper - node.lower;
      const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
      const auto centre = [&](std::uint32_t t) {
        return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis];
      };
      const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
      std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2),
                       begin + static_cast<std::ptrdiff_t>(count),
                       [&](std::uint32_t a, std::uint32_t b) { return centre(a) < centre(b); });
      build(first, count / 2);
      node.right = build(first + count / 2, count - count / 2);
      node.count = 0;
    }
    nodes_[at] = node;
    return at;
  }

  // Moeller & Trumbore.
  void meet(std::size_t triangle, const glm::dvec3& origin, const glm::dvec3& direction, Hit& nearest) const {
    const glm::dvec3 a = corner(triangle, 0), e1 = corner(triangle, 1) - a, e2 = corner(triangle, 2) - a;
    const glm::dvec3 p = glm::cross(direction, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0) return;
    const glm::dvec3 s = (origin - a) / determinant, q = glm::cross(s, e1);
    const double u = glm::dot(s, p), v = glm::dot(direction, q), t = glm::dot(e2, q);
    if (u < 0 || v < 0 || u + v > 1 || t < 1e-7 || t >= nearest.t) return;
    nearest = {t, u, v, triangle};
  }

  Hit nearest(const glm::dvec3& origin, const glm::dvec3& direction) const {
    Hit hit;
    std::array<std::size_t, 64> stack{};
    for (std::size_t waiting = 1; waiting > 0;) {
      const std::size_t at = stack[--waiting];
      const Node& node = nodes_[at];
      const glm::dvec3 a = (node.lower - origin) / direction, b = (node.upper - origin) / direction;
      const glm::dvec3 near = glm::min(a, b), far = glm::max(a, b);
      const double in = std::max({near.x, near.y, near.z, 0.0}), out = std::min({far.x, far.y, far.z});
      if (in > out || in > hit.t) continue;
      for (std::size_t i = node.first; i < node.first + node.count; ++i)
        meet(order_[i], origin, direction, hit);
      if (node.count == 0) stack[waiting++] = node.right, stack[waiting++] = at + 1;
    }
    return hit;
  }

  glm::dvec3 follow(const glm::dvec3& origin, const glm::dvec3& d, double weight, int depth,
                    double& dropped) const {
    if (weight < kLeast || depth > 3000) {
      dropped += weight;
      return glm::dvec3{0.0};
    }
    const Hit hit = nearest(origin, d);
    if (hit.t == kFar) return weight * outside_(d);
    const auto& corners = mesh_.triangles[hit.triangle];
    glm::dvec3 g = glm::normalize(glm::cross(corner(hit.triangle, 1) - corner(hit.triangle, 0),
                                             corner(hit.triangle, 2) - corner(hit.triangle, 0)));
    glm::dvec3 n = glm::normalize((1 - hit.u - hit.v) * glm::dvec3(mesh_.normals[corners[0]]) +
                                  hit.u * glm::dvec3(mesh_.normals[corners[1]]) +
                                  hit.v * glm::dvec3(mesh_.normals[corners[2]]));
    const bool inside = glm::dot(g, d) > 0;
    if (inside) g = -g;
    if (glm::dot(n, g) < 0) n = -n;
    // Snell: n1 sin a = n2 sin b. Fresnel: both polarisations, from the two angles themselves.
    const double n1 = inside ? index_ : 1, n2 = inside ? 1 : index_;
    const double cos_a = std::clamp(-glm::dot(n, d), 0.0, 1.0), sin_a = std::sqrt(1 - cos_a * cos_a);
    const double sin_b = n1 / n2 * sin_a;
    const glm::dvec3 point = origin + hit.t * d;
    glm::dvec3 mirrored = d - 2 * glm::dot(d, n) * n;
    if (glm::dot(mirrored, g) <= 0) mirrored = d - 2 * glm::dot(d, g) * g;
    if (sin_b >= 1) return follow(point, mirrored, weight, depth + 1, dropped);
    const double cos_b = std::sqrt(1 - sin_b * sin_b);
    const double rs = (n1 * cos_a - n2 * cos_b) / (n1 * cos_a + n2 * cos_b);
    const double rp = (n2 * cos_a - n1 * cos_b) / (n2 * cos_a + n1 * cos_b);
    const double reflected = 0.5 * (rs * rs + rp * rp);
    glm::dvec3 through = n1 / n2 * d + (n1 / n2 * cos_a - cos_b) * n;
    if (glm::dot(through, g) >= 0) through = d;  // an interpolated normal's fault: straight on
    return follow(point, glm::normalize(through), weight * (1 - reflected), depth + 1, dropped) +
           follow(point, mirrored, weight * reflected, depth + 1, dropped);
  }

  const TriangleMesh& mesh_;
  double index_;
  Outside outside_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace herr::test
