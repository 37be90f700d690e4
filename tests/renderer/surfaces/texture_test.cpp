// Textures as the kernels fetch them, read off a metal under ambient light: its radiance is colour x ambient.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// No diffuse light and F0 = base colour: under ambient 1 the radiance is the texture's colour itself.
Material plain_metal() {
  Material m = test::matte(glm::vec3{1.0f});
  m.metallic = 1;
  m.base_colour_texture = 0;
  return m;
}

// A wall that fills a view of +-45 degrees exactly; its uv run over [0, 1] in x and downwards in y, times
// `scale`, minus `shift`.
Scene textured_wall(const TextureImage& texture, float scale = 1, float shift = 0) {
  Scene scene;
  scene.textures.push_back(texture);
  TriangleMesh wall = test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
  for (glm::vec2& uv : wall.uvs) uv = glm::vec2{uv.x, 1 - uv.y} * scale - shift;
  test::add(scene, wall, plain_metal());
  scene.ambient = glm::vec3{1.0f};
  return scene;
}

RenderedFrame render_wall(const Scene& scene, int width, int height, Isa isa = Isa::best) {
  RenderSettings settings = test::planar_settings();
  settings.isa = isa;
  return test::render(scene, test::single_view(width, height, 45, 45), settings,
                      test::sample_from({0, 0, 0}));
}

