// Likenesses of a scene: what they keep, and which there are not.
#include "scenes/model/similar_scene.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace herr {
namespace {

// Everything that has a place or a length.
Scene some_scene() {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].attenuation.distance_m = 0.5f;
  Instance ball;
  ball.name = "ball";
  ball.kind = ShapeKind::sphere;
  ball.world_from_object = {glm::dvec3{0.25, 0, 0.5}, glm::dvec3{0, 2, 0}, glm::dvec3{-0.5, 0, 0.25},
                            glm::dvec3{1, 2, 3}};
  scene.instances.push_back(ball);
  AreaLight lamp;
  lamp.centre = {4, 5, 6};
  lamp.size = {0.5f, 0.25f, 1.0f};
  lamp.intensity_w_sr = {8, 4, 2};
  lamp.range_m = 16;
  AreaLight sun;
  sun.kind = LightKind::sun;
  sun.direction = {0, 0, -1};
  sun.intensity_w_sr = {3, 2, 1};
  scene.lights = {lamp, sun};
  scene.probes = {{4, 5, 6}, Bounds{{-1, -2, -3}, {2, 4, 8}}};
  scene.world_from_session.position = {0.5, 0, -0.5};
  return scene;
}

void expect_same(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.instances[0].world_from_object, b.instances[0].world_from_object);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(a.lights[i].centre, b.lights[i].centre);
    EXPECT_EQ(a.lights[i].size, b.lights[i].size);
    EXPECT_EQ(a.lights[i].direction, b.lights[i].direction);
    EXPECT_EQ(a.lights[i].intensity_w_sr, b.lights[i].intensity_w_sr);
    EXPECT_EQ(a.lights[i].range_m, b.lights[i].range_m);
  }
  EXPECT_EQ(a.materials[0].attenuation.distance_m, b.materials[0].attenuation.distance_m);
  EXPECT_EQ(a.probes.counts, b.probes.counts);
  EXPECT_EQ(a.probes.box->lower, b.probes.box->lower);
  EXPECT_EQ(a.probes.box->upper, b.probes.box->upper);
  EXPECT_EQ(a.environment_map.turn_deg, b.environment_map.turn_deg);
  EXPECT_EQ(a.world_from_session.position, b.world_from_session.position);
  // Either sign is the same rotation; four products of quaternions round.
  const double cosine =
      std::abs(glm::dot(a.world_from_session.orientation, b.world_from_session.orientation));
  EXPECT_NEAR(cosine, 1, 1e-15);
}

TEST(SimilarSceneTest, FourQuarterTurnsAboutAnyAxisAreNone) {
  for (int axis = 0; axis < 3; ++axis) {
    Similarity quarter;
    quarter.turn = quarter_turn(axis);
    Scene scene = some_scene();
    for (int i = 0; i < 3; ++i) {
      scene = similar_scene(std::move(scene), quarter);
      EXPECT_NE(scene.instances[0].world_from_object, some_scene().instances[0].world_from_object);
    }
    expect_same(similar_scene(std::move(scene), quarter), some_scene());
  }
}

// About z, counter-clockwise as seen from +z: x goes to y, y to -x. Extents along x and y change places.
TEST(SimilarSceneTest, AQuarterTurnTakesPlacesDirectionsAndExtentsAlong) {
  Similarity quarter;
  quarter.turn = quarter_turn(2);
  const Scene turned = similar_scene(some_scene(), quarter);
  EXPECT_EQ(turned.lights[0].centre, (glm::dvec3{-5, 4, 6}));
  EXPECT_EQ(turned.lights[0].size, (glm::vec3{0.25f, 0.5f, 1.0f}));
  EXPECT_EQ(turned.instances[0].world_from_object[3], (glm::dvec3{-2, 1, 3}));
  EXPECT_EQ(turned.probes.counts, (std::array<int, 3>{5, 4, 6}));
  EXPECT_EQ(turned.probes.box->lower, (glm::dvec3{-4, -1, -3}));
  EXPECT_EQ(turned.probes.box->upper, (glm::dvec3{2, 2, 8}));
}

// The middle of the picture lies towards -Z; counter-clockwise as seen from above -Z goes to -X, where the
// middle lies at 90 degrees.
TEST(SimilarSceneTest, AnEnvironmentPictureTurnsAboutUpAlone) {
  Scene scene = some_scene();
  scene.environment_map.width_px = scene.environment_map.height_px = 1;
  scene.environment_map.rgba.assign(4, 1.0f);
  scene.environment_map.turn_deg = 300;
  Similarity turn;
  turn.turn = quarter_turn(1);
  EXPECT_EQ(turn.turn * glm::dvec3(0, 0, -1), (glm::dvec3{-1, 0, 0}));
  EXPECT_EQ(why_not_similar(scene, turn), "");
  EXPECT_EQ(similar_scene(scene, turn).environment_map.turn_deg, 30);
  for (const int axis : {0, 2}) {
    turn.turn = quarter_turn(axis);
    EXPECT_NE(why_not_similar(scene, turn).find("turns about the up axis alone"), std::string::npos);
    EXPECT_EQ(why_not_similar(some_scene(), turn), "");
  }
}

// At half the size a lamp of a quarter of the intensity gives what the large one gave, and so does the sun.
TEST(SimilarSceneTest, AScaledSceneKeepsItsRadiance) {
  Similarity half;
  half.scale = 0.5;
  const Scene small = similar_scene(some_scene(), half);
  EXPECT_EQ(small.lights[0].intensity_w_sr, (glm::vec3{2, 1, 0.5f}));
  EXPECT_EQ(small.lights[0].range_m, 8);
  EXPECT_EQ(small.lights[0].size, (glm::vec3{0.25f, 0.125f, 0.5f}));
  EXPECT_EQ(small.lights[1].intensity_w_sr, (glm::vec3{3, 2, 1}));
  EXPECT_EQ(small.materials[0].attenuation.distance_m, 0.25f);
  Similarity twice;
  twice.scale = 2;
  expect_same(similar_scene(small, twice), some_scene());
}

TEST(SimilarSceneTest, WhatBecomesTooSmallOrIsNoQuarterTurnIsSaid) {
  Similarity tiny;
  tiny.scale = 1e-13;
  EXPECT_NE(why_not_similar(some_scene(), tiny).find("instance 'ball' then"), std::string::npos);
  Similarity eighth;
  eighth.turn = {glm::dvec3{0.6, 0.8, 0}, glm::dvec3{-0.8, 0.6, 0}, glm::dvec3{0, 0, 1}};
  EXPECT_THROW(similar_scene(some_scene(), eighth), std::invalid_argument);
}

}  // namespace
}  // namespace herr
