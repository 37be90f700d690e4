// A small case for relations: balls on a floor under a light, one of them of voxels, seen by both eyes.
// Before: test_scenes.h. After: tests of groups of relations.
#pragma once

#include "server/study/relations/relation.h"
#include "server/study/relations/relation_case.h"
#include "tests/renderer/test_scenes.h"

namespace herr::test {

inline VoxelGrid voxel_ball(int side) {
  VoxelGrid grid;
  grid.name = "ball";
  grid.allocate(glm::ivec3(side));
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const glm::dvec3 p = glm::dvec3(x, y, z) + 0.5 - 0.5 * side;
        if (glm::length(p) < 0.5 * side) grid.set({x, y, z}, 0xff40a0e0u);
      }
    }
  }
  return grid;
}

inline RelationCase lit_room() {
  RelationCase subject;
  Scene& scene = subject.scene;
  scene.name = "lit room";
  add(scene, floor_quad(4, -1), matte({0.5f, 0.4f, 0.3f}));
  add(scene, sphere({-0.6f, -0.4f, -3}, 0.6f, 12, 24), matte(glm::vec3{0.6f}));
  Instance voxels;
  voxels.name = "voxels";
  voxels.kind = ShapeKind::voxels;
  voxels.material = 1;
  voxels.world_from_object = glm::dmat4x3(0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1, 0.2, -1, -3);
  scene.voxel_grids.push_back(voxel_ball(10));
  scene.instances.push_back(voxels);
  scene.lights = {light_at({1, 2.5, -2}, glm::vec3{15.0f}, {0.5f, 0.25f, 0.5f})};
  scene.ambient = glm::vec3{0.05f};
  scene.environment = glm::vec3{0.2f};
  scene_state_at(scene, 0, subject.state);
  subject.sample = sample_from({0, 0, 0});
  subject.profile = small_profile(48, 60, 36);
  subject.settings = small_settings();
  return subject;
}

// Of all that were asked: those that do not hold.
inline std::vector<std::string> broken(const RelationLog& log) {
  std::vector<std::string> names;
  for (const RelationResult& result : log.results()) {
    if (!result.holds()) names.push_back(result.relation.name);
  }
  return names;
}

}  // namespace herr::test
