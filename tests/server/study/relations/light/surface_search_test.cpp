// Rays find the nearest surface, and what lies between it and a place.
#include "server/study/relations/light/surface_search.h"

#include <gtest/gtest.h>

#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// A box from 1 m to 2 m above a floor: from the floor, open is what lies below it.
TEST(SurfaceSearchTest, ABoxShutsOffWhatIsAboveIt) {
  Scene scene;
  test::add(scene, test::floor_quad(4), test::matte({1, 1, 1}));
  test::add(scene, test::box({-1, 1, -1}, {1, 2, 1}), test::matte({1, 1, 1}));
  const SurfaceSearch search(scene);
  const auto spot = search.first_along({{0, 0.5, 0}, {0, -1, 0}});
  ASSERT_TRUE(spot);
  EXPECT_NEAR(spot->distance_m, 0.5, 1e-6);
  EXPECT_NEAR(spot->normal.y, 1, 1e-6);
  EXPECT_TRUE(spot->shaded_as_it_lies);
  EXPECT_TRUE(search.is_open(*spot, {0, 0.9, 0}));
  EXPECT_FALSE(search.is_open(*spot, {0, 2.5, 0}));
  EXPECT_FALSE(search.first_along({{0, 5, 0}, {0, 1, 0}}));
}

TEST(SurfaceSearchTest, WhatIsNotPresentIsNotMet) {
  Scene scene;
  test::add(scene, test::floor_quad(4), test::matte({1, 1, 1}));
  scene.instances[0].present = false;
  EXPECT_FALSE(SurfaceSearch(scene).first_along({{0, 1, 0}, {0, -1, 0}}));
}

// Normals at the corners that lie in the plane of the floor: light that they receive is none of the floor's.
TEST(SurfaceSearchTest, NormalsThatLeaveTheirTriangleAreTold) {
  Scene scene;
  test::add(scene, test::floor_quad(4), test::matte({1, 1, 1}));
  for (glm::vec3& normal : scene.meshes[0].normals) normal = {1, 0, 0};
  const auto spot = SurfaceSearch(scene).first_along({{0.1, 1, 0.2}, {0, -1, 0}});
  ASSERT_TRUE(spot);
  EXPECT_FALSE(spot->shaded_as_it_lies);
}

}  // namespace
}  // namespace herr
