// What may change from frame to frame: polar width, light samples, probes.
#include <gtest/gtest.h>

#include <set>

#include "renderer/frame/renderer_impl.h"
#include "tests/renderer/busy_scene.h"
#include "tests/renderer/probes/probe_scenes.h"
#include "tests/renderer/rendered_frames.h"

namespace herr {
namespace {

SceneState state_of(const Scene& scene) {
  SceneState state;
  scene_state_at(scene, 0, state);
  return state;
}

// Widths of one sample, of an odd number, less and more than a tile of 32 columns, and the ceiling itself.
constexpr std::array<int, 7> kWidths{37, 1, 96, 2, 33, 64, 95};
constexpr int kCeiling = 96;

TEST(FrameQualityTest, ANarrowerFrameHasTheBytesOfARendererOfThatWidth) {
  const Scene scene = test::busy_scene();
  const test::TestCamera camera = test::gradient_camera();
  // The gaze jumps, and theta_max with it: what a wider frame left in the buffer must not be seen.
  for (const glm::dvec3& gaze : {test::gaze_deg(6, -3), test::gaze_deg(-44, 30), test::gaze_deg(120, 0)}) {
    FrameSample sample = test::sample_from({0.1, 0.2, 0.3}, gaze);
    camera.attach_to(sample);
    RenderSettings settings = test::small_settings();
    settings.light_samples = 4;
    settings.threads = 2;
    settings.polar_width = kCeiling;
    Renderer renderer(scene, test::small_profile(), settings, true);
    RenderedFrame frame;
    for (const int width : kWidths) {
      SCOPED_TRACE(width);
      renderer.render_frame(sample, state_of(scene), {4, width, 0}, frame);
      EXPECT_EQ(frame.quality.polar_width, width);
      RenderSettings narrow = settings;
      narrow.polar_width = width;
      const RenderedFrame expected = test::render(scene, test::small_profile(), narrow, sample);
      test::expect_same_bits(frame, expected);
      EXPECT_EQ(frame.counters.polar_samples, expected.counters.polar_samples);
      EXPECT_EQ(frame.counters.rays.of_kind, expected.counters.rays.of_kind);
    }
  }
}

TEST(FrameQualityTest, FewerAdaptiveLightSamplesAreThoseOfARendererOfThatNumber) {
  const Scene scene = test::busy_scene();
  const FrameSample sample = test::sample_from({0.1, 0.2, 0.3});
  RenderSettings settings = test::small_settings();
  settings.light_samples = 64;
  settings.adaptive_min_samples = 8;
  Renderer renderer(scene, test::small_profile(), settings, false);
  RenderedFrame frame;
  for (const int samples : {16, 8, 4, 1, 64}) {
    SCOPED_TRACE(samples);
    renderer.render_frame(sample, state_of(scene), {samples}, frame);
    RenderSettings fewer = settings;
    fewer.light_samples = samples;
    test::expect_same_bits(frame, test::render(scene, test::small_profile(), fewer, sample));
  }
}

TEST(FrameQualityTest, WidthsChangeWithoutNewMemory) {
  const Scene scene = test::busy_scene();
  RenderSettings settings = test::small_settings();
  settings.polar_width = kCeiling;
  Renderer renderer(scene, test::small_profile(), settings, false);
  const Renderer::Impl& inside = renderer.internals();
  const auto places = [&] {
    std::set<const void*> all;
    for (const RadianceBuffer& buffer : inside.buffers) all.insert({buffer.texels(), buffer.ratios()});
    for (const auto& samples : inside.samples) {
      all.insert({samples->sin_theta(), samples->cos_theta(), samples->margin(), samples->sin_phi4()});
    }
    return all;
  };
  const std::set<const void*> before = places();
  RenderedFrame frame;
  for (const int width : kWidths) {
    renderer.render_frame(test::sample_from({0, 0, 0}), state_of(scene), {1, width, 0}, frame);
    EXPECT_EQ(places(), before) << width;
  }
}

TEST(FrameQualityTest, FewerProbesTakeTurnsUntilAllWereUpdated) {
  test::ProbeRun run(test::busy_scene(), test::single_view(16, 16, 40, 40), test::probe_settings(),
                     test::sample_from({0, 0, 1}));
  const int all = run.renderer.internals().probes->most_updated();
  EXPECT_EQ(all, 16 * 8 * 16);
  std::set<std::int32_t> updated;
  std::int64_t active = 0;
  constexpr int kAtOnce = 100;
  for (int i = 0; i == 0 || i * kAtOnce < active; ++i) {
    run.renderer.render_frame(run.sample, run.state, {1, 0, kAtOnce}, run.frame);
    run.sample.t_ns += 10'000'000;
    active = run.frame.probes.active;
    EXPECT_EQ(run.frame.quality.probes, kAtOnce);
    EXPECT_LE(run.frame.probes.updated, kAtOnce);
    for (const std::int32_t probe : run.volume().selected()) updated.insert(probe);
  }
  EXPECT_GE(static_cast<std::int64_t>(updated.size()), active) << "some waited for a second turn of others";
  run.run(1);
  EXPECT_EQ(run.frame.quality.probes, all);
  EXPECT_GE(run.frame.probes.updated, active);
}

TEST(FrameQualityTest, OutOfRangeIsRefused) {
  const Scene scene = test::busy_scene();
  RenderSettings settings = test::small_settings();
  settings.polar_width = kCeiling;
  Renderer renderer(scene, test::small_profile(), settings, false);
  RenderedFrame frame;
  for (const FrameQuality& quality : {FrameQuality{1, -1, 0}, FrameQuality{1, kCeiling + 1, 0},
                                      FrameQuality{1, 1, -1}, FrameQuality{0, 1, 0}}) {
    EXPECT_THROW(renderer.render_frame(test::sample_from({0, 0, 0}), state_of(scene), quality, frame),
                 std::invalid_argument);
  }
}

}  // namespace
}  // namespace herr
