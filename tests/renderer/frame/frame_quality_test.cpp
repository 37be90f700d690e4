// What may change from frame to frame: polar width and height, light samples, probes.
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

// Heights of the least, of less and more than a tile, of no whole number of blocks of four, and the ceiling.
// A taller frame goes before each lower one: nothing of its rows may be seen.
constexpr std::array<int, 8> kHeights{96, 38, 2, 94, 34, 32, 4, 66};

TEST(FrameQualityTest, ALowerFrameHasTheBytesOfARendererOfThatHeight) {
  const Scene scene = test::busy_scene();
  const test::TestCamera camera = test::gradient_camera();
  for (const ResampleFilter filter : {ResampleFilter::bilinear, ResampleFilter::bicubic}) {
    for (const glm::dvec3& gaze : {test::gaze_deg(6, -3), test::gaze_deg(-44, 30), test::gaze_deg(120, 0)}) {
      FrameSample sample = test::sample_from({0.1, 0.2, 0.3}, gaze);
      camera.attach_to(sample);
      RenderSettings settings = test::small_settings();
      settings.filter = filter;
      settings.light_samples = 16;
      settings.adaptive_min_samples = 4;
      settings.occlusion_rays = 1;
      settings.threads = 2;
      settings.polar_height = kHeights.front();
      Renderer renderer(scene, test::small_profile(), settings, true);
      RenderedFrame frame;
      for (const int height : kHeights) {
        SCOPED_TRACE(height);
        renderer.render_frame(sample, state_of(scene), {16, 0, 0, height}, frame);
        EXPECT_EQ(frame.quality.polar_height, height);
        EXPECT_EQ(frame.polar_height, height);
        RenderSettings lower = settings;
        lower.polar_height = height;
        const RenderedFrame expected = test::render(scene, test::small_profile(), lower, sample);
        test::expect_same_bits(frame, expected);
        EXPECT_EQ(frame.counters.polar_samples, expected.counters.polar_samples);
        EXPECT_EQ(frame.counters.rays.of_kind, expected.counters.rays.of_kind);
        EXPECT_EQ(frame.theta_max_deg, expected.theta_max_deg);
      }
    }
  }
}

// With further rays at edges, whose places follow the height, and hard shadows, at whose borders they go.
TEST(FrameQualityTest, ALowerFrameHasTheEdgesOfARendererOfThatHeight) {
  const Scene scene = test::busy_scene();
  const FrameSample sample = test::sample_from({0.1, 0.2, 0.3}, test::gaze_deg(6, -3));
  RenderSettings settings = test::small_settings();
  settings.edge_samples = 4;
  settings.polar_height = kHeights.front();
  Renderer renderer(scene, test::small_profile(), settings, false);
  RenderedFrame frame;
  for (const int height : kHeights) {
    SCOPED_TRACE(height);
    renderer.render_frame(sample, state_of(scene), {1, 0, 0, height}, frame);
    RenderSettings lower = settings;
    lower.polar_height = height;
    const RenderedFrame expected = test::render(scene, test::small_profile(), lower, sample);
    test::expect_same_bits(frame, expected);
    EXPECT_GT(frame.counters.edge_samples, 0);
    EXPECT_EQ(frame.counters.edge_samples, expected.counters.edge_samples);
    EXPECT_EQ(frame.counters.rays.of_kind, expected.counters.rays.of_kind);
  }
}

// The rows of --polar acuity are 1174; half of them at half the columns are a frame of that size.
TEST(FrameQualityTest, AFrameThatFollowsTheAcuityMayBeLowerAndNarrower) {
  const Scene scene = test::busy_scene();
  const FrameSample sample = test::sample_from({0.1, 0.2, 0.3});
  RenderSettings settings = test::small_settings();
  settings.polar_acuity = true;
  Renderer renderer(scene, test::small_profile(), settings, false);
  const FrameQuality full = renderer.full_quality(sample);
  EXPECT_EQ(full.polar_height, kAcuityHeight);
  RenderedFrame frame;
  renderer.render_frame(sample, state_of(scene), full, frame);
  renderer.render_frame(sample, state_of(scene), {1, full.polar_width / 2, 0, 586}, frame);
  RenderSettings sized = settings;
  sized.polar_acuity = false;
  sized.polar_width = frame.polar_width[0];
  sized.polar_height = 586;
  ASSERT_EQ(frame.polar_width[0], frame.polar_width[1]) << "the gaze is straight ahead";
  test::expect_same_bits(frame, test::render(scene, test::small_profile(), sized, sample));
}

// Probes gather the same light whatever the picture's size.
TEST(FrameQualityTest, ALowerFrameSeesTheProbesOfATallOne) {
  const FrameSample sample = test::sample_from({0, 0, 1});
  RenderSettings settings = test::small_settings();
  settings.probes.on = true;
  test::ProbeRun tall(test::busy_scene(), test::single_view(16, 16, 40, 40), settings, sample);
  const int lower = settings.polar_height / 4 * 2;
  settings.polar_height = lower;
  test::ProbeRun low(test::busy_scene(), test::single_view(16, 16, 40, 40), settings, sample);
  for (int i = 0; i < 4; ++i) {
    tall.renderer.render_frame(tall.sample, tall.state, {1, 0, 0, lower}, tall.frame);
    low.renderer.render_frame(low.sample, low.state, low.frame);
    test::expect_same_bits(tall.frame, low.frame);
    tall.sample.t_ns = low.sample.t_ns += 10'000'000;
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

TEST(FrameQualityTest, WidthsAndHeightsChangeWithoutNewMemory) {
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
  for (const int height : {2, settings.polar_height, 4}) {
    renderer.render_frame(test::sample_from({0, 0, 0}), state_of(scene), {1, 0, 0, height}, frame);
    EXPECT_EQ(places(), before) << height;
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
  const int rows = settings.polar_height;
  for (const FrameQuality& quality :
       {FrameQuality{1, -1, 0}, FrameQuality{1, kCeiling + 1, 0}, FrameQuality{1, 1, 0, -2},
        FrameQuality{1, 1, 0, 3}, FrameQuality{1, 1, 0, rows + 2}, FrameQuality{1, 1, -1},
        FrameQuality{0, 1, 0}}) {
    EXPECT_THROW(renderer.render_frame(test::sample_from({0, 0, 0}), state_of(scene), quality, frame),
                 std::invalid_argument);
  }
}

}  // namespace
}  // namespace herr
