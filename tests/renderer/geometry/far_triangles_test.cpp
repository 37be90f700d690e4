// Triangles that reach far away: they are rounded by themselves, and the rest looks as without them.
#include <gtest/gtest.h>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/scaled_scene.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// A box on a floor, under a lamp that throws its shadow; a wall closes the view.
Scene box_on_floor(TriangleMesh floor) {
  Scene scene;
  test::add(scene, std::move(floor), test::matte({0.5f, 0.4f, 0.3f}));
  test::add(scene, test::box({-0.5f, -1, -3.5f}, {0.5f, 0, -2.5f}), test::matte(glm::vec3{0.6f}));
  test::add(scene, test::quad({-40, -1, -20}, {80, 0, 0}, {0, 40, 0}), test::matte(glm::vec3{0.3f}));
  scene.lights = {test::light_at({1, 2, -2}, glm::vec3{10.0f})};
  return scene;
}

RenderedFrame drawn(const Scene& scene) {
  return test::render(scene, test::single_view(96, 96, 40, 40), test::planar_settings(),
                      test::sample_from({0, 0, 0}));
}

TEST(FarTrianglesTest, ACornerFarAwaySpoilsNothingElseOfItsMesh) {
  const RenderedFrame plain = drawn(box_on_floor(test::floor_quad(20, -1)));
  // Behind the head, and once without area.
  for (const float width : {0.0f, 1e-3f}) {
    TriangleMesh floor = test::floor_quad(20, -1);
    const auto first = static_cast<std::uint32_t>(floor.positions.size());
    floor.positions.insert(floor.positions.end(), {{0, -1, 5}, {width, -1, 5}, {0, -1, 1e8f}});
    floor.normals.insert(floor.normals.end(), 3, {0, 1, 0});
    floor.uvs.insert(floor.uvs.end(), 3, {0, 0});
    floor.triangles.push_back({first, first + 1, first + 2});
    // Of the length of 1e8 shadow rays would start 12 m above the floor, past its lamp.
    EXPECT_EQ(test::share_alike(plain, drawn(box_on_floor(floor))), 1.0) << width;
  }
}

TEST(FarTrianglesTest, ALevelFloorIsLitTheSameHoweverWideItIs) {
  const RenderedFrame plain = drawn(box_on_floor(test::floor_quad(50, -1)));
  for (const float half : {5e3f, 5e6f, 5e8f}) {
    // Heights are exact, and a place along the floor is the ray's: only its distance rounds.
    EXPECT_EQ(test::share_alike(plain, drawn(box_on_floor(test::floor_quad(half, -1)))), 1.0) << half;
  }
}

}  // namespace
}  // namespace herr
