// Same input, same bytes: at any thread count, in another renderer, and in the same renderer again.
#include <gtest/gtest.h>

#include "renderer/foveation/ray_grids.h"
#include "tests/renderer/busy_scene.h"
#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

RenderSettings with_threads(int threads) {
  RenderSettings settings = test::small_settings();
  settings.light_samples = 16;
  settings.gaze_marker = settings.density_overlay = true;
  settings.threads = threads;
  return settings;
}

TEST(DeterminismTest, AnyNumberOfThreadsGivesTheSameBytes) {
  const Scene scene = test::busy_scene();
  const test::TestCamera camera = test::gradient_camera();
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
  const Scene scene = test::busy_scene();
  const test::TestCamera camera = test::gradient_camera();
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
  const Scene scene = test::busy_scene();
  FrameSample sample = test::sample_from({0, 0, 0});
  const RenderedFrame first = test::render(scene, test::small_profile(), with_threads(1), sample);
  sample.t_ns += 16'666'667;
  const RenderedFrame second = test::render(scene, test::small_profile(), with_threads(1), sample);
  EXPECT_FALSE(test::same_bits(first.viewports[0], second.viewports[0]));
}

RenderedFrame with_seed(std::uint32_t seed, int threads, bool probes = false) {
  Scene scene = test::busy_scene();
  RenderSettings settings = with_threads(threads);
  settings.seed = seed;
  settings.occlusion_rays = 4;
  settings.probes.on = probes;
  if (probes) settings.light_samples = 1, settings.occlusion_rays = 0;  // probe rays alone are random then
  return test::render(scene, test::small_profile(), settings, test::sample_from({0, 0, 0}));
}

TEST(DeterminismTest, AnotherSeedGivesOtherNoiseAndTheSameOneTheSameBytes) {
  for (const bool probes : {false, true}) {
    SCOPED_TRACE(probes ? "probe rays" : "light samples and occlusion rays");
    const RenderedFrame first = with_seed(7, 1, probes);
    test::expect_same_bits(first, with_seed(7, 4, probes));
    const RenderedFrame second = with_seed(8, 1, probes);
    EXPECT_FALSE(test::same_bits(first.viewports[0], second.viewports[0]));
  }
}

TEST(DeterminismTest, WithHardShadowsTheSeedChangesNothing) {
  const Scene scene = test::busy_scene();
  RenderSettings settings = test::small_settings(), other = settings;
  other.seed = 12345;
  const FrameSample sample = test::sample_from({0, 0, 0});
  test::expect_same_bits(test::render(scene, test::small_profile(), settings, sample),
                         test::render(scene, test::small_profile(), other, sample));
}

TEST(DeterminismTest, SeedZeroKeysFramesAsProgramsWithoutASeedDid) {
  // MurmurHash3's finaliser of 2 t + eye, worked out with Python.
  EXPECT_EQ(frame_key(1'000'000'000, 0, 0), 4059853923u);
  EXPECT_EQ(frame_key(1'000'000'000, 1, 0), 325093453u);
  EXPECT_NE(frame_key(1'000'000'000, 0, 1), frame_key(1'000'000'000, 0, 0));
}

}  // namespace
}  // namespace herr
