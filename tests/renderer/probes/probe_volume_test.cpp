// Probes as a system: the same bytes at any number of threads, budgets, sleep, saved state, awkward grids.
#include <gtest/gtest.h>

#include "tests/renderer/probes/probe_scenes.h"

namespace herr {
namespace {

Scene room(const glm::dvec3& at = {0, 0, 0}) {
  Scene scene;
  glm::dmat4x3 place{1.0};
  place[3] = at;
  test::add(scene, test::box({-2, -1.25f, -2.5f}, {2, 1.25f, 2.5f}), test::matte({0.7f, 0.5f, 0.3f}), false,
            place);
  test::add(scene, test::box({-0.5f, -1.2f, -1}, {0.4f, -0.2f, -0.3f}), test::matte({0.2f, 0.6f, 0.8f}),
            false, place);
  scene.lights = {test::light_at(at + glm::dvec3{1, 0.8, -1.4}, glm::vec3{3.0f}, {0.2f, 0.1f, 0.2f})};
  scene.probes.counts = {7, 5, 6};
  return scene;
}

TEST(ProbeVolumeTest, AnyNumberOfThreadsGivesTheSameBytes) {
  std::vector<RenderedFrame> frames;
  for (const int threads : {1, 2, 4}) {
    RenderSettings settings = test::small_settings();
    settings.probes.on = true;
    settings.probes.budget = 50;
    settings.threads = threads;
    test::ProbeRun run(room(), test::small_profile(), settings, test::sample_from({0, 0, 1}));
    run.run(12);
    frames.push_back(run.frame);
    test::expect_same_bits(frames.front(), run.frame);
    EXPECT_EQ(run.frame.counters.rays[RayKind::probe], frames.front().counters.rays[RayKind::probe]);
    EXPECT_EQ(run.frame.probes.variability, frames.front().probes.variability);
  }
  EXPECT_EQ(frames.front().counters.rays[RayKind::probe], 50 * 64);
  EXPECT_GT(frames.front().counters.rays[RayKind::probe_shadow], 0);
  test::expect_times_add_up(frames.front());
}

TEST(ProbeVolumeTest, ABudgetTakesProbesInTurnAndReachesTheSameLight) {
  const DisplayProfile view = test::single_view(16, 16, 40, 40);
  RenderSettings settings = test::probe_settings(0.02);
  test::ProbeRun all(room(), view, settings, test::sample_from({0, 0, 1}));
  settings.probes.budget = 32;
  test::ProbeRun some(room(), view, settings, test::sample_from({0, 0, 1}));
  all.run(40);
  some.run(240);
  EXPECT_EQ(some.frame.probes.updated, 32);
  EXPECT_EQ(some.frame.counters.rays[RayKind::probe], 32 * 64);
  const auto light = [&](const test::ProbeRun& run) {
    double sum = 0;
    test::for_each_pixel(run.frame.viewports[0],
                         [&](int, int, const test::Pixel& pixel) { sum += pixel[1]; });
    return sum;
  };
  // Both still waver with their rays: 64 of them, hundreds of probes in view.
  EXPECT_NEAR(light(some), light(all), 0.02 * light(all));
}

TEST(ProbeVolumeTest, ProbesFarFromEverythingAndInTheDarkCostNothing) {
  Scene scene;
  test::add(scene, test::floor_quad(8), test::matte(glm::vec3{0.5f}));
  test::add(scene, test::box({-1, 0.01f, -1}, {1, 2, 1}),
            test::matte(glm::vec3{0.5f}));  // solid: dark within
  scene.lights = {test::light_at({3, 5, 3}, glm::vec3{10.0f})};
  scene.probes = {{16, 16, 16}, Bounds{{-8, -1, -8}, {8, 7, 8}}};
  test::ProbeRun run(scene, test::single_view(8, 8, 40, 40), test::probe_settings(),
                     test::sample_from({0, 3, 6}));
  run.run(40);
  // The floor lies between the layers at y = -0.25 ... 0.25 - probes of these two layers matter, 512 of them,
  // and those around the box: at most 4 x 4 x 5 of the layers above.
  EXPECT_LE(run.frame.probes.active, 512 + 80);
  EXPECT_GE(run.frame.probes.active, 256);
  EXPECT_EQ(run.frame.probes.active + run.frame.probes.inactive, 16 * 16 * 16);
  EXPECT_LE(run.frame.counters.rays[RayKind::probe], (512 + 80) * 64);
  // Below the floor no light comes: those probes sleep.
  EXPECT_LE(run.frame.probes.active, 256 + 80);
}

TEST(ProbeVolumeTest, ARestoredRendererGoesOnByteForByte) {
  RenderSettings settings = test::probe_settings();
  settings.probes.budget = 40;
  const DisplayProfile view = test::single_view(32, 32, 40, 40);
  test::ProbeRun run(room({100, 0, 0}), view, settings, test::sample_from({100, 0, 1}));
  run.run(7);
  const RendererState state = run.renderer.state();
  test::ProbeRun other(room({100, 0, 0}), view, settings, run.sample);
  other.renderer.restore(state);
  for (int i = 0; i < 5; ++i) {
    run.run(1);
    other.run(1);
    test::expect_same_bits(run.frame, other.frame);
  }
  EXPECT_EQ(run.renderer.state().probes, other.renderer.state().probes);
}

TEST(ProbeVolumeTest, StateOfSomethingElseIsRefused) {
  const DisplayProfile view = test::single_view(8, 8, 40, 40);
  test::ProbeRun run(room(), view, test::probe_settings(), test::sample_from({0, 0, 1}));
  run.run(1);
  RendererState state = run.renderer.state();
  Scene finer = room();
  finer.probes.counts = {8, 5, 6};
  Renderer another(finer, view, test::probe_settings(), false);
  EXPECT_THROW(another.restore(state), std::invalid_argument);
  Renderer without(run.scene, view, test::planar_settings(), false);
  EXPECT_THROW(without.restore(state), std::invalid_argument);
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, std::size_t{60}, state.probes.size() - 1}) {
    Renderer same(run.scene, view, test::probe_settings(), false);
    RendererState cut = state;
    cut.probes.resize(size);
    EXPECT_THROW(same.restore(cut), std::invalid_argument) << size;
  }
  state.probes.push_back({});
  EXPECT_THROW(run.renderer.restore(state), std::invalid_argument);
}

