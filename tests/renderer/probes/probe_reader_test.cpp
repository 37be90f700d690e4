// What probes know, as it is handed to people, against geometry and light that are known exactly.
#include "renderer/probes/probe_reader.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/renderer/probes/probe_scenes.h"

namespace herr {
namespace {

const DisplayProfile& view() {
  static const DisplayProfile profile = test::single_view(4, 4, 40, 40);
  return profile;
}

// A room of 4 x 2 x 6 m with one probe in its middle.
Scene room() {
  Scene scene;
  test::add(scene, test::box({-2, -1, -3}, {2, 1, 3}), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({0, 0.5, 0}, glm::vec3{3.0f})};
  scene.probes.counts = {1, 1, 1};
  return scene;
}

// A node's inverse distance, in the norm |x| + |y| + |z|, is kept in steps of 1 / (65535 * nearest), nearest
// = 0.1 of the smallest spacing, here 2 m. Half a step of error over the distance s in that norm is s / (2 *
// 65535 * 0.2) of it. Rays look 1.7e-4 rad past their nodes: across a wall that is seen at an angle,
// tan(angle) * 1.7e-4 of the distance, and no wall is seen at more than 80 degrees here.
TEST(ProbeReaderTest, DistancesAreThoseToTheWallsOfARoom) {
  test::ProbeRun run(room(), view(), test::probe_settings(), test::sample_from({0, 0, 0}));
  run.run(1);
  const ProbeReader probes = *run.renderer.probes();
  EXPECT_EQ(probes.position(0), glm::dvec3(0.0));
  EXPECT_FALSE(probes.relocated(0));
  ProbeReader::Sight sight;
  probes.sight(0, 0, sight);
  const glm::dvec3 half{2, 1, 3};
  for (int node = 0; node < DistanceNodes::kCount; ++node) {
    const glm::dvec3 d = DistanceNodes::direction(node);
    const glm::dvec3 to_walls = half / glm::max(glm::abs(d), glm::dvec3{1e-9});
    const double expected = std::min({to_walls.x, to_walls.y, to_walls.z});
    const double norm = expected * (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    const double tolerance = expected * (norm / (2 * 65535 * 0.2) + 1.7e-4 * std::tan(80 * 0.01745));
    ASSERT_NEAR(double{sight.distance_m[static_cast<std::size_t>(node)]}, expected, tolerance) << node;
    ASSERT_GE(sight.deviation_per_m[static_cast<std::size_t>(node)], 0.0f);
  }
}

// Above a floor in an environment of radiance 1, all 64 rays of the upper half see 1: pi W/m^2 for a surface
// that looks up, to 13 bits of packing. One that looks down sees a floor that sends back its albedo's share.
TEST(ProbeReaderTest, IrradianceUnderAnEvenSkyIsPi) {
  Scene scene;
  test::add(scene, test::floor_quad(50), test::matte(glm::vec3{0.25f}));
  scene.environment = glm::vec3{1.0f};
  scene.probes = {{1, 1, 1}, Bounds{{-1, -1, -1}, {1, 2, 1}}};
  test::ProbeRun run(scene, view(), test::probe_settings(0), test::sample_from({0, 1, 0}));
  run.run(20);
  const ProbeReader probes = *run.renderer.probes();
  ProbeReader::Light light;
  probes.irradiance(0, 0, light);
  const auto towards = [&](const glm::dvec3& direction) {
    int best = 0;
    for (int node = 0; node < LightNodes::kCount; ++node) {
      if (glm::dot(LightNodes::direction(node), direction) > glm::dot(LightNodes::direction(best), direction))
        best = node;
    }
    return double{light[static_cast<std::size_t>(best)].y};
  };
  EXPECT_NEAR(towards({0, 1, 0}), glm::pi<double>(), glm::pi<double>() / (1 << 13));
  // Radiance of the floor: scattered_share(0.25) = 0.28 of the sky; the rim of the floor is 50 m away and
  // seen at less than 2 degrees, which weighs sin^2(2 degrees) = 0.0012.
  EXPECT_NEAR(towards({0, -1, 0}), 0.28 * glm::pi<double>(), 0.03 * glm::pi<double>());
}

TEST(ProbeReaderTest, StatesAddUpToTheCountsOfAFrame) {
  Scene scene;
  test::add(scene, test::floor_quad(8), test::matte(glm::vec3{0.5f}));
  test::add(scene, test::box({-1, 0.01f, -1}, {1, 2, 1}), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({3, 5, 3}, glm::vec3{10.0f})};
  scene.probes = {{16, 16, 16}, Bounds{{-8, -1, -8}, {8, 7, 8}}};
  test::ProbeRun run(scene, view(), test::probe_settings(), test::sample_from({0, 3, 6}));
  run.run(40);
  const ProbeReader probes = *run.renderer.probes();
  std::int64_t active = 0, dark = 0, far = 0, relocated = 0;
  ProbeReader::Light light;
  for (int probe = 0; probe < probes.grid().size(); ++probe) {
    active += probes.state(probe) == ProbeState::active;
    far += probes.state(probe) == ProbeState::far;
    relocated += probes.relocated(probe);
    const glm::dvec3 moved = glm::abs(probes.position(probe) - probes.grid().lower -
                                      probes.grid().position(probes.grid().place(probe)));
    // Half a metre between probes; places are kept in float.
    EXPECT_EQ(probes.relocated(probe), glm::length(moved) > 1e-5) << probe;
    if (probes.state(probe) != ProbeState::dark) continue;
    ++dark;
    probes.irradiance(0, probe, light);
    for (const glm::vec3& e : light) ASSERT_LE(e.y, 1e-7f) << probe;
  }
  EXPECT_EQ(active, run.frame.probes.active);
  EXPECT_EQ(dark + far, run.frame.probes.inactive);
  EXPECT_EQ(relocated, run.frame.probes.relocated);
  EXPECT_GE(dark, 256) << "those below the floor";
}

TEST(ProbeReaderTest, ThereIsNoneWithoutProbes) {
  Renderer renderer(room(), view(), test::planar_settings(), false);
  EXPECT_FALSE(renderer.probes().has_value());
}

}  // namespace
}  // namespace herr
