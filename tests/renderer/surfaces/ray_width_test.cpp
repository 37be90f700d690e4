// How wide rays from the eye are: which level of a texture they read.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>
#include <vector>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr int kTexels = 256, kPixels = 64;
constexpr std::uint32_t kSeed = 17;

// Independent texels: what a wider ray reads is not what a narrow one does.
TextureImage noise() {
  TextureImage image;
  image.width_px = image.height_px = kTexels;
  image.srgb = false;
  std::mt19937 random(kSeed);
  for (int i = 0; i < kTexels * kTexels; ++i) {
    const auto v = static_cast<std::uint8_t>(random() >> 24);
    image.rgba.insert(image.rgba.end(), {v, v, v, 255});
  }
  return image;
}

// Three quarters of a texel aside: else pixels lie where four texels of level 1 have the mean of level 2.
constexpr float kShift = 0.75f / kTexels;

// A metal wall that fills +-45 degrees under ambient light 1: it shows its texture's colour.
Scene noise_wall() {
  Scene scene;
  scene.textures.push_back(noise());
  Material metal = test::matte(glm::vec3{1.0f});
  metal.metallic = 1;
  metal.base_colour_texture = 0;
  TriangleMesh wall = test::quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
  for (glm::vec2& uv : wall.uvs) uv += kShift;
  test::add(scene, wall, metal);
  scene.ambient = glm::vec3{1.0f};
  return scene;
}

// A level of the texture, 2^level texels to one along each axis: means of squares of texels.
struct Level {
  int count = kTexels;
  std::vector<double> means;

  // At (u, v), bilinear, repeated.
  double at(double u, double v) const {
    const double x = u * count - 0.5, y = v * count - 0.5;
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const auto mean = [&](int column, int row) {
      return means[static_cast<std::size_t>((row + count) % count * count + (column + count) % count)];
    };
    const double upper = mean(x0, y0) + (x - x0) * (mean(x0 + 1, y0) - mean(x0, y0)),
                 lower = mean(x0, y0 + 1) + (x - x0) * (mean(x0 + 1, y0 + 1) - mean(x0, y0 + 1));
    return upper + (y - y0) * (lower - upper);
  }
};

Level level_of(const TextureImage& image, int level) {
  const int side = 1 << level;
  Level out{kTexels / side, {}};
  out.means.resize(static_cast<std::size_t>(out.count * out.count));
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      out.means[static_cast<std::size_t>(y / side * out.count + x / side)] +=
          image.rgba[static_cast<std::size_t>(4 * (y * kTexels + x))] / (255.0 * side * side);
    }
  }
  return out;
}

RenderedFrame wall_with(double ray_width) {
  RenderSettings settings = test::planar_settings();
  settings.ray_width = ray_width;
  return test::render(noise_wall(), test::single_view(kPixels, kPixels, 45, 45), settings,
                      test::sample_from({0, 0, 0}));
}

double rms_from(const Level& level, const RenderedFrame& frame) {
  double squares = 0;
  test::for_each_pixel(frame.viewports[0], [&](int x, int y, const test::Pixel& pixel) {
    // A quad's v grows upwards.
    const double u = (x + 0.5) / kPixels + kShift, v = 1 - (y + 0.5) / kPixels + kShift;
    const double off = pixel[1] - level.at(u, v);
    squares += off * off;
  });
  return std::sqrt(squares / (kPixels * kPixels));
}

// A pixel is 4 x 4 texels everywhere on a wall seen head on: level 2 for rays as wide as their pixels, level
// 4 for rays four times as wide, level 0 for rays of no width. Each level is rounded to bytes, by 1/2 of
// 1/255 at most; coordinates of 16 bits lie off by 256 / 65535 / 2 texels of 0.29.
TEST(RayWidthTest, ChoosesTheLevelOfTextures) {
  const TextureImage image = noise();
  for (const auto& [width, level] : {std::pair{0.0, 0}, {0.25, 0}, {1.0, 2}, {2.0, 3}, {4.0, 4}}) {
    const RenderedFrame frame = wall_with(width);
    for (int other = 0; other <= 6; ++other) {
      const double rms = rms_from(level_of(image, other), frame);
      std::cout << "ray width " << width << ": " << rms << " from level " << other << "\n";
      // From level to level the noise of 0.29 of a texel halves: that of level 5 is 0.009.
      EXPECT_TRUE(other == level ? rms < 0.5 * (level + 1) / 255 + 0.001 : rms > 0.006)
          << "ray width " << width << " lies " << rms << " off level " << other;
    }
  }
}

TEST(RayWidthTest, OneIsTheDefaultAndZeroIsTheLimitOfNarrowRays) {
  test::expect_same_bits(wall_with(1), wall_with(RenderSettings{}.ray_width));
  test::expect_same_bits(wall_with(0), wall_with(1e-6));
  EXPECT_FALSE(test::same_bits(wall_with(0).viewports[0], wall_with(1).viewports[0]));
}

}  // namespace
}  // namespace herr
