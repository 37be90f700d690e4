// Smaller levels of textures: their sizes, their means in linear light, and what a wall shows of them.
#include "renderer/geometry/texture_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

TextureImage grey_image(int width, int height, const std::vector<std::uint8_t>& values, bool srgb) {
  TextureImage image;
  image.width_px = width;
  image.height_px = height;
  image.srgb = srgb;
  for (const std::uint8_t v : values) image.rgba.insert(image.rgba.end(), {v, v, v, 255});
  return image;
}

std::uint32_t texel(const TextureLevels& levels, int level, int i) {
  return levels
      .texels[static_cast<std::size_t>(levels.record.first_texel[static_cast<std::size_t>(level)] + i)];
}

TEST(TextureLevelsTest, EachLevelHasHalfTheSizeRoundedDownAndAllOfThemAThirdMore) {
  const TextureLevels odd = build_levels(grey_image(13, 5, std::vector<std::uint8_t>(65, 77), true));
  EXPECT_EQ(odd.record.levels, 4);  // 13x5, 6x2, 3x1, 1x1
  EXPECT_EQ(odd.texels.size(), 65u + 12 + 3 + 1);
  for (const std::uint32_t word : odd.texels) EXPECT_EQ(word, 0xff4d4d4du) << "one colour stays that colour";
  const TextureLevels square = build_levels(grey_image(64, 64, std::vector<std::uint8_t>(4096, 1), true));
  EXPECT_EQ(square.texels.size(), 5461u);  // 4096 (1 + 1/4 + ... + 1/4096)
  EXPECT_EQ(build_levels(grey_image(1, 1, {9}, true)).record.levels, 1);
}

TEST(TextureLevelsTest, MeansAreTakenOfLightNotOfBytes) {
  // Half black, half white is light 0.5: byte 188 of sRGB (735.36 / 1000 of the
  // curve's range), 128 of linear.
  const TextureLevels srgb = build_levels(grey_image(2, 2, {0, 255, 255, 0}, true));
  EXPECT_EQ(texel(srgb, 1, 0) & 0xffu, 188u);
  const TextureLevels linear = build_levels(grey_image(2, 2, {0, 255, 255, 0}, false));
  EXPECT_NEAR(texel(linear, 1, 0) & 0xffu, 127.5, 0.5);
}

TEST(TextureLevelsTest, OddSizesShareTheirMiddleTexels) {
  // Five texels become two: shares of 1, 1, 1/2 and 1/2, 1, 1, over 2.5.
  const TextureLevels five = build_levels(grey_image(5, 1, {10, 20, 100, 30, 40}, false));
  EXPECT_EQ(texel(five, 1, 0) & 0xffu, 32u);  // (10 + 20 + 50) / 2.5
  EXPECT_EQ(texel(five, 1, 1) & 0xffu, 48u);  // (50 + 30 + 40) / 2.5
  const TextureLevels three = build_levels(grey_image(3, 1, {10, 20, 90}, false));
  EXPECT_EQ(texel(three, 1, 0) & 0xffu, 40u);
}

TEST(TextureLevelsTest, WhereAlphaIsCoverageColoursAreWeightedByIt) {
  TextureImage leaf = grey_image(2, 1, {200, 0}, false);
  leaf.rgba[7] = 0;  // the black texel is not there
  EXPECT_EQ(texel(build_levels(leaf), 1, 0) & 0xffu, 100u);
  leaf.covers = true;
  EXPECT_EQ(texel(build_levels(leaf), 1, 0) & 0xffu, 200u);
  EXPECT_NEAR(texel(build_levels(leaf), 1, 0) >> 24, 127.5, 0.5);
}

// The definition, level by level, in plain doubles: each texel is the mean of the light of what it covers.
std::vector<double> slow_half(const std::vector<double>& from, int width, int height, int& w, int& h) {
  w = std::max(1, width / 2), h = std::max(1, height / 2);
  std::vector<double> to(static_cast<std::size_t>(4 * w * h));
  const auto share = [](int i, int many, int of, int x) {  // of texel x in the stretch of texel i of `of`
    const double lower = double(i) * many / of, upper = double(i + 1) * many / of;
    return std::max(0.0, std::min(upper, x + 1.0) - std::max(lower, double(x))) / (upper - lower);
  };
  for (int y = 0; y < h; ++y) {
    for (int x = 0; x < w; ++x) {
      for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
          const double weight = share(y, height, h, j) * share(x, width, w, i);
          for (int c = 0; c < 4; ++c)
            to[static_cast<std::size_t>(4 * (y * w + x) + c)] +=
                weight * from[static_cast<std::size_t>(4 * (j * width + i) + c)];
        }
      }
    }
  }
  return to;
}

