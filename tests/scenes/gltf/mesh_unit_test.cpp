// Object space may count in anything: what a mesh and its node make together is what is judged and shown.
#include "scenes/gltf/mesh_unit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

// The triangle with legs of `leg`, float.
std::filesystem::path write_legs(const TemporaryFolder& folder, float leg, double node_scale) {
  json document = triangle_document();
  document["nodes"][0]["scale"] = {node_scale, node_scale, node_scale};
  folder.write("triangle.bin",
               bytes_of<float>({0, 0, 0, leg, 0, 0, 0, leg, 0}) + bytes_of<std::uint16_t>({0, 1, 2, 0}));
  return folder.write("model.gltf", document.dump());
}

// As packers write it: integers of 14 bits, four to a vertex, and a node that makes 6 cm of them. The
// determinant of its matrix is (0.06 / 16383)^3 = 4.9e-17.
TEST(MeshUnitTest, SmallThingsOfLargeIntegersAreShownAtTheirSize) {
  const TemporaryFolder folder;
  json document = triangle_document();
  document["extensionsUsed"] = document["extensionsRequired"] = {"KHR_mesh_quantization"};
  document["accessors"][0]["componentType"] = 5123;
  document["bufferViews"][0] = {{"buffer", 0}, {"byteLength", 24}, {"byteStride", 8}};
  document["bufferViews"][1]["byteOffset"] = 24;
  document["buffers"][0]["byteLength"] = 32;
  const double scale = 0.06 / 16383;
  document["nodes"][0]["scale"] = {scale, scale, scale};
  document["nodes"][0]["translation"] = {0, 0, -0.3};
  folder.write("triangle.bin", bytes_of<std::uint16_t>({0, 0, 0, 0, 16383, 0, 0, 0, 0, 16383, 0, 0}) +
                                   bytes_of<std::uint16_t>({0, 1, 2, 0}));
  const Scene scene = load_scene(folder.write("model.gltf", document.dump()));
  const Bounds box = scene_bounds(scene);
  EXPECT_NEAR(box.upper.x, 0.06, 1e-15);
  EXPECT_NEAR(box.upper.y, 0.06, 1e-15);
  EXPECT_EQ(box.lower.z, -0.3);
}

// A factor of two is exact in float and double: what is shown is bit for bit what the file says.
TEST(MeshUnitTest, MeshesOfAnyUnitCountNearOneAndAreShownAsTheFileSays) {
  for (const auto& [leg, node_scale] :
       {std::pair{1e-6f, 1.0}, {1e-20f, 1e12}, {1e11f, 1e-12}, {3e9f, 1e-3}}) {
    const TemporaryFolder folder;
    const Scene scene = load_scene(write_legs(folder, leg, node_scale));
    ASSERT_EQ(scene.instances.size(), 1u);
    float farthest = 0;
    for (const glm::vec3& p : scene.meshes[0].positions) farthest = std::max(farthest, p.x);
    EXPECT_GE(farthest, 1.0f) << leg;
    EXPECT_LT(farthest, 2.0f) << leg;
    EXPECT_DOUBLE_EQ(scene_bounds(scene).upper.x, double{leg} * node_scale);
    EXPECT_EQ(scene.instances[0].placed_from_object[0], scene.instances[0].world_from_object[0]);
  }
}

// What needs no unit keeps its coordinates: from 2^-10 to below 2^20.
TEST(MeshUnitTest, UsualMeshesStayAsTheyAre) {
  for (const float leg : {0x1p-10f, 1.0f, 16383.0f, 1e6f}) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {leg, 0, 0}, {0, -leg, 0}};
    EXPECT_EQ(take_unit(mesh), 1.0) << leg;
    EXPECT_EQ(mesh.positions[1].x, leg);
  }
}

TEST(MeshUnitTest, WhatNoFloatHoldsIsRefusedWithItsNode) {
  const TemporaryFolder folder;
  // A determinant of 1e-39 beside coordinates of 1.
  EXPECT_TRUE(contains(error_of(write_legs(folder, 1, 1e-13)), "nodes[0] \"node\" flattens or shrinks"));
  EXPECT_TRUE(contains(error_of(write_legs(folder, 1, 0)), "scale of 0 on the x axis"));
}

}  // namespace
}  // namespace herr::test
