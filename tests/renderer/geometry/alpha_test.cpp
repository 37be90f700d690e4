// Holes, blended layers and sides: what eyes see past, and what light passes.
#include <gtest/gtest.h>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

Material with_alpha(Material material, float alpha, AlphaMode mode) {
  material.alpha = alpha;
  material.alpha_mode = mode;
  return material;
}

// A wall across the view at distance `d`.
TriangleMesh wall_at(float d) {
  return test::quad({-10, -10, -d}, {20, 0, 0}, {0, 20, 0});
}

RenderedFrame look(const Scene& scene, Foveation foveation = Foveation::off) {
  RenderSettings settings = test::small_settings();
  settings.foveation = foveation;
  return test::render(scene, test::single_view(8, 8, 10, 10), settings, test::sample_from({0, 0, 0}));
}

double middle(const RenderedFrame& frame, std::size_t channel) {
  return test::pixel_at(frame.viewports[0], 4, 4)[channel];
}

TEST(AlphaTest, LayersCoverFrontToBackWhateverTheirOrderInTheScene) {
  for (const bool turned : {false, true}) {
    Scene scene;
    const Material red = with_alpha(test::glowing({1, 0, 0}), 0.25f, AlphaMode::blend);
    const Material green = with_alpha(test::glowing({0, 1, 0}), 0.5f, AlphaMode::blend);
    test::add(scene, wall_at(turned ? 2 : 1), turned ? green : red);
    test::add(scene, wall_at(turned ? 1 : 2), turned ? red : green);
    test::add(scene, wall_at(3), test::glowing({0, 0, 1}));
    const RenderedFrame frame = look(scene);
    // 0.25 red, then 0.75 x 0.5 green, then 0.75 x 0.5 blue; all are exact in half.
    EXPECT_EQ(middle(frame, 0), 0.25);
    EXPECT_EQ(middle(frame, 1), 0.375);
    EXPECT_EQ(middle(frame, 2), 0.375);
    EXPECT_EQ(frame.counters.rays[RayKind::primary], 64);
    EXPECT_EQ(frame.counters.rays[RayKind::behind], 128);
    test::expect_finite(frame);
  }
}

TEST(AlphaTest, WhatIsBehindTheLastLayerIsTheEnvironmentOrTheFeed) {
  Scene scene;
  test::add(scene, wall_at(1), with_alpha(test::glowing({1, 0, 0}), 0.25f, AlphaMode::blend));
  scene.environment = {0, 0.5f, 0};
  for (const Foveation foveation : {Foveation::off, Foveation::log_polar}) {
    const RenderedFrame frame = look(scene, foveation);
    EXPECT_EQ(middle(frame, 0), 0.25);
    EXPECT_EQ(middle(frame, 1), 0.375);
  }
  FrameSample sample = test::sample_from({0, 0, 0});
  const test::TestCamera camera = test::TestCamera::pinhole(16, 16, 60, [](int, int) {
    return std::array<std::uint16_t, 4>{0, test::to_half(0.5), 0, 0x3c00};
  });
  camera.attach_to(sample);
  const RenderedFrame mixed =
      test::render(scene, test::single_view(8, 8, 10, 10), test::planar_settings(), sample);
  EXPECT_EQ(middle(mixed, 0), 0.25);
  EXPECT_NEAR(middle(mixed, 1), 0.375, test::half_rounding(0.375));
}

TEST(AlphaTest, AfterTheMostLayersTheNextSurfaceIsOpaque) {
  Scene scene;
  for (int i = 1; i <= kMostLayers + 2; ++i) {
    test::add(scene, wall_at(static_cast<float>(i)),
              with_alpha(test::glowing({1, 0, 0}), 0.25f, AlphaMode::blend));
  }
  scene.environment = {0, 1, 0};
  const RenderedFrame frame = look(scene);
  // Seven layers of 0.25 and an eighth that covers all the rest: nothing of the environment is left.
  EXPECT_NEAR(middle(frame, 0), 1.0, 2 * test::half_rounding(1.0));
  EXPECT_EQ(middle(frame, 1), 0.0);
  EXPECT_EQ(frame.counters.rays[RayKind::behind], 64 * (kMostLayers - 1));
}

// A mask of two columns: there on the left, a hole on the right.
TextureImage half_mask() {
  TextureImage mask;
  mask.width_px = 2;
  mask.height_px = 1;
  mask.nearest = true;
  mask.covers = true;
  mask.rgba = {255, 255, 255, 255, 255, 255, 255, 0};
  return mask;
}

