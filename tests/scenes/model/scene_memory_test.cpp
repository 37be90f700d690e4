// What a scene says that it holds grows by the bytes of what is put into it, each in its part.
#include "scenes/model/scene_memory.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <memory>

namespace herr {
namespace {

// 1000 vertices of position, normal and one pair of coordinates, 500 triangles.
TriangleMesh mesh_of_known_size() {
  TriangleMesh mesh;
  mesh.positions.resize(1000);
  mesh.normals.resize(1000);
  mesh.uvs.resize(1000);
  mesh.triangles.resize(500);
  return mesh;
}

TEST(SceneMemoryTest, AnEmptySceneHoldsNothing) {
  const SceneMemory memory = memory_of(Scene());
  EXPECT_EQ(memory.meshes + memory.textures + memory.voxels + memory.environment + memory.objects, 0);
}

TEST(SceneMemoryTest, EachPartGrowsByTheBytesOfWhatIsPutIntoIt) {
  Scene scene;
  scene.meshes.reserve(3), scene.textures.reserve(1), scene.voxel_grids.reserve(1);
  scene.deformations.reserve(1), scene.instances.reserve(1);
  SceneMemory before = memory_of(scene);
  const auto grown = [&](std::int64_t SceneMemory::*part) {
    const SceneMemory now = memory_of(scene);
    const std::int64_t by = now.*part - before.*part;
    std::int64_t all = 0;
    for (auto each : {&SceneMemory::meshes, &SceneMemory::textures, &SceneMemory::voxels,
                      &SceneMemory::environment, &SceneMemory::objects})
      all += now.*each - before.*each;
    EXPECT_EQ(all, by) << "another part grew too";
    before = now;
    return by;
  };
  // 12 + 12 + 8 bytes a vertex, 12 a triangle.
  scene.meshes.push_back(mesh_of_known_size());
  EXPECT_EQ(grown(&SceneMemory::meshes), 1000 * 32 + 500 * 12);
  // Colours are four floats, so are tangents; a second pair of coordinates has a vector of its own.
  scene.meshes.push_back(mesh_of_known_size());
  scene.meshes.back().colours.resize(1000);
  scene.meshes.back().tangents.resize(1000);
  scene.meshes.back().more_uvs.assign(1, std::vector<glm::vec2>(1000));
  EXPECT_EQ(grown(&SceneMemory::meshes),
            1000 * (32 + 16 + 16 + 8) + 500 * 12 + static_cast<std::int64_t>(sizeof(std::vector<glm::vec2>)));
  // A shape at rest, four joints of two bytes and weights of four a vertex, one target of 12.
  MeshDeformation bends;
  bends.rest_positions.resize(1000);
  bends.joints.resize(4000), bends.weights.resize(4000);
  bends.targets.resize(1);
  bends.targets[0].positions.resize(1000);
  scene.deformations.push_back(std::move(bends));
  EXPECT_EQ(grown(&SceneMemory::meshes),
            1000 * (12 + 4 * 2 + 4 * 4 + 12) + static_cast<std::int64_t>(sizeof(MorphTarget)));
  // 64 x 32 texels of four bytes.
  scene.textures.emplace_back();
  scene.textures[0].rgba.resize(64 * 32 * 4);
  EXPECT_EQ(grown(&SceneMemory::textures), 64 * 32 * 4);
  // 8 x 8 x 8 voxels are 2 x 2 x 2 blocks of a number each; one brick of 64 voxels.
  scene.voxel_grids.emplace_back();
  scene.voxel_grids[0].allocate({8, 8, 8});
  scene.voxel_grids[0].set({1, 2, 3}, ~0u);
  EXPECT_EQ(grown(&SceneMemory::voxels), 8 * 4 + 64 * 4);
  // 16 x 8 pixels of four floats.
  scene.environment_map.rgba.resize(16 * 8 * 4);
  EXPECT_EQ(grown(&SceneMemory::environment), 16 * 8 * 16);
}

TEST(SceneMemoryTest, WhatItSaysIsWhatTheHeapHasLost) {
  const auto heap = [] {
    const struct mallinfo2 now = mallinfo2();
    return static_cast<std::int64_t>(now.uordblks + now.hblkhd);
  };
  const std::int64_t before = heap();
  auto scene = std::make_unique<Scene>();
  for (int i = 0; i < 20; ++i) scene->meshes.push_back(mesh_of_known_size());
  scene->textures.resize(3);
  for (TextureImage& texture : scene->textures) texture.rgba.resize(256 * 256 * 4);
  scene->environment_map.rgba.resize(512 * 256 * 4);
  scene->instances.resize(1000);
  const auto taken = static_cast<double>(heap() - before);
  const SceneMemory memory = memory_of(*scene);
  const auto said = static_cast<double>(memory.meshes + memory.textures + memory.voxels + memory.environment +
                                        memory.objects);
  EXPECT_LE(said, taken);
  EXPECT_GE(said, 0.98 * taken) << "the scene itself and what the heap adds to each block";
}

}  // namespace
}  // namespace herr
