// Vertex colours, further textures, coordinates of their own, unlit surfaces and weighted highlights, each
// read off a wall whose radiance is known.
#include <gtest/gtest.h>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// A wall that fills +-45 degrees, lit by ambient light of 1 alone.
Scene wall(const Material& material) {
  Scene scene;
  test::add(scene, test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), material);
  scene.ambient = glm::vec3{1.0f};
  return scene;
}

test::Pixel at(const Scene& scene, int x, int y) {
  const RenderedFrame frame = test::render(scene, test::single_view(8, 8, 45, 45), test::planar_settings(),
                                           test::sample_from({0, 0, 0}));
  test::expect_finite(frame);
  return test::pixel_at(frame.viewports[0], x, y);
}

TextureImage one_texel(const std::array<std::uint8_t, 4>& rgba) {
  TextureImage image;
  image.width_px = image.height_px = 1;
  image.srgb = false;
  image.rgba.assign(rgba.begin(), rgba.end());
  return image;
}

TEST(SurfaceDetailsTest, VertexColoursMultiplyTheBaseColourAndAreInterpolated) {
  Material metal = test::matte(glm::vec3{1.0f});
  metal.metallic = 1;
  Scene scene = wall(metal);
  scene.meshes[0].colours = {{0, 1, 0.5f, 1}, {1, 1, 0.5f, 1}, {1, 1, 0.5f, 1}, {0, 1, 0.5f, 1}};
  for (const int x : {0, 3, 7}) {
    // Red runs from 0 on the left to 1 on the right; 16-bit colours, then half.
    const double red = (x + 0.5) / 8;
    const test::Pixel pixel = at(scene, x, 4);
    EXPECT_NEAR(pixel[0], red, 2e-5 + 2 * test::half_rounding(red)) << x;
    EXPECT_NEAR(pixel[1], 1.0, 2 * test::half_rounding(1.0));
    EXPECT_NEAR(pixel[2], 0.5, 2e-5 + 2 * test::half_rounding(0.5));
  }
}

TEST(SurfaceDetailsTest, AnUnlitSurfaceShowsItsColourInAnyLight) {
  Material paint = test::matte({0.5f, 0.25f, 1.0f});
  paint.unlit = true;
  Scene scene = wall(paint);
  scene.ambient = glm::vec3{0.0f};
  scene.lights = {test::light_at({0, 0, 0.5}, glm::vec3{1000.0f})};
  const test::Pixel pixel = at(scene, 4, 4);
  EXPECT_EQ(pixel[0], 0.5);
  EXPECT_EQ(pixel[1], 0.25);
  EXPECT_EQ(pixel[2], 1.0);
}

TEST(SurfaceDetailsTest, TheEmissionTextureMultipliesEmissionByItsOwnCoordinates) {
  Material lamp = test::glowing({2, 2, 2});
  lamp.emission_texture = {0, 1};
  Scene scene = wall(lamp);
  scene.ambient = glm::vec3{0.0f};
  TextureImage image = one_texel({0, 0, 0, 255});
  image.width_px = 2;
  image.rgba = {255, 0, 51, 255, 0, 255, 51, 255};
  image.nearest = true;
  scene.textures.push_back(image);
  // The second set turns u by a quarter: the texture's columns become the wall's rows.
  scene.meshes[0].more_uvs = {{{0, 0}, {0, 1}, {1, 1}, {1, 0}}};
  EXPECT_NEAR(at(scene, 1, 6)[0], 2.0, 2 * test::half_rounding(2.0)) << "below: v = 0, the left texel";
  EXPECT_NEAR(at(scene, 1, 1)[1], 2.0, 2 * test::half_rounding(2.0));
  EXPECT_NEAR(at(scene, 6, 6)[2], 0.4, 2 * test::half_rounding(0.4));
}

TEST(SurfaceDetailsTest, TheStrengthOfHighlightsScalesTheReflectanceOfADielectric) {
  // Under ambient light 1: diffuse 0 + F0, 0.04 x colour x strength, at most 1 x strength; a metal's stays.
  Material black = test::matte(glm::vec3{0.0f});
  black.specular = 0.5f;
  black.specular_colour = {1, 2, 1000};
  const test::Pixel pixel = at(wall(black), 4, 4);
  EXPECT_NEAR(pixel[0], 0.02, 2 * test::half_rounding(0.02));
  EXPECT_NEAR(pixel[1], 0.04, 2 * test::half_rounding(0.04));
  EXPECT_NEAR(pixel[2], 0.5, 2 * test::half_rounding(0.5));

  Scene textured = wall(black);
  textured.textures = {one_texel({0, 0, 0, 51}), one_texel({255, 0, 255, 255})};
  textured.materials[0].specular_texture = {0, 0};
  textured.materials[0].specular_colour_texture = {1, 0};
  EXPECT_NEAR(at(textured, 4, 4)[0], 0.004, 2 * test::half_rounding(0.004));
  EXPECT_EQ(at(textured, 4, 4)[1], 0.0);

  Material metal = black;
  metal.metallic = 1;
  metal.base_colour = glm::vec3{0.75f};
  EXPECT_EQ(at(wall(metal), 4, 4)[0], 0.75);
}

TEST(SurfaceDetailsTest, WithoutHighlightsALampLeavesNone) {
  Material black = test::matte(glm::vec3{0.0f});
  black.roughness = 0.5f;
  Scene scene = wall(black);
  scene.ambient = glm::vec3{0.0f};
  scene.lights = {test::light_at({0, 0, 0}, glm::vec3{10.0f})};
  EXPECT_GT(at(scene, 4, 4)[0], 0.01);
  scene.materials[0].specular = 0;
  EXPECT_EQ(at(scene, 4, 4)[0], 0.0);
}

}  // namespace
}  // namespace herr