double srgb_curve(double c) {  // IEC 61966-2-1
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(TextureTest, TheSrgbCurveIsWithinItsStatedErrorAndExactAtBothEnds) {
  TextureImage ramp;
  ramp.width_px = 256;
  ramp.height_px = 1;
  for (int i = 0; i < 256; ++i) {
    const auto v = static_cast<std::uint8_t>(i);
    ramp.rgba.insert(ramp.rgba.end(), {v, v, v, 255});
  }
  for (const Isa isa : test::offered_isas()) {
    const RenderedFrame frame = render_wall(textured_wall(ramp), 256, 4, isa);
    double worst = 0, worst_linear = 0;
    for (int i = 0; i < 256; ++i) {
      const double value = test::pixel_at(frame.viewports[0], i, 1)[0];
      // Pixel i looks at texel i's centre; uv of 16 bits and float may miss it by 256 / 65535 / 2 +
      // 1e-4 of a texel, a neighbour differing by at most 0.0105. Truncation to half costs a whole
      // step, 2^-10 of the value.
      const double fetch = 0.0022 * 0.0105 + 2 * test::half_rounding(value);
      const double step = srgb_curve((i + 0.5) / 255) - srgb_curve((i - 0.5) / 255);  // of 8 bits
      const double error = std::abs(value - srgb_curve(i / 255.0)) - fetch;
      worst = std::max(worst, error / step);
      worst_linear = std::max(worst_linear, error);
    }
    std::cout << name_of(isa) << ": the curve is off by at most " << worst << " steps of 8 bits\n";
    EXPECT_LT(worst, 0.5);
    // The polynomial c (((( 43703 c - 107344) c + 111320) c + 13530) c + 4327) / 65536 differs most from the
    // curve at code 231, where it is 0.79574 and the curve 0.79910: by 0.00336. Relative to a step it is
    // worst at code 19: 0.438.
    EXPECT_LT(worst_linear, 0.0034);
    EXPECT_NEAR(test::pixel_at(frame.viewports[0], 0, 1)[0], 0.0, 1e-5);
    EXPECT_NEAR(test::pixel_at(frame.viewports[0], 255, 1)[0], 1.0, 0x1p-10);
  }
}

// The texture coordinate's texel, by the rules of OpenGL and glTF.
int wrapped(int i, int size, TextureWrap wrap) {
  switch (wrap) {
    case TextureWrap::repeat:
      return (i % size + size) % size;
    case TextureWrap::clamp:
      return std::clamp(i, 0, size - 1);
    case TextureWrap::mirror: {
      const int folded = (i % (2 * size) + 2 * size) % (2 * size);
      return folded < size ? folded : 2 * size - 1 - folded;
    }
  }
  return 0;
}

TEST(TextureTest, WrapsAndFiltersAsGltfSays) {
  // 4 x 3 texels of unlike values, linear; coordinates from -1.5 to 2.5 on both axes.
  TextureImage texture;
  texture.width_px = 4;
  texture.height_px = 3;
  texture.srgb = false;
  for (int i = 0; i < 12; ++i) {
    texture.rgba.insert(texture.rgba.end(),
                        {static_cast<std::uint8_t>(20 * i), static_cast<std::uint8_t>(255 - 17 * i),
                         static_cast<std::uint8_t>(i % 2 * 255), 255});
  }
  constexpr int kSide = 96;
  for (const TextureWrap wrap_u : {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror}) {
    for (const TextureWrap wrap_v : {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror}) {
      texture.wrap_u = wrap_u;
      texture.wrap_v = wrap_v;
      const RenderedFrame frame = render_wall(textured_wall(texture, 4, 1.5f), kSide, kSide);
      test::for_each_pixel(frame.viewports[0], [&](int px, int py, const test::Pixel& pixel) {
        const double x = ((px + 0.5) / kSide * 4 - 1.5) * 4 - 0.5,
                     y = ((py + 0.5) / kSide * 4 - 1.5) * 3 - 0.5;
        const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
        for (std::size_t c = 0; c < 3; ++c) {
          const auto texel = [&](int i, int j) {
            return texture.rgba[static_cast<std::size_t>(
                                    4 * (wrapped(j, 3, wrap_v) * 4 + wrapped(i, 4, wrap_u))) +
                                c] /
                   255.0;
          };
          const double upper = texel(x0, y0) + (x - x0) * (texel(x0 + 1, y0) - texel(x0, y0));
          const double lower = texel(x0, y0 + 1) + (x - x0) * (texel(x0 + 1, y0 + 1) - texel(x0, y0 + 1));
          const double expected = upper + (y - y0) * (lower - upper);
          // uv of 16 bits over a range of 4 lies half a step of 4 / 65535 off, times 4 (3) texels: 1.2e-4
          // each; neighbours differ by at most 1. Then the half.
          ASSERT_NEAR(pixel[c], expected, 3e-4 + 2 * test::half_rounding(expected))
              << "pixel " << px << ", " << py << ", wrap " << static_cast<int>(wrap_u) << " "
              << static_cast<int>(wrap_v);
        }
      });
    }
  }
}

TEST(TextureTest, ATextureOfOneTexelIsThatTexelEverywhere) {
  TextureImage texture;
  texture.width_px = texture.height_px = 1;
  texture.srgb = false;
  texture.rgba = {51, 102, 204, 255};
  for (const TextureWrap wrap : {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror}) {
    texture.wrap_u = texture.wrap_v = wrap;
    const RenderedFrame frame = render_wall(textured_wall(texture, 7, 3), 32, 32);
    test::for_each_pixel(frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
      ASSERT_NEAR(pixel[0], 0.2, 2 * test::half_rounding(0.2));
      ASSERT_NEAR(pixel[1], 0.4, 2 * test::half_rounding(0.4));
      ASSERT_NEAR(pixel[2], 0.8, 2 * test::half_rounding(0.8));
    });
  }
}

TEST(TextureTest, RoughnessAndMetalnessComeFromGreenAndBlue) {
  // Factor 1 times (G, B) = (anything, 0.2): diffuse = base (1 - 0.2), F0 = 0.04 + 0.2 (base - 0.04);
  // ambient 1.
  Scene scene;
  TextureImage texture;
  texture.width_px = texture.height_px = 1;
  texture.srgb = false;
  texture.rgba = {255, 128, 51, 255};
  scene.textures.push_back(texture);
  Material material = test::matte(glm::vec3{0.5f});
  material.metallic = 1;
  material.metallic_roughness_texture = 0;
  test::add(scene, test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), material);
  scene.ambient = glm::vec3{1.0f};
  const double expected = 0.5 * 0.8 + 0.04 + 0.2 * (0.5 - 0.04);
  const RenderedFrame frame = render_wall(scene, 4, 4);
  EXPECT_NEAR(test::pixel_at(frame.viewports[0], 1, 1)[0], expected, 2 * test::half_rounding(expected));
}

}  // namespace
}  // namespace herr
