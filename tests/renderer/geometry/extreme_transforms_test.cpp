// Transforms at the ends of what a float holds: Embree's assertions end the process where a ray in object
// space leaves its range.
#include <gtest/gtest.h>

#include "renderer/geometry/embree_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

glm::dmat4x3 stretched(const glm::dvec3& scale) {
  return {glm::dvec3{scale.x, 0, 0}, glm::dvec3{0, scale.y, 0}, glm::dvec3{0, 0, scale.z}, glm::dvec3{0.0}};
}

// 1e-17 of 1e6 m is 1e-11 m: shorter axes grow to that, others stay.
TEST(ExtremeTransformsTest, AxesTooShortForRaysAreLengthened) {
  const glm::dmat4x3 kept = keep_rays_traceable(stretched({1e-20, -1e-20, 2}), 1e6);
  EXPECT_DOUBLE_EQ(kept[0].x, 1e-11);
  EXPECT_DOUBLE_EQ(kept[1].y, -1e-11);
  EXPECT_EQ(kept[2].z, 2);
  EXPECT_EQ(keep_rays_traceable(stretched({1e-6, 1, 1}), 1e6), stretched({1e-6, 1, 1}));
}

// A ball flattened to 1e-22 in a scene of a million metres, lit from as far: in its space rays of 1e6 / 1e-22
// would be 1e28 long, where Embree takes 1.8e18.
TEST(ExtremeTransformsTest, AFlatBallInALargeSceneIsTraced) {
  Scene scene;
  test::add(scene, test::floor_quad(1e6f, -1), test::matte({0.5f, 0.4f, 0.3f}));
  Instance ball;
  ball.kind = ShapeKind::sphere;
  ball.material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(test::matte({0.8f, 0.2f, 0.2f}));
  ball.world_from_object = {glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1e-22}, {0, 0, -3}};
  scene.instances.push_back(ball);
  scene.lights = {test::light_at({1e5, 1e6, 1e6}, glm::vec3{1e12f})};
  scene.ambient = scene.environment = glm::vec3{0.25f};
  const RenderedFrame frame = test::render(scene, test::single_view(33, 33, 10, 10), test::planar_settings(),
                                           test::sample_from({0, 0, 0}));
  test::expect_finite(frame);
  EXPECT_EQ(frame.counters.invalid_rays, 0);
  // The middle of the picture shows its red.
  const test::Pixel middle = test::pixel_at(frame.viewports[0], 16, 16);
  EXPECT_GT(middle[0], 2 * middle[1]);
}

}  // namespace
}  // namespace herr
