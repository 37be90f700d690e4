#include "server/study/relations/light/surface_search.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

namespace herr {
namespace {

constexpr double kLeastAgreement = 0.7;
constexpr double kOffSurface = 1e-4;  // of the way to what is looked for

// Where the ray meets [-1, 1]^3 or another box, from outside.
std::optional<double> enters_box(const SearchRay& ray, const Bounds& box, int& axis_entered) {
  double near = -std::numeric_limits<double>::infinity(), far = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.lower[axis] - ray.origin[axis]) / ray.direction[axis],
                 b = (box.upper[axis] - ray.origin[axis]) / ray.direction[axis];
    if (std::min(a, b) > near) near = std::min(a, b), axis_entered = axis;
    far = std::min(far, std::max(a, b));
  }
  if (!(near <= far) || far < 0) return std::nullopt;
  return near;
}

void meet_triangles(const TriangleMesh& mesh, const SearchRay& ray, SeenSpot& spot, glm::dvec3& normal) {
  for (const auto& corners : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[corners[0]]);
    const glm::dvec3 u = glm::dvec3(mesh.positions[corners[1]]) - a,
                     v = glm::dvec3(mesh.positions[corners[2]]) - a;
    const glm::dvec3 n = glm::cross(u, v);
    const double facing = glm::dot(n, ray.direction);
    if (facing == 0) continue;
    const double t = glm::dot(n, a - ray.origin) / facing;
    if (!(t > 0 && t < spot.distance_m)) continue;
    // Barycentric coordinates by areas.
    const glm::dvec3 w = ray.origin + t * ray.direction - a;
    const double area2 = glm::dot(n, n);
    const double s = glm::dot(glm::cross(w, v), n) / area2, r = glm::dot(glm::cross(u, w), n) / area2;
    if (s < 0 || r < 0 || s + r > 1) continue;
    spot.distance_m = t, normal = n, spot.shaded_as_it_lies = true;
    if (mesh.normals.empty()) continue;
    glm::dvec3 bent = glm::dvec3(mesh.normals[corners[0]]) * (1 - s - r);
    bent += glm::dvec3(mesh.normals[corners[1]]) * s + glm::dvec3(mesh.normals[corners[2]]) * r;
    spot.shaded_as_it_lies = glm::dot(bent, n) > kLeastAgreement * std::sqrt(area2) * glm::length(bent);
  }
}

void meet_shape(ShapeKind kind, const SearchRay& ray, SeenSpot& spot, glm::dvec3& normal) {
  if (kind == ShapeKind::sphere) {
    const double a = glm::dot(ray.direction, ray.direction), b = glm::dot(ray.origin, ray.direction),
                 c = glm::dot(ray.origin, ray.origin) - 1, square = b * b - a * c;
    if (square < 0) return;
    const double t = (-b - std::sqrt(square)) / a;
    if (t > 0 && t < spot.distance_m)
      spot.distance_m = t, normal = ray.origin + t * ray.direction, spot.shaded_as_it_lies = true;
    return;
  }
  int axis = 0;
  const auto t = enters_box(ray, {glm::dvec3(-1), glm::dvec3(1)}, axis);
  if (!t || !(*t > 0 && *t < spot.distance_m)) return;
  spot.distance_m = *t, normal = glm::dvec3(0), normal[axis] = 1, spot.shaded_as_it_lies = true;
}