// Sides that are even for some levels, then odd: the pass over rows hands over to whole levels at each of
// them.
TEST(TextureLevelsTest, EveryLevelIsTheMeanOfTheOneAboveForSidesThatTurnOdd) {
  const auto light_of = [](int byte, bool srgb) {
    const double c = byte / 255.0;
    return !srgb ? c : c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  for (const auto& [width, height] :
       {std::pair{16, 16}, {24, 8}, {20, 12}, {7, 4}, {64, 2}, {2, 32}, {6, 6}}) {
    for (const bool srgb : {true, false}) {
      TextureImage image;
      image.width_px = width, image.height_px = height, image.srgb = srgb;
      std::uint32_t state = 7;
      for (int i = 0; i < 4 * width * height; ++i)
        image.rgba.push_back(static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24));
      const TextureLevels built = build_levels(image);
      std::vector<double> light;
      for (std::size_t i = 0; i < image.rgba.size(); ++i)
        light.push_back(light_of(image.rgba[i], srgb && i % 4 != 3));
      int w = width, h = height;
      for (int level = 1; level < built.record.levels; ++level) {
        light = slow_half(light, w, h, w, h);
        for (int i = 0; i < 4 * w * h; ++i) {
          const auto byte = static_cast<int>(texel(built, level, i / 4) >> (8 * (i % 4)) & 0xffu);
          const bool curved = srgb && i % 4 != 3;
          // The nearest byte: its light lies within half the way to its neighbours. Floats: 1e-5.
          const double below = 0.5 * (light_of(std::max(byte - 1, 0), curved) + light_of(byte, curved)),
                       above = 0.5 * (light_of(std::min(byte + 1, 255), curved) + light_of(byte, curved));
          const double wanted = light[static_cast<std::size_t>(i)];
          ASSERT_TRUE((wanted >= below - 1e-5 || byte == 0) && (wanted <= above + 1e-5 || byte == 255))
              << width << "x" << height << " level " << level << " value " << i << ": " << byte << " for "
              << wanted;
        }
      }
      EXPECT_EQ(w * h, 1);
    }
  }
}

// A metal wall that fills +-45 degrees, its texture's coordinates over [0, 1]:
// ambient light shows its colour.
Scene wall_of(const TextureImage& image) {
  Scene scene;
  scene.textures.push_back(image);
  Material metal = test::matte(glm::vec3{1.0f});
  metal.metallic = 1;
  metal.base_colour_texture = 0;
  test::add(scene, test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), metal);
  scene.ambient = glm::vec3{1.0f};
  return scene;
}

TEST(TextureLevelsTest, AFineCheckerboardBecomesItsMeanWhereSamplesAreCoarser) {
  std::vector<std::uint8_t> checker;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) checker.push_back((x + y) % 2 == 0 ? 0 : 255);
  }
  const Scene scene = wall_of(grey_image(256, 256, checker, true));
  // 4 x 4 texels a pixel: the level of width 64. Light 0.5 is byte 188, 0.5029; half a step
  // of bytes is 0.003 there.
  const RenderedFrame planar = test::render(scene, test::single_view(64, 64, 45, 45), test::planar_settings(),
                                            test::sample_from({0, 0, 0}));
  test::for_each_pixel(planar.viewports[0], [](int x, int y, const test::Pixel& pixel) {
    ASSERT_NEAR(pixel[0], 0.5029, 0.0022 + 2 * test::half_rounding(0.5)) << x << ", " << y;
  });
  // In the polar buffer of 64 x 48 samples for +-45 degrees (theta_max 54.7) the spacing exceeds two texels
  // of 0.35 degrees from 5 degrees on: 8 samples apart there. Bilinear reads of level 0 would be 0 or 1. The
  // wall ends at 45 degrees, where samples are 5.3 degrees apart (360 sin 45 / 48): pixels within 39 degrees
  // (26 of 32 from the middle) read none that misses it.
  const RenderedFrame polar = test::render(scene, test::single_view(64, 64, 45, 45), test::small_settings(),
                                           test::sample_from({0, 0, 0}));
  test::for_each_pixel(polar.viewports[0], [](int x, int y, const test::Pixel& pixel) {
    const double from_middle = std::max(std::abs(x - 31.5), std::abs(y - 31.5));
    if (from_middle < 16 || from_middle > 25) return;
    ASSERT_NEAR(pixel[0], 0.5029, 0.0022 + 2 * test::half_rounding(0.5)) << x << ", " << y;
  });
}

TEST(TextureLevelsTest, MirrorsShowTheLevelOfTheWholeWay) {
  // The same board behind the eye, seen in a mirror half way: 3 m of way for a board of 2 m.
  std::vector<std::uint8_t> checker;
  for (int i = 0; i < 256 * 256; ++i) checker.push_back((i + i / 256) % 2 == 0 ? 0 : 255);
  Scene scene = wall_of(grey_image(256, 256, checker, true));
  scene.instances[0].world_from_object[3] = {0, 0, 2};  // at z = 1, facing -z or not: both sides show
  Material mirror = test::matte(glm::vec3{1.0f});
  mirror.metallic = 1;
  mirror.mirror = 1.0f;
  mirror.roughness = 0;
  test::add(scene, test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), mirror);
  const RenderedFrame frame = test::render(scene, test::single_view(32, 32, 15, 15), test::planar_settings(),
                                           test::sample_from({0, 0, 0}));
  test::for_each_pixel(frame.viewports[0], [](int x, int y, const test::Pixel& pixel) {
    ASSERT_NEAR(pixel[0], 0.5029, 0.01) << x << ", " << y;
  });
}

TEST(TextureLevelsTest, MagnifiedTexelsStaySquaresWhereTheSamplerSaysNearest) {
  TextureImage image = grey_image(2, 1, {0, 255}, false);
  for (const bool nearest : {false, true}) {
    image.nearest = nearest;
    const RenderedFrame frame = test::render(wall_of(image), test::single_view(8, 8, 45, 45),
                                             test::planar_settings(), test::sample_from({0, 0, 0}));
    // Pixel 3 of 8 lies at u = 7/16, a texel's 3/8 of the way from the left centre (1/4) to the right (3/4).
    const double left = test::pixel_at(frame.viewports[0], 3, 4)[0];
    EXPECT_NEAR(left, nearest ? 0.0 : 0.375, 1e-3);
    EXPECT_NEAR(test::pixel_at(frame.viewports[0], 4, 4)[0], nearest ? 1.0 : 0.625, 1e-3);
  }
}

}  // namespace
}  // namespace herr
