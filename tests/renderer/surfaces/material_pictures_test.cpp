// Materials whose radiance is known, read off a wall that fills the view.
#include <gtest/gtest.h>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

Scene wall(const Material& material) {
  Scene scene;
  test::add(scene, test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), material);
  return scene;
}

test::Pixel at(const Scene& scene, int x, int y) {
  const RenderedFrame frame = test::render(scene, test::single_view(8, 8, 45, 45), test::planar_settings(),
                                           test::sample_from({0, 0, 0}));
  test::expect_finite(frame);
  return test::pixel_at(frame.viewports[0], x, y);
}

TEST(MaterialPicturesTest, AMirrorOfIndexZeroShowsTheEnvironmentItself) {
  // F0 = F90 = 1: all of the mirror ray, at every angle, and nothing of the base colour.
  Material mirror = test::matte({0.5f, 0.25f, 1});
  mirror.roughness = 0;
  mirror.refractive_index = 0;
  mirror.mirror = 1;
  Scene scene = wall(mirror);
  scene.ambient = glm::vec3{1.0f};
  scene.environment = {0.25f, 0.5f, 2};
  for (const int x : {0, 4}) {
    const test::Pixel pixel = at(scene, x, 4);
    EXPECT_EQ(pixel[0], 0.25);
    EXPECT_EQ(pixel[1], 0.5);
    EXPECT_EQ(pixel[2], 2.0);
  }
}

TEST(MaterialPicturesTest, WithoutSpecularColourIndexZeroIsMatte) {
  // As specular-glossiness files have it: F0 = 0, so under ambient 1 the radiance is the diffuse colour
  // alone.
  Material paint = test::matte({0.5f, 0.25f, 1});
  paint.refractive_index = 0;
  paint.specular_colour = glm::vec3{0.0f};
  Scene scene = wall(paint);
  scene.ambient = glm::vec3{1.0f};
  EXPECT_EQ(at(scene, 4, 4)[0], 0.5);
  EXPECT_EQ(at(scene, 4, 4)[1], 0.25);
  // F0 0.5: diffuse (1 - 0.5) + 0.5.
  scene.materials[0].specular_colour = glm::vec3{0.5f};
  EXPECT_EQ(at(scene, 4, 4)[1], 0.625);
}

TEST(MaterialPicturesTest, AnUnlitSurfaceOfOneColourHasNoHighlight) {
  Material black = test::matte(glm::vec3{0.0f});
  black.roughness = 0.3f;
  black.unlit = true;
  Scene scene = wall(black);
  scene.lights = {
      test::light_at({0, 0, 0}, glm::vec3{1000.0f})};  // at the eye: its highlight is in the middle
  for (int x = 0; x < 8; ++x) EXPECT_EQ(at(scene, x, 4)[0], 0.0) << x;
}

TEST(MaterialPicturesTest, AnOcclusionTextureDimsAmbientLightAlone) {
  Material paint = test::matte(glm::vec3{0.5f});
  paint.specular = 0;
  paint.occlusion_texture.texture = 0;
  Scene scene = wall(paint);
  TextureImage half;
  half.width_px = half.height_px = 1;
  half.srgb = false;
  half.rgba = {51, 255, 255, 255};
  scene.textures = {half};
  scene.ambient = glm::vec3{1.0f};
  // 0.5 x 51 / 255; with strength 0.25, 0.5 (1 + 0.25 (0.2 - 1)).
  EXPECT_NEAR(at(scene, 4, 4)[0], 0.1, test::half_rounding(0.1) * 2);
  scene.materials[0].occlusion_strength = 0.25f;
  EXPECT_NEAR(at(scene, 4, 4)[0], 0.4, test::half_rounding(0.4) * 2);
  // A lamp shines as without.
  scene.ambient = glm::vec3{0.0f};
  scene.lights = {test::light_at({0, 0, 0}, glm::vec3{1.0f})};
  const double lit = at(scene, 4, 4)[0];
  scene.materials[0].occlusion_texture.texture = -1;
  EXPECT_EQ(at(scene, 4, 4)[0], lit);
}

}  // namespace
}  // namespace herr
