// Voxels in scene documents: what an entry places, and what it refuses.
#include <gtest/gtest.h>

#include "scenes/load_scene.h"
#include "tests/scenes/voxels/vox_files.h"

namespace herr::test {
namespace {

using nlohmann::json;

std::filesystem::path write_scene(const TemporaryFolder& folder, const json& entry) {
  folder.write("one.vox", vox_bytes(vox_model(2, 2, 2, {{0, 0, 0, 1}, {1, 1, 1, 2}})));
  folder.write("grid.rgba8", std::string(4, '\xff'));
  folder.write("grid.voxels.json",
               R"({"format_version": 1, "counts": [1, 1, 1], "voxel_size_m": 0.5, "data": "grid.rgba8"})");
  write_model(folder, triangle_document());
  return folder.write("test.scene.json",
                      json{{"format_version", 1}, {"name", "test"}, {"voxels", {entry, entry}}}.dump());
}

Scene load(const json& entry) {
  const TemporaryFolder folder;
  return load_scene(write_scene(folder, entry));
}
std::string error_in(const json& entry) {
  const TemporaryFolder folder;
  return error_of(write_scene(folder, entry));
}

TEST(VoxelDocument, PlacesVoxFilesGridsAndMeshesAndReadsEachOnce) {
  for (const json& source : {json{{"file", "one.vox"}}, json{{"grid", "grid.voxels.json"}},
                             json{{"mesh", {{"file", "model.gltf"}, {"resolution", 8}}}}}) {
    const Scene scene = load(source);
    ASSERT_EQ(scene.instances.size(), 2u) << source;
    EXPECT_EQ(scene.voxel_grids.size(), 1u);
    for (const Instance& instance : scene.instances) {
      EXPECT_EQ(instance.kind, ShapeKind::voxels);
      EXPECT_EQ(instance.grid, 0u);
    }
  }
}

TEST(VoxelDocument, AVoxelOfAVoxFileIsATenthOfAMetre) {
  const Scene scene =
      load({{"file", "one.vox"}, {"scale", 2}, {"translation", {1, 0, 0}}, {"name", "cubes"}});
  // 2 voxels about the origin, 0.2 m each after the scale: from -0.2 to 0.2, moved by 1; on the ground.
  const Bounds box = instance_bounds(scene, scene.instances[0]);
  EXPECT_NEAR(box.lower.x, 0.8, 1e-12);
  EXPECT_NEAR(box.upper.x, 1.2, 1e-12);
  EXPECT_NEAR(box.lower.y, 0.0, 1e-12);
  EXPECT_NEAR(box.upper.y, 0.4, 1e-12);
  EXPECT_EQ(scene.instances[0].name, "cubes/model 0");
}

TEST(VoxelDocument, ABareVoxFileIsASceneWithALight) {
  const TemporaryFolder folder;
  const Scene scene = load_scene(folder.write("two.vox", vox_bytes(vox_model(1, 1, 1, {{0, 0, 0, 1}}))));
  EXPECT_EQ(scene.name, "two");
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_NEAR(scene_bounds(scene).upper.y, 0.1, 1e-12);
}

TEST(VoxelDocument, MaterialsChangeGlossAndNotColour) {
  const Scene scene =
      load({{"file", "one.vox"}, {"material", {{"metallic", 1}, {"roughness", 0.1}, {"mirror", 0.5}}}});
  const Material& material = scene.materials[scene.instances[0].material];
  EXPECT_EQ(material.mirror, 0.5f);
  EXPECT_EQ(material.base_colour, glm::vec3(1.0f));
}

TEST(VoxelDocument, RefusesWhatItCannotMean) {
  EXPECT_TRUE(contains(error_in({{"name", "x"}}), "needs one of file, grid and mesh"));
  EXPECT_TRUE(contains(error_in({{"file", "one.vox"}, {"grid", "grid.voxels.json"}}), "needs one of"));
  EXPECT_TRUE(contains(error_in({{"file", "../one.vox"}}), "not below the folder"));
  EXPECT_TRUE(contains(error_in({{"file", "absent.vox"}}), "does not exist"));
  EXPECT_TRUE(contains(error_in({{"file", "model.gltf"}}), "not a MagicaVoxel file"));
  EXPECT_TRUE(contains(error_in({{"mesh", {{"file", "model.gltf"}}}}), "resolution"));
  EXPECT_TRUE(contains(error_in({{"mesh", {{"file", "model.gltf"}, {"resolution", 513}}}}), "resolution"));
  EXPECT_TRUE(contains(error_in({{"file", "one.vox"}, {"scale", 1e-13}}), "scale"));
  EXPECT_TRUE(contains(error_in({{"file", "one.vox"}, {"material", {{"transmission", 1}}}}), "transmission"));
  EXPECT_TRUE(contains(error_in({{"file", "one.vox"}, {"size", 1}}), "size"));
}

}  // namespace
}  // namespace herr::test
