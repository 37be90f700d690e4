// Coarser forms of a triangle mesh, for objects that are small or far from the gaze. Before: a loaded mesh.
// After: Scene::meshes holds them, renderer/detail chooses one for each frame.
// Source: meshoptimizer's edge collapses by quadric error (Garland & Heckbert 1997).
#pragma once

#include <vector>

#include "scenes/model/scene.h"

namespace herr {

struct SimplifiedMesh {
  TriangleMesh mesh;  // its vertices are a subset of the original's, with their normals and uvs
  float error_m = 0;  // how far its surface lies from the original's, in object space
};

inline constexpr int kMostDetailLevels = 12;
inline constexpr std::size_t kFewestTriangles = 64;  // below this nothing is won

// Each with about half the triangles of the one before, all made from the original; the first is the first
// that is coarser. Ends where edges can no longer be collapsed. Pure.
std::vector<SimplifiedMesh> simplified_meshes(const TriangleMesh& mesh);

// Appends the coarser forms of a mesh to the scene and names them in it; nothing where it has some already.
void add_coarser_meshes(Scene& scene, std::uint32_t mesh);

}  // namespace herr
