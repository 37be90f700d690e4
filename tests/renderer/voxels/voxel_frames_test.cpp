// Whole frames of voxels: against the same shapes as triangles, and at coarse against fine resolution.
#include <gtest/gtest.h>

#include "scenes/model/similar_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"
#include "tests/renderer/voxels/voxel_grids.h"

namespace herr::test {
namespace {

void add_grid(Scene& scene, VoxelGrid grid, const Material& material, const glm::dmat4x3& place,
              bool catcher = false) {
  Instance instance;
  instance.name = "grid";
  instance.kind = ShapeKind::voxels;
  instance.grid = static_cast<std::uint32_t>(scene.voxel_grids.size());
  instance.material = static_cast<std::uint32_t>(scene.materials.size());
  instance.world_from_object = place;
  instance.catcher = catcher;
  scene.voxel_grids.push_back(std::move(grid));
  scene.materials.push_back(material);
  scene.instances.push_back(instance);
}

glm::dmat4x3 placed(const glm::dvec3& corner, double size) {
  return {glm::dvec3{size, 0, 0}, glm::dvec3{0, size, 0}, glm::dvec3{0, 0, size}, corner};
}

// A floor, a light and a block of 1 m in its own colour, as one of three kinds.
enum class Block { triangles, voxels, none };
Scene block_scene(Block block, bool catcher_floor) {
  Scene scene;
  add(scene, floor_quad(4, -1), matte({0.5f, 0.4f, 0.3f}), catcher_floor);
  Material glossy = matte({1, 1, 1});
  glossy.roughness = 0.4f;
  glossy.mirror = 0.3f;
  glossy.metallic = 0.5f;
  const glm::vec3 lower{-0.7f, -0.9f, -4.3f};
  if (block == Block::triangles) {
    // sRGB 188, 89, 255 is linear 0.502886, 0.0998987, 1.
    glossy.base_colour = {0.50288647f, 0.09989873f, 1.0f};
    add(scene, box(lower, lower + 1.0f), glossy);
  } else if (block == Block::voxels) {
    add_grid(scene, voxel_grid({4, 4, 4}, [](int, int, int) { return 0xffff59bcu; }), glossy,
             placed(glm::dvec3(lower), 0.25));
  }
  scene.lights = {light_at({1.5, 3, -1}, {20, 18, 16})};
  scene.ambient = glm::vec3{0.2f};
  scene.environment = {0.3f, 0.4f, 0.5f};
  return scene;
}

// Rays at edges may meet either; everywhere else the two differ by rounding: colours in 10 bits of square
// root (2 / 1023 of the colour at most) and halves.
void expect_alike(const RenderedFrame& a, const RenderedFrame& b) {
  int differ = 0, pixels = 0;
  for (std::size_t v = 0; v < a.viewports.size(); ++v) {
    for_each_pixel(a.viewports[v], [&](int x, int y, const Pixel& pixel) {
      const Pixel other = pixel_at(b.viewports[v], x, y);
      bool same = true;
      for (std::size_t c = 0; c < 4; ++c)
        same = same && std::abs(pixel[c] - other[c]) <= 0.004 + 0.004 * pixel[c];
      differ += same ? 0 : 1;
      ++pixels;
    });
  }
  EXPECT_LT(differ, pixels / 200);
}

TEST(VoxelFrames, ABlockOfVoxelsLooksLikeABlockOfTriangles) {
  for (const bool catcher_floor : {false, true}) {
    RenderSettings settings = planar_settings();
    settings.occlusion_rays = 2;
    const DisplayProfile profile = single_view(96, 72, 25, 20);
    const FrameSample sample = sample_from({0, 0, 0});
    const RenderedFrame voxels = render(block_scene(Block::voxels, catcher_floor), profile, settings, sample);
    const RenderedFrame triangles =
        render(block_scene(Block::triangles, catcher_floor), profile, settings, sample);
    expect_finite(voxels);
    expect_alike(voxels, triangles);
    const RenderedFrame none = render(block_scene(Block::none, catcher_floor), profile, settings, sample);
    EXPECT_FALSE(same_bits(voxels.viewports[0], none.viewports[0])) << "the block is not seen";
  }
}

// Half of the rays that meet the glass pass it, and half of the light that they then ask for. Which ones is
// up to the samples: elsewhere places round by 1e-6 m, a ten-thousandth of a pixel, and glass and wall have
// no edges, so that hardly a pixel differs. By bits of the rays themselves it was one in thirty.
TEST(VoxelFrames, WhatPassesGlassByChanceIsTheSameElsewhere) {
  Scene scene;
  add_grid(scene, voxel_grid({64, 64, 2}, [](int, int, int) { return 0x60e0a040u; }), matte(glm::vec3{1.0f}),
           placed({-3.2, -3.2, -3}, 0.1));
  add(scene, quad({-9, -9, -5}, {18, 0, 0}, {0, 18, 0}), matte({0.5f, 0.5f, 0.5f}));
  scene.lights = {light_at({1, 2, 1}, {40, 40, 40}, {1, 1, 1})};
  RenderSettings settings = planar_settings();
  settings.light_samples = 4;
  const DisplayProfile view = single_view(64, 64, 20, 20);
  const RenderedFrame here = render(scene, view, settings, sample_from({0, 0, 0}));
  Similarity similarity;
  similarity.move = {801.3, 267.1, -534.7};
  const RenderedFrame there =
      render(similar_scene(scene, similarity), view, settings, sample_from({0, 0, 0}));
  int differ = 0, pass = 0;
  for_each_pixel(here.viewports[0], [&](int x, int y, const Pixel& pixel) {
    differ += std::abs(pixel[0] - pixel_at(there.viewports[0], x, y)[0]) > 0.01 ? 1 : 0;
    pass += std::abs(pixel[0] - pixel[2]) < 0.01 ? 1 : 0;  // the wall is grey, glass is not
  });
  EXPECT_GT(pass, 64 * 64 / 10);
  EXPECT_LT(pass, 64 * 64 * 9 / 10);
  EXPECT_LE(differ, 4);
}

TEST(VoxelFrames, TheFramePlanNamesVoxelsOnlyWhereThereAreAny) {
  EXPECT_TRUE(plan_frame(block_scene(Block::voxels, false), planar_settings(), false).voxels);
  EXPECT_FALSE(plan_frame(block_scene(Block::triangles, false), planar_settings(), false).voxels);
}

TEST(VoxelFrames, AreTheSameForAnyNumberOfThreads) {
  RenderSettings settings = small_settings();
  settings.light_samples = 4;
  settings.probes.on = true;
  RenderSettings three = settings;
  three.threads = 3;
  const Scene scene = block_scene(Block::voxels, true);
  const FrameSample sample = sample_from({0, 0, 0});
  expect_same_bits(render(scene, small_profile(), settings, sample),
                   render(scene, small_profile(), three, sample));
}

glm::dvec3 mean_of(const RenderedFrame& frame) {
  glm::dvec3 sum{0.0};
  int pixels = 0;
  for_each_pixel(frame.viewports[0], [&](int, int, const Pixel& pixel) {
    sum += glm::dvec3{pixel[0], pixel[1], pixel[2]};
    ++pixels;
  });
  return sum / static_cast<double>(pixels);
}

TEST(VoxelFrames, CoarsePicturesHaveTheMeanOfFineOnes) {
  // A lit ball of 256 voxels across 18 degrees of 30. At 240 pixels rays see the voxels. At 60 they take
  // their colours from nodes of 2 voxels, at 24 of 8, at 12 of 16, at 6 of 32, and there nodes of 2 hide.
  // Each coarse mean is of 10 x 10 pictures from places a tenth of a pixel apart, for it is chance how pixels
  // fall on the outline: of a circle 3.6 pixels across 11 lie on it, each in or out, sqrt(11) * 0.3 / 10 =
  // 0.1 of the ball in one picture, 0.01 in 100, of which its light over the wall's is seen in the mean.
  Scene scene;
  add_grid(scene, patched_ball(256, 128), matte({1, 1, 1}), placed({-1, -1, -7.3}, 2.0 / 256));
  add(scene, quad({-9, -9, -9}, {18, 0, 0}, {0, 18, 0}), matte({0.5f, 0.5f, 0.5f}));
  scene.lights = {light_at({3, 4, 1}, {60, 60, 60})};
  scene.ambient = glm::vec3{0.1f};
  const auto mean = [&](int pixels, double step_m, int steps) {
    Renderer renderer(scene, single_view(pixels, pixels, 15, 15), planar_settings(), false);
    RenderedFrame frame;
    glm::dvec3 sum{0.0};
    for (int i = 0; i < steps * steps; ++i) {
      const glm::dvec2 place = glm::dvec2{i % steps, i / steps} - 0.5 * (steps - 1);
      render_with(renderer, scene, sample_from({step_m * place, 0}), frame);
      sum += mean_of(frame);
    }
    return sum / static_cast<double>(steps * steps);
  };
  for (const int pixels : {60, 24, 12, 6}) {
    const double pixel_m = 2 * 6.3 * std::tan(glm::radians(15.0)) / pixels;
    const glm::dvec3 fine = mean(240, pixel_m / 2, 2), coarse = mean(pixels, pixel_m / 10, 10);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(coarse[c] / fine[c], 1, 0.01) << pixels << " pixels, channel " << c;
  }
}

}  // namespace
}  // namespace herr::test
