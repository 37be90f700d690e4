// What is seen through glass depends on no scale: light times a factor gives the picture times that factor,
// and glass of index 1 shows textures as finely as they are seen without it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/renderer/busy_scene.h"
#include "tests/renderer/half_pixels.h"
#include "tests/renderer/lighting/clear_glass.h"

namespace herr::test {
namespace {

// Two glass balls, one behind the other: lamps glint on the second, too.
Scene glass_balls(float intensity) {
  Scene scene;
  add(scene, sphere({0, 0, -2}, 0.5f), clear_glass());
  add(scene, sphere({0.1f, 0.1f, -4}, 1.0f), clear_glass());
  add(scene, floor_quad(8, -1), matte({0.5f, 0.5f, 0.5f}));
  scene.lights = {light_at({1, 3, -1}, glm::vec3(intensity))};
  return scene;
}

// A factor of 2^-8 is exact in float; values above 2^-14 are normal half floats before and after, and those
// that are blended with darker ones can be rounded one step of 2^-10 apart.
TEST(GlassScaleTest, LightTimesAFactorIsThePictureTimesIt) {
  const DisplayProfile profile = single_view(96, 96, 30, 30);
  const RenderedFrame bright = render(glass_balls(256), profile, planar_settings(), sample_from({0, 0, 0}));
  const RenderedFrame dim = render(glass_balls(1), profile, planar_settings(), sample_from({0, 0, 0}));
  double worst = 0;
  for_each_pixel(bright.viewports[0], [&](int x, int y, const Pixel& pixel) {
    const double wanted = pixel[1] / 256;
    const double got = pixel_at(dim.viewports[0], x, y)[1];
    if (wanted > 0x1p-14) worst = std::max(worst, std::abs(got - wanted) / wanted);
  });
  EXPECT_LE(worst, 0x1p-10);
}

// A fine texture on a wall, behind a block of glass of index 1 that is as thick as the wall is far: rays
// leave its far side as wide as they would be there without it. Half floats of equal light are equal but for
// directions that were rounded once more.
TEST(GlassScaleTest, GlassOfIndexOneShowsTexturesAsTheyAre) {
  Scene scene;
  Material wall = matte({1, 1, 1});
  wall.base_colour_texture = 0;
  scene.textures = {checkers()};
  TriangleMesh mesh = quad({-4, -4, -4}, {8, 0, 0}, {0, 8, 0});
  for (glm::vec2& uv : mesh.uvs) uv *= 24.0f;
  add(scene, mesh, wall);
  scene.ambient = glm::vec3(0.5f);
  Scene with_glass = scene;
  Material glass = clear_glass();
  glass.refractive_index = 1;
  add(with_glass, box({-3, -3, -3.5f}, {3, 3, -0.5f}), glass);
  const DisplayProfile profile = single_view(64, 64, 20, 20);
  const RenderedFrame without = render(scene, profile, planar_settings(), sample_from({0, 0, 0}));
  const RenderedFrame with = render(with_glass, profile, planar_settings(), sample_from({0, 0, 0}));
  double worst = 0, least = 1, most = 0;
  for_each_pixel(without.viewports[0], [&](int x, int y, const Pixel& pixel) {
    worst = std::max(worst, std::abs(pixel[0] - pixel_at(with.viewports[0], x, y)[0]));
    least = std::min(least, pixel[0]), most = std::max(most, pixel[0]);
  });
  EXPECT_GT(most - least, 0.05);  // the texture is seen, and not at its finest level
  EXPECT_LE(worst, 1.0 / 256);
}

}  // namespace
}  // namespace herr::test
