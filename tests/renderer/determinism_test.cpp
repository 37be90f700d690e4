// Same input, same bytes: at any thread count, in another renderer, and in the same renderer again.
#include <gtest/gtest.h>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

TextureImage checkers() {
  TextureImage texture;
  texture.width_px = texture.height_px = 8;
  for (int i = 0; i < 64; ++i) {
    const auto value = static_cast<std::uint8_t>((i / 8 + i) % 2 == 0 ? 220 : 40);
    texture.rgba.insert(texture.rgba.end(), {value, static_cast<std::uint8_t>(3 * i), value, 255});
  }
  return texture;
}

// Mirrors, textures, a catcher under coloured lights of some size: every kernel has work.
Scene busy_scene() {
  Scene scene;
  scene.textures.push_back(checkers());
  Material textured = test::matte(glm::vec3{1.0f});
  textured.base_colour_texture = 0;
  Material mirror = test::matte({0.9f, 0.8f, 0.7f});
  mirror.metallic = 1;
  mirror.roughness = 0.2f;
  mirror.mirror = 0.8f;
  test::add(scene, test::floor_quad(5, -1), test::matte(glm::vec3{0.5f}), true);
  test::add(scene, test::box({-1.5f, -1, -3}, {-0.5f, 0.3f, -2}), textured);
  test::add(scene, test::sphere({0.6f, 0, -3}, 0.8f), mirror);
  scene.lights = {test::light_at({1, 3, -1}, {20, 15, 10}, {0.4f, 0.1f, 0.4f}),
                  test::light_at({-2, 2, 0}, {2, 4, 8}, {0, 0.5f, 0})};
  scene.ambient = {0.1f, 0.12f, 0.15f};
  scene.environment = glm::vec3{0.3f};
  return scene;
}

test::TestCamera gradient_camera() {
  return test::TestCamera::pinhole(64, 48, 50, [](int x, int y) {
    return std::array<std::uint16_t, 4>{test::to_half(0.01 * x), test::to_half(0.02 * y), test::to_half(0.3),
                                        0x3c00};
  });
}

RenderSettings with_threads(int threads) {
  RenderSettings settings = test::small_settings();
  settings.light_samples = 16;
  settings.gaze_marker = true;
  settings.threads = threads;
  return settings;
}

TEST(DeterminismTest, AnyNumberOfThreadsGivesTheSameBytes) {
  const Scene scene = busy_scene();
  const test::TestCamera camera = gradient_camera();
  FrameSample sample = test::sample_from({0.1, 0.2, 0.3}, test::gaze_deg(6, -3));
  camera.attach_to(sample);
  const RenderedFrame one = test::render(scene, test::small_profile(), with_threads(1), sample);
  EXPECT_GT(one.counters.rays[RayKind::mirror], 0);
  EXPECT_GT(one.counters.rays[RayKind::shadow], 0);
  for (const int threads : {1, 2, 4}) {
    SCOPED_TRACE(threads);
    const RenderedFrame other = test::render(scene, test::small_profile(), with_threads(threads), sample);
    test::expect_same_bits(one, other);
    EXPECT_EQ(one.counters.rays[RayKind::shadow], other.counters.rays[RayKind::shadow]);
    EXPECT_EQ(one.counters.rays[RayKind::mirror], other.counters.rays[RayKind::mirror]);
    EXPECT_EQ(one.counters.rays[RayKind::primary], other.counters.rays[RayKind::primary]);
  }
}

TEST(DeterminismTest, AFrameDoesNotDependOnTheFramesBeforeIt) {
  const Scene scene = busy_scene();
  const test::TestCamera camera = gradient_camera();
  FrameSample sample = test::sample_from({0, 0, 0}, test::gaze_deg(-10, 5)),
              before = test::sample_from({1, 0, 2}, test::gaze_deg(80, 0));
  camera.attach_to(sample);
  camera.attach_to(before);
  Renderer renderer(scene, test::small_profile(), with_threads(2), true);
  RenderedFrame first, last;
  test::render_with(renderer, scene, sample, first);
  RenderedFrame between;
  test::render_with(renderer, scene, before, between);
  test::render_with(renderer, scene, sample, last);
  test::expect_same_bits(first, last);
  EXPECT_FALSE(test::same_bits(first.viewports[0], between.viewports[0]));
}

TEST(DeterminismTest, LightSamplesChangeWithTheFramesTime) {
  // The jitter is keyed by the frame: two frames of a still scene differ, or noise would stand still.
  const Scene scene = busy_scene();
  FrameSample sample = test::sample_from({0, 0, 0});
  const RenderedFrame first = test::render(scene, test::small_profile(), with_threads(1), sample);
  sample.t_ns += 16'666'667;
  const RenderedFrame second = test::render(scene, test::small_profile(), with_threads(1), sample);
  EXPECT_FALSE(test::same_bits(first.viewports[0], second.viewports[0]));
}

}  // namespace
}  // namespace herr