TEST(ProbeVolumeTest, AnyGridIsLegal) {
  for (const std::array<int, 3> counts :
       {std::array{1, 1, 1}, std::array{2, 1, 1}, std::array{1, 3, 1}, std::array{17, 1, 5}}) {
    Scene scene = room();
    scene.probes.counts = counts;
    test::ProbeRun run(scene, test::single_view(16, 16, 40, 40), test::probe_settings(),
                       test::sample_from({0, 0, 1}));
    run.run(3);
    test::expect_finite(run.frame);
    EXPECT_GT(run.frame.probes.active, 0);
  }
}

TEST(ProbeVolumeTest, FlatAndSingleSurfacesAreLit) {
  Scene scene;
  test::add(scene, test::floor_quad(3), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({0, 2, 0}, glm::vec3{5.0f})};
  scene.environment = glm::vec3{0.5f};
  test::ProbeRun run(scene, test::single_view(16, 16, 40, 40), test::probe_settings(),
                     test::looking_down({0, 2, 0}));
  run.run(10);
  RenderSettings settings = test::planar_settings();
  const RenderedFrame direct = test::render(scene, test::single_view(16, 16, 40, 40), settings, run.sample);
  // A floor sees nothing but the environment.
  for (const double light : test::indirect_of_pixels(run.frame.viewports[0], direct.viewports[0], 0.5)) {
    ASSERT_NEAR(light, 0.5, 0.005);
  }
}

TEST(ProbeVolumeTest, LightInsideAProbeAndBlackWallsAreFine) {
  Scene scene = room();
  scene.lights[0].centre = {0, 0, 0};
  scene.lights[0].size = glm::vec3{0.0f};
  scene.materials[0].base_colour = scene.materials[1].base_colour = glm::vec3{0.0f};
  test::ProbeRun run(scene, test::single_view(16, 16, 40, 40), test::probe_settings(),
                     test::sample_from({0, 0, 1}));
  run.run(5);
  test::expect_finite(run.frame);
  const RenderedFrame direct =
      test::render(scene, test::single_view(16, 16, 40, 40), test::planar_settings(), run.sample);
  test::expect_same_bits(direct, run.frame);  // black returns nothing
}

// Anchors are multiples of 16 m, so 1,000,000 m away everything has the same coordinates relative to one.
TEST(ProbeVolumeTest, FarFromTheOriginNothingChanges) {
  const DisplayProfile view = test::single_view(32, 32, 40, 40);
  const double far = 1e6;
  test::ProbeRun here(room(), view, test::probe_settings(), test::sample_from({0, 0, 1}));
  test::ProbeRun there(room({far, 0, -far}), view, test::probe_settings(),
                       test::sample_from({far, 0, 1 - far}));
  here.run(4);
  there.run(4);
  test::expect_same_bits(here.frame, there.frame);
}

// Up to the last legal stamp: doubles lie 512 ns apart there, and the share that probes keep would waver.
TEST(ProbeVolumeTest, LateStampsGatherTheSameLight) {
  const DisplayProfile view = test::single_view(32, 32, 40, 40);
  test::ProbeRun early(room(), view, test::probe_settings(), test::sample_from({0, 0, 1}));
  test::ProbeRun late(room(), view, test::probe_settings(), test::sample_from({0, 0, 1}));
  early.sample.t_ns = early.sample.start_ns = 0;
  late.sample.t_ns = late.sample.start_ns = 4'000'000'000'000'000'000 - 1'000'000'007;
  early.run(12);
  late.run(12);
  EXPECT_EQ(early.volume().sets[0].gathered, late.volume().sets[0].gathered);
  test::expect_same_bits(early.frame, late.frame);
}

