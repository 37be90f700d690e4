// Relations of odd triangles hold on a small scene, and each sees a renderer that cannot take them.
#include <gtest/gtest.h>

#include "server/study/relations/relation_groups.h"
#include "tests/server/study/relations/lit_room.h"

namespace herr {
namespace {

const std::vector<std::string> kAll{
    "duplicate triangles",       "triangles without area",    "a corner 1e8 m away", "needles",
    "a floor 1e6 times as wide", "a floor 1e8 times as wide", "voxels of 1e-4 m",    "voxels of 1e4 m"};

TEST(TrianglesRelationsTest, HoldOnASmallScene) {
  RelationLog log;
  measure_triangles(test::lit_room(), log);
  std::vector<std::string> names;
  for (const RelationResult& result : log.results()) {
    names.push_back(result.relation.name);
    EXPECT_TRUE(result.asked()) << result.relation.name << ": " << result.not_applicable;
  }
  EXPECT_EQ(names, kAll);
  EXPECT_EQ(test::broken(log), std::vector<std::string>{});
}

// In the dark wherever the scene is not the one that it was, or its floor is more than 1e5 m wide.
std::vector<LinearPicture> drawn_with_fault(const RelationCase& subject) {
  const Scene plain = test::lit_room().scene;
  bool odd = subject.scene.instances[0].world_from_object != plain.instances[0].world_from_object;
  for (std::size_t i = 0; i < plain.meshes.size(); ++i)
    odd |= subject.scene.meshes[i].triangles.size() != plain.meshes[i].triangles.size();
  for (const glm::vec3& p : subject.scene.meshes.back().positions) odd |= std::abs(p.x) > 1e5f;
  RelationCase drawn = subject;
  if (odd) drawn.state.lights.clear();
  return picture_of(drawn);
}

TEST(TrianglesRelationsTest, EachSeesARendererThatCannotTakeThem) {
  RelationLog log;
  measure_triangles_by(drawn_with_fault, test::lit_room(), log);
  EXPECT_EQ(test::broken(log), kAll);
}

TEST(TrianglesRelationsTest, WhatASceneHasNotIsNotAsked) {
  RelationCase subject = test::lit_room();
  for (std::size_t i : {0u, 1u, 2u}) subject.scene.instances[i].kind = ShapeKind::sphere;
  RelationLog log;
  measure_triangles(subject, log);
  ASSERT_EQ(log.results().size(), kAll.size());
  for (std::size_t i : {0u, 1u, 2u, 3u})
    EXPECT_EQ(log.results()[i].not_applicable, "no instance is a mesh") << kAll[i];
  EXPECT_TRUE(log.results()[4].asked());
  for (std::size_t i : {6u, 7u})
    EXPECT_EQ(log.results()[i].not_applicable, "no instance is a grid of voxels") << kAll[i];
}

TEST(TrianglesRelationsTest, VoxelsThatNoSettingsFitAreNotAsked) {
  // From 0.1 m to 1e4 m every length grows 1e5 times, and 1e5 m of reach would be 1e10 m.
  RelationCase subject = test::lit_room();
  subject.settings.occlusion_radius_m = 1e5;
  RelationLog log;
  measure_triangles(subject, log);
  ASSERT_EQ(log.results().size(), kAll.size());
  EXPECT_TRUE(log.results()[6].asked());
  EXPECT_NE(log.results()[7].not_applicable.find("occlusion radius must lie in"), std::string::npos);
}

}  // namespace
}  // namespace herr
