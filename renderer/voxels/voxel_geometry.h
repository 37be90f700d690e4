// One grid of voxels in Embree: a bottom-level scene with a user geometry of one primitive, the grid's box,
// whose callbacks traverse the octree. Before: Scene::voxel_grids. After: embree_scene instances it; surfaces
// reads what a hit says: Ng is the normal of the face by which the ray came in, the bits of u are the colour
// (three times 10 bits, square roots of linear light, R lowest). Where voxels cover a ray only in part, the
// share of rays that hit equals the coverage: each ray decides by a random number of its own.
#pragma once

#include <memory>

#include "renderer/embree/embree_device.h"
#include "renderer/voxels/voxel_octree.h"
#include "renderer/voxels/voxel_view.h"

namespace herr {

struct VoxelGeometry {
  std::unique_ptr<const VoxelOctree> octree;
  std::unique_ptr<const VoxelView> view;  // what the callbacks read
  EmbreeSceneHandle scene;                // committed
};

// `isa` is resolved; `grid` must outlive the geometry. Throws as check_embree.
VoxelGeometry build_voxels(const EmbreeDevice& device, Isa isa, const VoxelGrid& grid);

}  // namespace herr
