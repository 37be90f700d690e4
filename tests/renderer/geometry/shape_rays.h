// Rays at the unit sphere and the box [-1, 1]^3 through Embree packets of any width, and the same crossings
// in double precision. Before: shape_geometry. After: the tests of shapes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <random>
#include <vector>

#include "renderer/geometry/shape_geometry.h"

namespace herr::test {

struct ShapeRay {
  glm::vec3 origin, direction;
};
struct ShapeHit {
  bool hit = false;
  float t = 0;
  glm::vec3 normal{0.0f};
};

// First and last crossing in double precision; `margin` is the discriminant of the sphere (over the squared
// radius), of the box the share of t by which the line stays inside (below 0: passes by).
struct ExactCrossing {
  double enter = 0, leave = 0, margin = -1;
};

inline ExactCrossing cross_sphere(const ShapeRay& ray) {
  const glm::dvec3 o(ray.origin), d(ray.direction);
  const double length2 = glm::dot(d, d), closest = -glm::dot(o, d) / length2;
  const glm::dvec3 l = o + closest * d;
  ExactCrossing exact;
  exact.margin = 1 - glm::dot(l, l);
  if (exact.margin < 0) return exact;
  const double half = std::sqrt(exact.margin / length2);
  const double larger = closest + std::copysign(half, closest);
  const double smaller = (glm::dot(o, o) - 1) / (length2 * larger);
  exact.enter = closest >= 0 ? smaller : larger;
  exact.leave = closest >= 0 ? larger : smaller;
  return exact;
}

inline ExactCrossing cross_box(const ShapeRay& ray) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  double enter = -kEndless, leave = kEndless;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis], d = ray.direction[axis];
    if (d == 0) {
      if (std::abs(o) > 1) return {kEndless, -kEndless, -1};
      continue;
    }
    const double a = (-1 - o) / d, b = (1 - o) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return {enter, leave, (leave - enter) / std::max(std::abs(enter), std::abs(leave))};
}

template <int kRays>
void trace_group(RTCScene scene, const ShapeRay* rays, std::size_t count, ShapeHit* hits, bool* occluded) {
  alignas(64) typename RayPacket<kRays>::RayHit packet{};
  alignas(64) typename RayPacket<kRays>::Ray shadow{};
  alignas(64) int valid[16] = {};
  for (std::size_t i = 0; i < count; ++i) {
    valid[i] = -1;
    auto& r = packet.ray;
    r.org_x[i] = rays[i].origin.x, r.org_y[i] = rays[i].origin.y, r.org_z[i] = rays[i].origin.z;
    r.dir_x[i] = rays[i].direction.x, r.dir_y[i] = rays[i].direction.y, r.dir_z[i] = rays[i].direction.z;
    r.tfar[i] = std::numeric_limits<float>::infinity();
    r.mask[i] = kAllMask;
    packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  shadow = packet.ray;
  intersect_packet<kRays>(valid, scene, false, &packet);
  occluded_packet<kRays>(valid, scene, &shadow);
  for (std::size_t i = 0; i < count; ++i) {
    hits[i].hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    hits[i].t = packet.ray.tfar[i];
    hits[i].normal = {packet.hit.Ng_x[i], packet.hit.Ng_y[i], packet.hit.Ng_z[i]};
    occluded[i] = shadow.tfar[i] < 0;
  }
}

struct TracedShapes {
  std::vector<ShapeHit> hits;
  std::int64_t disagreeing = 0;  // rays that occlusion sees otherwise than intersection
};

inline TracedShapes trace_shape(Isa isa, ShapeKind kind, const std::vector<ShapeRay>& rays) {
  const EmbreeDevice device(isa, 1);
  const EmbreeSceneHandle shape = build_shape(device, isa, kind);
  const std::size_t width = isa == Isa::avx512 ? 16 : isa == Isa::avx2 ? 8 : 4;
  TracedShapes traced;
  traced.hits.resize(rays.size());
  for (std::size_t first = 0; first < rays.size(); first += width) {
    const std::size_t count = std::min(width, rays.size() - first);
    bool occluded[16];
    ShapeHit* hits = &traced.hits[first];
    if (width == 16) trace_group<16>(shape.get(), &rays[first], count, hits, occluded);
    if (width == 8) trace_group<8>(shape.get(), &rays[first], count, hits, occluded);
    if (width == 4) trace_group<4>(shape.get(), &rays[first], count, hits, occluded);
    for (std::size_t i = 0; i < count; ++i) traced.disagreeing += occluded[i] != hits[i].hit;
  }
  return traced;
}

// Directions of any length between 1e-2 and 1e2; origins up to `farthest` from the centre, also within.
// Grazing rays pass within 1e-2 ... 1e-7 of the sphere's limb or of an edge of the box.
class ShapeRayMaker {
 public:
  explicit ShapeRayMaker(std::uint32_t seed) : random_(seed) {}

  ShapeRay random_ray(double farthest) {
    const glm::dvec3 from = unit() * std::pow(10.0, uniform(-1, std::log10(farthest)));
    return through(from, unit() * uniform(0, 2));
  }
  ShapeRay grazing_ray(ShapeKind kind, double farthest) {
    const double off = std::copysign(std::pow(10.0, uniform(-7, -2)), uniform(-1, 1));
    const glm::dvec3 side = unit();
    if (kind == ShapeKind::sphere) {
      const glm::dvec3 along = glm::normalize(glm::cross(side, unit()));
      const glm::dvec3 target = side * (1 + off);
      return through(target - along * std::pow(10.0, uniform(0, std::log10(farthest))), target);
    }
    // A point of an edge, moved outwards or inwards along the edge's diagonal, and a line that touches there.
    const int axis = static_cast<int>(uniform(0, 2.999));
    glm::dvec3 edge(0.0), diagonal(0.0), across(0.0);
    edge[axis] = uniform(-1, 1);
    const double u = std::copysign(1.0, side.x), v = std::copysign(1.0, side.y);
    diagonal[(axis + 1) % 3] = edge[(axis + 1) % 3] = u;
    diagonal[(axis + 2) % 3] = edge[(axis + 2) % 3] = v;
    across[(axis + 1) % 3] = -u * uniform(0.2, 1);
    across[(axis + 2) % 3] = v * uniform(0.2, 1);
    across[axis] = uniform(-1, 1);
    const glm::dvec3 target = edge + off * diagonal;
    return through(target - glm::normalize(across) * std::pow(10.0, uniform(0, std::log10(farthest))),
                   target);
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  glm::dvec3 unit() {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3{normal(random_), normal(random_), normal(random_)});
  }
  ShapeRay through(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    return {glm::vec3(from), glm::vec3(way / glm::length(way) * std::pow(10.0, uniform(-2, 2)))};
  }

  std::mt19937 random_;
};

}  // namespace herr::test
