// Indirect light against closed forms: the integrating sphere, its recurrence, the white furnace.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/probes/probe_scenes.h"
#include "tests/renderer/probes/scalar_probes.h"

namespace herr {
namespace {

constexpr double kIntensity = 1.0, kRadius = 1.0;

Scene integrating_sphere(double albedo, const glm::dvec3& light = {0, 0, 0}) {
  Scene scene;
  test::add(scene, test::sphere({0, 0, 0}, kRadius, 24, 48),
            test::matte(glm::vec3{static_cast<float>(albedo)}));
  scene.lights = {test::light_at(light, glm::vec3{kIntensity})};
  scene.probes.counts = {8, 6, 8};
  return scene;
}

RenderSettings without_probes() {
  RenderSettings settings = test::planar_settings();
  settings.probes.on = false;
  return settings;
}

const DisplayProfile& view() {
  static const DisplayProfile profile = test::single_view(32, 32, 40, 40);
  return profile;
}

// The mean of I cos / d^2 over a closed sphere is I / R^2 wherever the light stands in it: flux 4 pi I over
// area 4 pi R^2. Each bounce returns rho of it, evenly: L = sum over n >= 1 of rho^n E0 / pi.
TEST(ProbeLightTest, AClosedSphereGathersTheGeometricSeriesOfBounces) {
  for (const double albedo : {0.2, 0.5, 0.8, 0.95}) {
    for (const glm::dvec3& light : {glm::dvec3{0, 0, 0}, glm::dvec3{0.3, 0.2, 0.1}}) {
      SCOPED_TRACE(testing::Message() << "albedo " << albedo << ", light at " << light.x);
      const Scene scene = integrating_sphere(albedo, light);
      const FrameSample sample = test::sample_from({0, 0, 0});
      test::ProbeRun run(scene, view(), test::probe_settings(0), sample);
      run.run(static_cast<int>(6 / (1 - albedo)));  // what is missing shrinks by the albedo a frame: e^-6
      const RenderedFrame direct = test::render(scene, view(), without_probes(), sample);
      const double mean =
          test::mean_of(test::indirect_of_pixels(run.frame.viewports[0], direct.viewports[0], albedo));
      const double expected = albedo / (1 - albedo) * kIntensity / (kRadius * kRadius) / glm::pi<double>();
      EXPECT_NEAR(mean, expected, 0.02 * expected);
    }
  }
}

// A surface that meets nothing but an environment of radiance 1 sends back all of it.
TEST(ProbeLightTest, AWhiteObjectInAWhiteFurnaceCannotBeSeen) {
  for (const bool ball : {true, false}) {
    SCOPED_TRACE(ball ? "ball" : "box");
    Scene scene;
    test::add(scene, ball ? test::sphere({0, 0, -3}, 1) : test::box({-1, -1, -4}, {1, 1, -2}),
              test::matte(glm::vec3{1.0f}));
    scene.environment = glm::vec3{1.0f};
    test::ProbeRun run(scene, view(), test::probe_settings(0.05), test::sample_from({0.2, 0.3, 0}));
    run.run(40);
    double lowest = 2, highest = 0;
    test::for_each_pixel(run.frame.viewports[0], [&](int, int, const test::Pixel& pixel) {
      lowest = std::min(lowest, pixel[1]), highest = std::max(highest, pixel[1]);
    });
    EXPECT_GT(lowest, 0.99);
    EXPECT_LT(highest, 1.01);
  }
}

// Every look-up of a frame, kernel against scalar, on smooth and flat surfaces with neighbours in and out of
// sight. The kernels work in float: sight falls with the ninth power of a bound, so its relative error is
// some tens of 2^-23 times distances over tolerances, up to 100.
TEST(ProbeLightTest, LookUpsAgreeWithTheScalarOnes) {
  Scene scene;
  test::add(scene, test::box({-2, -1, -3}, {2, 1.5f, 1}), test::matte({0.7f, 0.5f, 0.3f}));
  test::add(scene, test::sphere({0.3f, -0.2f, -1.5f}, 0.6f), test::matte({0.2f, 0.6f, 0.8f}));
  test::add(scene, test::quad({-1, -1, -2.5f}, {0.9f, 0, 0.4f}, {0, 1.2f, 0.1f}),
            test::matte(glm::vec3{0.9f}));
  scene.lights = {test::light_at({0.5, 1, 0}, {3, 2, 1})};
  scene.environment = {0.1f, 0.2f, 0.3f};
  for (const Isa isa : test::offered_isas()) {
    RenderSettings settings = test::probe_settings();
    settings.threads = 1;
    settings.isa = isa;
    settings.probes.view_bias = 0.1;
    test::ProbeRun run(scene, view(), settings, test::sample_from({0, 0, 0.8}));
    run.run(10);
    Renderer::Impl& impl = run.renderer.internals();
    impl.run_tile(0, 0, nullptr);
    const HitBatch& hits = impl.tile_scratch[0]->first;
    const ProbeView& probes = impl.probe_views[0];
    int compared = 0;
    for (std::size_t i = 0; i < 32 * 32; ++i) {
      if (hits.kind[i] != static_cast<int>(HitKind::object)) continue;
      const glm::dvec3 position{hits.position.x[i], hits.position.y[i], hits.position.z[i]};
      const glm::dvec3 lower{probes.lower[0], probes.lower[1], probes.lower[2]};
      const glm::dvec3 expected = test::scalar_lookup(
          probes, glm::dvec3(scene.environment),
          {position - lower,
           {hits.normal.x[i], hits.normal.y[i], hits.normal.z[i]},
           {hits.geometric_normal.x[i], hits.geometric_normal.y[i], hits.geometric_normal.z[i]},
           {hits.viewer.x[i], hits.viewer.y[i], hits.viewer.z[i]}});
      ASSERT_NEAR(hits.indirect.x[i], expected.x, 1e-3 * expected.x + 1e-7) << i;
      ASSERT_NEAR(hits.indirect.y[i], expected.y, 1e-3 * expected.y + 1e-7) << i;
      ASSERT_NEAR(hits.indirect.z[i], expected.z, 1e-3 * expected.z + 1e-7) << i;
      ++compared;
    }
    EXPECT_EQ(compared, 32 * 32);
  }
}

}  // namespace
}  // namespace herr