// A room of radiance 1e-6 to 1e-5. At -15 EV white is 32768, and 1e-9 of it 3.3e-5.
TEST(ProbeVolumeTest, ProbesSleepByTheWhiteThatIsShown) {
  Scene dim = room();
  dim.lights[0].intensity_w_sr *= 1e-5f;
  RenderSettings settings = test::probe_settings();
  test::ProbeRun bright(dim, test::single_view(8, 8, 40, 40), settings, test::sample_from({0, 0, 1}));
  settings.exposure_ev = -15;
  test::ProbeRun dark(dim, test::single_view(8, 8, 40, 40), settings, test::sample_from({0, 0, 1}));
  bright.run(20);
  dark.run(20);
  EXPECT_GT(bright.frame.probes.active, 0);
  EXPECT_EQ(dark.frame.probes.active, 0);
}

TEST(ProbeVolumeTest, AnAnchorThatMovesLeavesTheProbesAlone) {
  const DisplayProfile view = test::single_view(32, 32, 40, 40);
  test::ProbeRun run(room(), view, test::probe_settings(), test::sample_from({0, 0, 1}));
  run.run(40);
  const RenderedFrame before = run.frame;
  run.sample.head.world_from_head.position = {100, 0, 1};  // far out, and back again
  run.run(1, 1e6);
  run.sample.head.world_from_head.position = {24, 0, 1};
  run.run(1, 1e6);
  run.sample.head.world_from_head.position = {0, 0, 1};
  run.run(1, 1e6);
  double worst = 0, brightest = 0;
  std::vector<double> values;
  test::for_each_pixel(before.viewports[0], [&](int, int, const test::Pixel& p) { values.push_back(p[1]); });
  std::size_t i = 0;
  test::for_each_pixel(run.frame.viewports[0], [&](int, int, const test::Pixel& p) {
    worst = std::max(worst, std::abs(p[1] - values[i]));
    brightest = std::max(brightest, values[i++]);
  });
  EXPECT_LT(worst, 0.01 * brightest);
}

// A frame in which no time passes gathers nothing: a pass of its seed is the same picture, whether probes
// come from the frame before, from a saved state, or the head has gone so far that the anchor moved.
TEST(ProbeVolumeTest, PassesSeeTheProbesAsTheLastFrameLeftThem) {
  Scene scene = room();
  scene.meshes[0] = test::box({-2, -1.25f, -25}, {2, 1.25f, 2.5f});
  const DisplayProfile view = test::single_view(24, 24, 40, 40);
  test::ProbeRun run(scene, view, test::probe_settings(), test::sample_from({0, 0, 1}));
  run.run(6);
  run.sample.t_ns = static_cast<TimeNs>(1e9) + 5 * static_cast<TimeNs>(std::llround(1e9 / 90));
  const RendererState state = run.renderer.state();
  RenderedFrame pass;
  for (const double z : {1.0, -20.0}) {
    run.sample.head.world_from_head.position = {0, 0, z};
    run.renderer.render_pass(run.sample, run.state, {}, pass);
    EXPECT_EQ(pass.counters.rays[RayKind::probe], 0);
    test::ProbeRun restored(scene, view, test::probe_settings(), run.sample);
    restored.renderer.restore(state);
    restored.renderer.render_pass(run.sample, run.state, {}, restored.frame);
    test::expect_same_bits(restored.frame, pass);
    run.renderer.render_frame(run.sample, run.state, run.frame);
    EXPECT_EQ(run.frame.counters.rays[RayKind::probe], 0);
    test::expect_same_bits(run.frame, pass);
    EXPECT_EQ(run.renderer.state().probes, state.probes);
  }
}

TEST(ProbeVolumeTest, WithoutProbesThereIsNoProbeMemoryAndNoRow) {
  test::ProbeRun run(room(), test::single_view(8, 8, 40, 40), test::planar_settings(),
                     test::sample_from({0, 0, 1}));
  run.run(1);
  EXPECT_EQ(run.renderer.internals().probes, nullptr);
  EXPECT_EQ(run.frame.counters.rays[RayKind::probe], 0);
  EXPECT_EQ(run.frame.times[Stage::probe_rays], 0);
  EXPECT_EQ(run.frame.times[Stage::indirect_light], 0);
}

TEST(ProbeVolumeTest, SettingsOutOfRangeAreRefused) {
  const auto refuse = [](const auto& spoil) {
    RenderSettings settings = test::probe_settings();
    spoil(settings.probes);
    EXPECT_THROW(Renderer(room(), test::single_view(8, 8, 40, 40), settings, false), std::invalid_argument);
  };
  refuse([](ProbeSettings& p) { p.rays = 7; });
  refuse([](ProbeSettings& p) { p.rays = 513; });
  refuse([](ProbeSettings& p) { p.budget = -1; });
  refuse([](ProbeSettings& p) { p.hysteresis_tau_s = -1; });
  refuse([](ProbeSettings& p) { p.normal_bias = 1.5; });
  refuse([](ProbeSettings& p) { p.view_bias = -0.1; });
}

}  // namespace
}  // namespace herr
