// Light on its way through transparent bodies that weaken it (KHR_materials_volume).
#include <gtest/gtest.h>

#include "tests/renderer/lighting/clear_glass.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

// The middle of a view along -Z from the origin, nothing reflected.
test::Pixel seen_ahead(const Scene& scene) {
  RenderSettings settings = test::planar_settings();
  settings.reflections = false;
  const RenderedFrame frame =
      test::render(scene, test::single_view(3, 3, 0.1, 0.1), settings, test::sample_from({0, 0, 0}));
  test::expect_finite(frame);
  return test::pixel_at(frame.viewports[0], 1, 1);
}

TEST(GlassMediaTest, ABodyWeakensLightByItsThickness) {
  // KHR_materials_volume: after `distance` the colour is left, after t of it colour^(t / distance). Head on
  // through a slab of 0.5 m that is twice as deep as its distance, or of index 1, where only that is seen.
  for (const float index : {1.0f, test::kGlassIndex}) {
    Scene scene;
    Material tinted = test::clear_glass();
    tinted.refractive_index = index;
    tinted.attenuation = {{0.5f, 0.8f, 1.0f}, 0.25f};
    test::add(scene, test::box({-9, -9, -2.5f}, {9, 9, -2}), tinted);
    scene.environment = glm::vec3{1.0f};
    const double f = index == 1 ? 0 : test::kGlassHeadOn;
    const test::Pixel pixel = seen_ahead(scene);
    EXPECT_NEAR(pixel[0], 0.25 * (1 - f) * (1 - f), 1e-3) << index;
    EXPECT_NEAR(pixel[1], 0.64 * (1 - f) * (1 - f), 1e-3) << index;
    EXPECT_NEAR(pixel[2], 1.0 * (1 - f) * (1 - f), 1e-3) << index;
  }
}

TEST(GlassMediaTest, WhatStandsInABodyIsWeakenedOnTheWayToIt) {
  // A glowing wall 0.25 m deep in it: colour^(0.25 / 0.5), and one interface.
  Scene scene;
  Material tinted = test::clear_glass();
  tinted.attenuation = {{0.25f, 0.64f, 1.0f}, 0.5f};
  test::add(scene, test::box({-9, -9, -4}, {9, 9, -2}), tinted);
  test::add(scene, test::quad({-8, -8, -2.25f}, {16, 0, 0}, {0, 16, 0}), test::glowing({1, 1, 1}));
  const test::Pixel pixel = seen_ahead(scene);
  EXPECT_NEAR(pixel[0], 0.5 * (1 - test::kGlassHeadOn), 1e-3);
  EXPECT_NEAR(pixel[1], 0.8 * (1 - test::kGlassHeadOn), 1e-3);
  EXPECT_NEAR(pixel[2], 1.0 * (1 - test::kGlassHeadOn), 1e-3);
}

}  // namespace
}  // namespace herr
