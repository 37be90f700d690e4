#include "server/study/relations/triangles/odd_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace herr {
namespace {

constexpr double kFarSizes = 1e6;  // of a mesh's own
constexpr double kFarCorner_m = 1e8;
constexpr double kNearest = 0x1p-10;  // of a triangle's height: how near a needle's vertex lies to an edge
constexpr double kFarthest = 0.125;   // beyond it is no needle any more
constexpr double kMostTilt = 0x1p-10;
constexpr std::size_t kMostDivided = 1'000'000;

bool bends(const Scene& scene, std::uint32_t mesh) {
  return std::any_of(scene.deformations.begin(), scene.deformations.end(),
                     [mesh](const MeshDeformation& deformation) { return deformation.mesh == mesh; });
}

// Share of each corner of a triangle.
using Shares = std::array<double, 3>;
using Corners = std::array<std::uint32_t, 3>;

// A sum of directions as shading has it: each is stored with |x| + |y| + |z| = 1.
glm::vec3 mean_direction(const std::array<glm::vec3, 3>& directions, const Shares& shares) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 d(directions[i]);
    const double length = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    if (length > 0) sum += shares[i] / length * d;
  }
  const double length = glm::length(sum);
  return length > 0 ? glm::vec3(sum / length) : directions[0];
}

template <typename T>
T mean_of(const std::vector<T>& values, const Corners& at, const Shares& shares) {
  T sum(0.0f);
  for (std::size_t i = 0; i < 3; ++i) sum += static_cast<float>(shares[i]) * values[at[i]];
  return sum;
}

// Appends a vertex that is what the triangle `at` is there, and lies at `position`. Returns its index.
std::uint32_t add_vertex(TriangleMesh& mesh, const glm::vec3& position, const Corners& at,
                         const Shares& shares) {
  const auto index = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back(position);
  mesh.normals.push_back(
      mean_direction({mesh.normals[at[0]], mesh.normals[at[1]], mesh.normals[at[2]]}, shares));
  if (!mesh.uvs.empty()) mesh.uvs.push_back(mean_of(mesh.uvs, at, shares));
  for (auto& set : mesh.more_uvs) set.push_back(mean_of(set, at, shares));
  if (!mesh.colours.empty()) mesh.colours.push_back(mean_of(mesh.colours, at, shares));
  if (!mesh.tangents.empty()) {
    const auto tangent = [&](std::size_t corner) { return glm::vec3(mesh.tangents[at[corner]]); };
    mesh.tangents.emplace_back(mean_direction({tangent(0), tangent(1), tangent(2)}, shares),
                               mesh.tangents[at[0]].w);
  }
  return index;
}

std::uint32_t add_copy(TriangleMesh& mesh, std::uint32_t of, const glm::vec3& position) {
  return add_vertex(mesh, position, {of, of, of}, {1, 0, 0});
}

void add_without_area(TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return;
  glm::vec3 lower = mesh.positions.front(), upper = lower;
  for (const glm::vec3& p : mesh.positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
  const glm::vec3 middle = 0.5f * lower + 0.5f * upper;
  const float size = glm::distance(lower, upper);
  const auto [a, b, c] = mesh.triangles[mesh.triangles.size() / 2];
  mesh.triangles.insert(mesh.triangles.end(), {{a, a, a}, {a, b, b}, {b, c, b}});
  for (int axis = 0; axis < 3; ++axis) {
    // Along one axis three places are on a line to the last bit.
    const auto along = [&, from = middle](float way) {
      glm::vec3 place = from;
      place[axis] += way;
      return add_copy(mesh, a, place);
    };
    const std::uint32_t near = along(0), far = along(static_cast<float>(kFarSizes) * size);
    mesh.triangles.push_back({along(-0.25f * size), near, along(0.25f * size)});
    mesh.triangles.push_back({near, far, far});
    mesh.triangles.push_back({near, along(size), far});
    mesh.triangles.push_back({far, far, far});
  }
  const std::uint32_t origin = add_copy(mesh, a, glm::vec3(0.0f)), right = add_copy(mesh, a, {1e-30f, 0, 0}),
                      up = add_copy(mesh, a, {0, 1e-30f, 0});
  mesh.triangles.push_back({origin, right, up});
}

// How far from its longest edge a triangle reaches, and the rounding of a place in it.
struct Extent {
  double height = 0, rounding = 0;
};
Extent extent_of(const std::array<glm::dvec3, 3>& p) {
  double longest = 0, largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    longest = std::max(longest, glm::distance(p[i], p[(i + 1) % 3]));
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(p[i][axis]));
  }
  const double area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
  return {longest > 0 ? area / longest : 0, std::sqrt(3.0) * 0x1p-24 * largest};
}

// Directions are stored with |x| + |y| + |z| = 1, which a mean of them keeps only where no component changes
// its sign.
template <typename T>
bool means_keep_length(const std::vector<T>& directions, const Corners& at) {
  if (directions.empty()) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const float a = directions[at[0]][axis], b = directions[at[1]][axis], c = directions[at[2]][axis];
    if (std::min({a, b, c}) < 0 && std::max({a, b, c}) > 0) return false;
  }
  return true;
}

