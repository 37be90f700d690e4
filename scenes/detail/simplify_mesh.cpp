#include "scenes/detail/simplify_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <utility>

namespace herr {
namespace {

constexpr float kAnyError = 1.0f;         // relative to the mesh's extent
constexpr double kWorthwhileShare = 0.8;  // of the triangles of the level before: else it is no new level

// The mesh of these indices, with the vertices that they use.
TriangleMesh with_indices(const TriangleMesh& mesh, const std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> place(mesh.positions.size());
  const std::size_t used =
      meshopt_optimizeVertexFetchRemap(place.data(), indices.data(), indices.size(), place.size());
  TriangleMesh out;
  out.name = mesh.name;
  const auto moved = [&](const auto& from, auto& to) {
    if (from.empty()) return;
    to.resize(used);
    for (std::size_t i = 0; i < place.size(); ++i) {
      if (place[i] < used) to[place[i]] = from[i];
    }
  };
  moved(mesh.positions, out.positions);
  moved(mesh.normals, out.normals);
  moved(mesh.tangents, out.tangents);
  moved(mesh.uvs, out.uvs);
  for (const auto& set : mesh.more_uvs) moved(set, out.more_uvs.emplace_back());
  moved(mesh.colours, out.colours);
  out.closed = mesh.closed;
  out.triangles.resize(indices.size() / 3);
  for (std::size_t i = 0; i < indices.size(); ++i) out.triangles[i / 3][i % 3] = place[indices[i]];
  return out;
}

}  // namespace

std::vector<SimplifiedMesh> simplified_meshes(const TriangleMesh& mesh) {
  std::vector<SimplifiedMesh> levels;
  if (mesh.triangles.size() < 2 * kFewestTriangles) return levels;
  const std::uint32_t* indices = mesh.triangles.front().data();
  const float* positions = &mesh.positions.front().x;
  constexpr std::size_t kStride = sizeof(glm::vec3);
  const float extent_m = meshopt_simplifyScale(positions, mesh.positions.size(), kStride);
  const std::size_t count = 3 * mesh.triangles.size();
  std::size_t before = mesh.triangles.size(), wanted = before / 2;
  std::vector<std::uint32_t> kept(count);
  while (levels.size() < kMostDetailLevels && wanted >= kFewestTriangles) {
    float error = 0;
    kept.resize(count);
    kept.resize(meshopt_simplify(kept.data(), indices, count, positions, mesh.positions.size(), kStride,
                                 3 * wanted, kAnyError, 0, &error));
    const std::size_t triangles = kept.size() / 3;
    if (triangles == 0 || static_cast<double>(triangles) > kWorthwhileShare * static_cast<double>(before)) {
      break;
    }
    const float at_least = levels.empty() ? 0.0f : levels.back().error_m;
    levels.push_back({with_indices(mesh, kept), std::max(error * extent_m, at_least)});
    before = triangles;
    wanted = triangles / 2;
  }
  return levels;
}

void add_coarser_meshes(Scene& scene, std::uint32_t mesh) {
  if (!scene.meshes[mesh].coarser.empty()) return;
  std::vector<CoarserMesh> coarser;
  for (SimplifiedMesh& level : simplified_meshes(scene.meshes[mesh])) {
    coarser.push_back({static_cast<std::uint32_t>(scene.meshes.size()), level.error_m});
    scene.meshes.push_back(std::move(level.mesh));
  }
  scene.meshes[mesh].coarser = std::move(coarser);
}

}  // namespace herr
