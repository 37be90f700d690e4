// Likenesses of a small case look the same, and one whose places were rounded before the anchor was taken off
// them does not.
#include <gtest/gtest.h>

#include "server/study/relations/picture_distance.h"
#include "server/study/relations/place/similar_case.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "tests/server/study/relations/light/lit_case.h"

namespace herr {
namespace {

const RelationResult* named(const RelationLog& log, const std::string& name) {
  for (const RelationResult& result : log.results()) {
    if (result.relation.name == name) return &result;
  }
  return nullptr;
}

TEST(PlaceRelationsTest, HoldOnASmallScene) {
  RelationLog log;
  measure_place(test::case_of(test::lit_scene()), log);
  for (const RelationResult& result : log.results()) {
    EXPECT_TRUE(result.asked()) << result.relation.name << ": " << result.not_applicable;
    EXPECT_TRUE(result.holds()) << result.relation.name << ": " << result.error << " " << result.where;
  }
}

TEST(PlaceRelationsTest, WhatCannotBeTurnedIsSaid) {
  Scene scene = test::lit_scene();
  scene.environment_map.width_px = 2, scene.environment_map.height_px = 1;
  scene.environment_map.rgba = {1, 0, 0, 1, 0, 1, 0, 1};
  RelationLog log;
  measure_place(test::case_of(std::move(scene)), log);
  for (const char* axis : {"x", "z"}) {
    const RelationResult* turned = named(log, std::string("turned by 90 degrees about ") + axis);
    ASSERT_NE(turned, nullptr);
    EXPECT_NE(turned->not_applicable.find("about the up axis alone"), std::string::npos);
  }
  for (const char* name : {"turned by 90 degrees about y", "turned by 90 degrees, soft light"}) {
    ASSERT_NE(named(log, name), nullptr);
    EXPECT_TRUE(named(log, name)->asked());
    EXPECT_TRUE(named(log, name)->holds()) << name << ": " << named(log, name)->error;
  }
}

// Floats at 1e6 m lie 0.06 m apart: things stand a pixel and more beside their places.
TEST(PlaceRelationsTest, ADroppedAnchorIsSeen) {
  const RelationCase subject = hard_light(test::case_of(test::lit_scene()));
  Similarity similarity;
  similarity.move = {801000.5, 267000.3, -534000.7};
  RelationCase moved = similar_case(subject, similarity);
  const std::vector<LinearPicture> here = picture_of(subject);
  EXPECT_LE(share_beyond_one_step(picture_of(moved), here, subject.profile).error, 1e-3);
  for (Instance& instance : moved.scene.instances) {
    instance.world_from_object[3] = glm::dvec3(glm::vec3(instance.world_from_object[3]));
  }
  EXPECT_GT(share_beyond_one_step(picture_of(moved), here, subject.profile).error, 1e-2);
}

// Lights keep their metres where everything else shrinks: a range that ends beyond the scene, brighter light.
TEST(PlaceRelationsTest, ALengthThatDoesNotScaleIsSeen) {
  const RelationCase subject = hard_light(test::case_of(test::lit_scene()));
  Similarity similarity;
  similarity.scale = 1e-2;
  RelationCase small = similar_case(subject, similarity);
  small.state.lights[0].centre.y += 0.003;  // 0.3 m of the whole
  EXPECT_GT(share_beyond_one_step(picture_of(small), picture_of(subject), subject.profile).error, 1e-2);
}

TEST(PlaceRelationsTest, AHeadThatWouldStandTooFarAwayIsSaid) {
  RelationCase subject = test::case_of(test::lit_scene());
  subject.sample.head.world_from_head.position = {2e4, 0, 0};
  Similarity similarity;
  similarity.scale = 1e5;
  EXPECT_NE(why_not_similar(subject, similarity).find("beyond 1e9 m"), std::string::npos);
}

}  // namespace
}  // namespace herr