void divide(TriangleMesh& mesh, std::size_t t) {
  const Corners at = mesh.triangles[t];
  if (!means_keep_length(mesh.normals, at) || !means_keep_length(mesh.tangents, at)) return;
  const std::array<glm::dvec3, 3> p{glm::dvec3(mesh.positions[at[0]]), glm::dvec3(mesh.positions[at[1]]),
                                    glm::dvec3(mesh.positions[at[2]])};
  const Extent extent = extent_of(p);
  if (!(extent.height > 0)) return;
  const double near = std::max(kNearest, extent.rounding / (kMostTilt * extent.height));
  if (near > kFarthest) return;
  Shares shares{};
  const std::size_t first = t % 3, second = (first + 1) % 3, third = (first + 2) % 3;
  if (t % 2 == 0) {
    shares[first] = near, shares[second] = 0.6 * (1 - near), shares[third] = 0.4 * (1 - near);
  } else {
    shares[first] = shares[second] = near, shares[third] = 1 - 2 * near;
  }
  const glm::dvec3 place = shares[0] * p[0] + shares[1] * p[1] + shares[2] * p[2];
  const std::uint32_t inner = add_vertex(mesh, glm::vec3(place), at, shares);
  mesh.triangles[t] = {at[0], at[1], inner};
  mesh.triangles.push_back({at[1], at[2], inner});
  mesh.triangles.push_back({at[2], at[0], inner});
}

}  // namespace

std::vector<std::uint32_t> rigid_meshes(const Scene& scene) {
  std::vector<std::uint32_t> meshes;
  for (const Instance& instance : scene.instances) {
    const bool shown = instance.present && instance.kind == ShapeKind::mesh;
    if (shown && !scene.meshes[instance.mesh].triangles.empty() && !bends(scene, instance.mesh))
      meshes.push_back(instance.mesh);
  }
  std::sort(meshes.begin(), meshes.end());
  meshes.erase(std::unique(meshes.begin(), meshes.end()), meshes.end());
  return meshes;
}

std::vector<std::uint32_t> solid_meshes(const Scene& scene) {
  std::vector<std::uint32_t> meshes = rigid_meshes(scene);
  for (const Instance& instance : scene.instances) {
    if (instance.kind != ShapeKind::mesh) continue;
    if (scene.materials[instance.material].alpha_mode == AlphaMode::blend) std::erase(meshes, instance.mesh);
  }
  return meshes;
}

void add_duplicates(Scene& scene) {
  for (const std::uint32_t index : solid_meshes(scene)) {
    auto& triangles = scene.meshes[index].triangles;
    const std::size_t count = triangles.size();
    triangles.reserve(2 * count);
    for (std::size_t t = 0; t < count; ++t) triangles.push_back(triangles[t]);
  }
}

void add_triangles_without_area(Scene& scene) {
  for (const std::uint32_t index : rigid_meshes(scene)) add_without_area(scene.meshes[index]);
}

void divide_into_needles(Scene& scene) {
  const std::vector<std::uint32_t> meshes = rigid_meshes(scene);
  std::size_t all = 0;
  for (const std::uint32_t index : meshes) all += scene.meshes[index].triangles.size();
  const std::size_t every = all / kMostDivided + 1;
  for (const std::uint32_t index : meshes) {
    const std::size_t count = scene.meshes[index].triangles.size();
    for (std::size_t t = 0; t < count; t += every) divide(scene.meshes[index], t);
  }
}

void add_far_corner(Scene& scene, const FarTriangle& triangle) {
  const std::vector<std::uint32_t> meshes = rigid_meshes(scene);
  // The finest of all: it has most to lose.
  const auto finest = std::max_element(meshes.begin(), meshes.end(), [&](std::uint32_t a, std::uint32_t b) {
    return scene.meshes[a].triangles.size() < scene.meshes[b].triangles.size();
  });
  if (finest == meshes.end()) return;
  const auto shown =
      std::find_if(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        return instance.present && instance.kind == ShapeKind::mesh && instance.mesh == *finest;
      });
  const glm::dmat4x3& m = shown->world_from_object;
  const glm::dmat3 object_from_world = glm::inverse(glm::dmat3(m[0], m[1], m[2]));
  // A mesh of its own, unless it is: other instances stand elsewhere, and theirs need not be behind the head.
  const auto all = std::count_if(
      scene.instances.begin(), scene.instances.end(),
      [&](const Instance& instance) { return instance.kind == ShapeKind::mesh && instance.mesh == *finest; });
  if (all > 1) {
    scene.meshes.push_back(TriangleMesh(scene.meshes[*finest]));
    shown->mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
  }
  TriangleMesh& mesh = scene.meshes[shown->mesh];
  const std::uint32_t like = mesh.triangles.front()[0];
  const auto corner = [&](const glm::dvec3& world) {
    return add_copy(mesh, like, glm::vec3(object_from_world * (world - m[3])));
  };
  const std::uint32_t a = corner(triangle.from),
                      b = corner(triangle.from + triangle.width_m * triangle.across),
                      c = corner(triangle.from + kFarCorner_m * triangle.away);
  mesh.triangles.push_back({a, b, c});
}

void add_floor(Scene& scene, const glm::dvec3& middle, double half_width_m) {
  TriangleMesh floor;
  floor.name = "floor";
  const double angle = 0.3;  // radians
  for (const auto& [x, z] : {std::pair{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}) {
    floor.positions.push_back(
        glm::vec3(half_width_m * glm::dvec3(x * std::cos(angle) + z * std::sin(angle), 0,
                                            z * std::cos(angle) - x * std::sin(angle))));
    floor.normals.emplace_back(0.0f, 1.0f, 0.0f);
  }
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  Material grey;
  grey.name = "grey";
  grey.base_colour = glm::vec3(0.5f);
  grey.roughness = 1.0f;
  Instance instance;
  instance.name = "floor";
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.material = static_cast<std::uint32_t>(scene.materials.size());
  instance.world_from_object[3] = middle;
  scene.meshes.push_back(std::move(floor));
  scene.materials.push_back(grey);
  scene.instances.push_back(std::move(instance));
}

}  // namespace herr
