// Triangles of a glTF file -> a grid: every voxel that a triangle touches, in the mean base colour of what
// touches it. Surfaces become closed shells, one or two voxels thick; the inside stays empty.
// Before: scene_document_voxels. Uses: gltf/load_gltf, triangle_voxels. After: Scene::voxel_grids.
#pragma once

#include <filesystem>

#include "scenes/model/scene.h"

namespace herr {

struct VoxelisedMesh {
  std::uint32_t grid = 0;
  glm::dmat4x3 gltf_from_grid{1.0};  // metres of the file from voxels
};

// Appends the grid; `resolution` voxels along the longest side of the file's box, 1 ... kMaxMeshResolution.
// Throws InputError.
VoxelisedMesh append_voxelised_mesh(const std::filesystem::path& gltf_file, int resolution, Scene& scene);

}  // namespace herr