TEST(AlphaTest, EyesAndMirrorsSeeThroughTheHolesOfAMask) {
  Scene scene;
  scene.textures.push_back(half_mask());
  Material leaf = with_alpha(test::glowing({1, 0, 0}), 1, AlphaMode::mask);
  leaf.base_colour_texture = 0;
  test::add(scene, wall_at(1), leaf);
  test::add(scene, wall_at(2), test::glowing({0, 1, 0}));
  const RenderedFrame frame = look(scene);
  for (int x = 0; x < 8; ++x) {
    const test::Pixel pixel = test::pixel_at(frame.viewports[0], x, 4);
    EXPECT_EQ(pixel[0], x < 4 ? 1.0 : 0.0) << x;
    EXPECT_EQ(pixel[1], x < 4 ? 0.0 : 1.0) << x;
  }
  EXPECT_EQ(frame.counters.rays[RayKind::behind], 0) << "a hole costs no layer";
}

// A floor at y = -1 under a light 9 m above it, with a sheet between that covers the floor's middle; the eye
// looks down from under the sheet.
Scene under_a_sheet(const Material& sheet, bool with_sheet) {
  Scene scene;
  test::add(scene, test::floor_quad(5, -1), test::matte(glm::vec3{0.5f}));
  if (with_sheet) test::add(scene, test::floor_quad(3, 1), sheet);
  scene.lights = {test::light_at({0, 8, 0}, glm::vec3{100.0f})};
  return scene;
}

double floor_light(const Scene& scene) {
  const RenderedFrame frame = test::render(scene, test::single_view(8, 8, 5, 5), test::planar_settings(),
                                           test::looking_down({0, 0, 0}));
  return middle(frame, 0);
}

TEST(AlphaTest, ABlendedSheetLetsItsShareOfLightPassAndAMaskWhatItsHolesLet) {
  const Material grey = test::matte(glm::vec3{0.5f});
  const double open = floor_light(under_a_sheet(grey, false));
  ASSERT_GT(open, 0.1);
  EXPECT_EQ(floor_light(under_a_sheet(grey, true)), 0.0);
  const double shade = floor_light(under_a_sheet(with_alpha(grey, 0.75f, AlphaMode::blend), true));
  EXPECT_NEAR(shade, 0.25 * open, 4 * test::half_rounding(open));
  EXPECT_EQ(floor_light(under_a_sheet(with_alpha(grey, 0.75f, AlphaMode::mask), true)), 0.0);
  EXPECT_EQ(floor_light(under_a_sheet(with_alpha(grey, 0.25f, AlphaMode::mask), true)), open);
}

TEST(AlphaTest, SharesOfLightMultiplyOverSheetsOfManyTriangles) {
  // A ball has two surfaces: 0.5 x 0.5. Its triangles share edges, none may count twice.
  const Material half = with_alpha(test::matte(glm::vec3{0.5f}), 0.5f, AlphaMode::blend);
  Scene scene = under_a_sheet(half, false);
  const double open = floor_light(scene);
  test::add(scene, test::sphere({0, 4, 0}, 2), half);
  EXPECT_NEAR(floor_light(scene), 0.25 * open, 4 * test::half_rounding(open));
}

TEST(AlphaTest, TheBackOfAnOpenSingleSidedSurfaceIsNotSeenButCastsItsShadow) {
  Scene scene;
  Material sheet = test::glowing({1, 0, 0});
  sheet.double_sided = false;
  TriangleMesh away = wall_at(1);
  for (auto& triangle : away.triangles) std::swap(triangle[1], triangle[2]);
  test::add(scene, away, sheet);
  test::add(scene, wall_at(2), test::glowing({0, 1, 0}));
  EXPECT_EQ(middle(look(scene), 0), 0.0);
  EXPECT_EQ(middle(look(scene), 1), 1.0);
  scene.meshes[0] = wall_at(1);
  EXPECT_EQ(middle(look(scene), 0), 1.0) << "the front";

  Material roof = test::matte(glm::vec3{0.5f});
  roof.double_sided = false;
  Scene shadowed = under_a_sheet(roof, true);
  EXPECT_EQ(floor_light(shadowed), 0.0);
  for (auto& triangle : shadowed.meshes[1].triangles) std::swap(triangle[1], triangle[2]);
  EXPECT_EQ(floor_light(shadowed), 0.0);
}

TEST(AlphaTest, ManyThreadsGiveTheSameBits) {
  Scene scene = under_a_sheet(with_alpha(test::matte(glm::vec3{0.5f}), 0.5f, AlphaMode::blend), true);
  test::add(scene, test::sphere({0, 0.2f, -3}, 1),
            with_alpha(test::matte({0.9f, 0.5f, 0.2f}), 0.3f, AlphaMode::blend));
  scene.ambient = scene.environment = glm::vec3{0.2f};
  RenderSettings settings = test::small_settings();
  const auto frame_with = [&](int threads) {
    settings.threads = threads;
    return test::render(scene, test::small_profile(), settings, test::sample_from({0, 0, 0}));
  };
  const RenderedFrame one = frame_with(1);
  EXPECT_GT(one.counters.rays[RayKind::behind], 0);
  test::expect_same_bits(one, frame_with(4));
}

}  // namespace
}  // namespace herr