// By small steps: some voxel, and the face through which the ray came to it.
void meet_voxels(const VoxelGrid& grid, const SearchRay& ray, SeenSpot& spot, glm::dvec3& normal) {
  constexpr double kStepsPerVoxel = 8;
  int axis = 0;
  const auto enters = enters_box(ray, {glm::dvec3(0), glm::dvec3(grid.counts)}, axis);
  if (!enters) return;
  const double step = 1 / (kStepsPerVoxel * glm::length(ray.direction));
  for (double t = std::max(*enters, 0.0) + 0.5 * step; t < spot.distance_m; t += step) {
    const glm::ivec3 voxel(glm::floor(ray.origin + t * ray.direction));
    if (glm::any(glm::lessThan(voxel, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(voxel, grid.counts)))
      return;
    if (grid.at(voxel) == 0) continue;
    const auto face = enters_box(ray, {glm::dvec3(voxel), glm::dvec3(voxel + 1)}, axis);
    spot.distance_m = face && *face > 0 ? *face : t;
    spot.shaded_as_it_lies = true;
    normal = glm::dvec3(0), normal[axis] = 1;
    return;
  }
}

Bounds box_of(const TriangleMesh& mesh) {
  Bounds box{glm::dvec3(std::numeric_limits<double>::infinity()),
             glm::dvec3(-std::numeric_limits<double>::infinity())};
  for (const glm::vec3& position : mesh.positions) {
    box.lower = glm::min(box.lower, glm::dvec3(position)),
    box.upper = glm::max(box.upper, glm::dvec3(position));
  }
  return box;
}

// Of the corners of a box that stands elsewhere.
Bounds box_around(const Bounds& box, const glm::dmat4x3& world_from_object) {
  Bounds around{glm::dvec3(std::numeric_limits<double>::infinity()),
                glm::dvec3(-std::numeric_limits<double>::infinity())};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 place = world_from_object * glm::dvec4(corner & 1 ? box.upper.x : box.lower.x,
                                                            corner & 2 ? box.upper.y : box.lower.y,
                                                            corner & 4 ? box.upper.z : box.lower.z, 1);
    around.lower = glm::min(around.lower, place), around.upper = glm::max(around.upper, place);
  }
  return around;
}

}  // namespace

SurfaceSearch::SurfaceSearch(const Scene& scene) : scene_(scene) {
  std::vector<Bounds> mesh_boxes;
  for (const TriangleMesh& mesh : scene.meshes) mesh_boxes.push_back(box_of(mesh));
  for (const Instance& instance : scene.instances) {
    boxes_.push_back(instance.kind == ShapeKind::mesh
                         ? box_around(mesh_boxes[instance.mesh], instance.world_from_object)
                         : instance_bounds(scene, instance));
  }
}

std::optional<SeenSpot> SurfaceSearch::first_along(const SearchRay& ray) const {
  SeenSpot spot;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Instance& instance = scene_.instances[i];
    int axis = 0;
    const auto enters = enters_box(ray, boxes_[i], axis);
    if (!instance.present || !enters || *enters > spot.distance_m) continue;
    const glm::dmat4 back = glm::inverse(glm::dmat4(instance.world_from_object));
    const SearchRay local{glm::dvec3(back * glm::dvec4(ray.origin, 1)),
                          glm::dvec3(back * glm::dvec4(ray.direction, 0))};
    glm::dvec3 normal(0);
    if (instance.kind == ShapeKind::mesh) {
      meet_triangles(scene_.meshes[instance.mesh], local, spot, normal);
    } else if (instance.kind == ShapeKind::voxels) {
      meet_voxels(scene_.voxel_grids[instance.grid], local, spot, normal);
    } else {
      meet_shape(instance.kind, local, spot, normal);
    }
    if (normal == glm::dvec3(0)) continue;
    spot.normal = glm::normalize(glm::dvec3(glm::transpose(back) * glm::dvec4(normal, 0)));
    if (glm::dot(spot.normal, ray.direction) > 0) spot.normal = -spot.normal;
  }
  if (!std::isfinite(spot.distance_m)) return std::nullopt;
  spot.place = ray.origin + spot.distance_m * ray.direction;
  return spot;
}

bool SurfaceSearch::is_open(const SeenSpot& spot, const glm::dvec3& place) const {
  const glm::dvec3 way = place - spot.place;
  const double distance_m = glm::length(way);
  const auto met =
      first_along({spot.place + kOffSurface * distance_m * spot.normal, way / std::max(distance_m, 1e-300)});
  return !met || met->distance_m > distance_m;
}

}  // namespace herr
