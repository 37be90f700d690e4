#include "server/study/relations/one_albedo.h"

#include <cstdint>

namespace herr {
namespace {

void whiten_voxels(VoxelGrid& grid) {
  for (VoxelGrid::Brick& brick : grid.bricks) {
    for (std::uint32_t& rgba : brick) {
      if (rgba >> 24 != 0) rgba |= 0xffffffu;
    }
  }
}

}  // namespace

RelationCase of_albedo(RelationCase subject, float albedo) {
  for (Material& material : subject.scene.materials) {
    Material matte;
    matte.name = material.name;
    matte.base_colour = glm::vec3{albedo};
    matte.refractive_index = 1;  // no highlight
    material = matte;
  }
  for (TriangleMesh& mesh : subject.scene.meshes) mesh.colours.clear();
  for (VoxelGrid& grid : subject.scene.voxel_grids) whiten_voxels(grid);
  return subject;
}

}  // namespace herr
