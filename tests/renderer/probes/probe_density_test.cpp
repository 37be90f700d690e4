// Probes along each axis, against those that the scene asks for.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>

#include "tests/renderer/probes/probe_scenes.h"

namespace herr {
namespace {

using Counts = std::array<int, 3>;

std::int64_t product(const Counts& n) {
  return std::int64_t{n[0]} * n[1] * n[2];
}

TEST(ProbeDensityTest, CountsAreScaledAlongEachAxisAndRounded) {
  EXPECT_EQ(probe_counts_at({16, 8, 16}, 1), (Counts{16, 8, 16}));
  EXPECT_EQ(probe_counts_at({16, 8, 16}, 2), (Counts{32, 16, 32}));
  EXPECT_EQ(probe_counts_at({16, 8, 16}, 0.5), (Counts{8, 4, 8}));
  EXPECT_EQ(probe_counts_at({1, 3, 5}, 0.125), (Counts{1, 1, 1}));  // 0.125, 0.375, 0.625
  EXPECT_EQ(probe_counts_at({7, 5, 6}, 1.5), (Counts{11, 8, 9}));   // 10.5, 7.5, 9
  EXPECT_EQ(probe_counts_at({65536, 1, 1}, 1), (Counts{65536, 1, 1}));
}

// Steps of 1 %: counts stay within a hundredth, and a half for rounding, of the largest density that fits.
TEST(ProbeDensityTest, NeverMoreThanTheMostAndNearlyAsMany) {
  EXPECT_GE(probe_counts_at({65536, 1, 1}, 8)[0], 64880);  // 65536 * 0.99
  constexpr std::uint32_t kSeed = 5;
  std::mt19937 random(kSeed);
  for (int i = 0; i < 2000; ++i) {
    Counts counts;
    do {
      for (int& n : counts) n = 1 + static_cast<int>(random() % (1u << (random() % 12)));
    } while (product(counts) > kMostProbes);
    const double density = 0.125 + static_cast<double>(random() % 64) / 8;
    const Counts scaled = probe_counts_at(counts, density);
    ASSERT_LE(product(scaled), kMostProbes) << "seed " << kSeed << ", set " << i;
    double wanted = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_GE(scaled[axis], 1);
      ASSERT_LE(scaled[axis], std::max(1.0, counts[axis] * density + 0.5));
      wanted *= counts[axis] * density + 0.5;
    }
    if (wanted > kMostProbes) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_GE(scaled[axis], counts[axis] * density - 0.5) << "seed " << kSeed << ", set " << i;
    }
  }
}

TEST(ProbeDensityTest, ARendererHasAsManyProbesAsItsDensitySays) {
  Scene scene;
  test::add(scene, test::box({-2, -1, -2}, {2, 1, 2}), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({0, 0.5, 0}, glm::vec3{3.0f})};
  scene.probes.counts = {4, 2, 6};
  for (const auto& [density, counts] :
       {std::pair{0.5, glm::ivec3{2, 1, 3}}, {1.0, {4, 2, 6}}, {1.5, {6, 3, 9}}}) {
    RenderSettings settings = test::probe_settings();
    settings.probes.density = density;
    test::ProbeRun run(scene, test::single_view(4, 4, 40, 40), settings, test::sample_from({0, 0, 0}));
    run.run(1);
    EXPECT_EQ(run.volume().grid.counts, counts);
    EXPECT_EQ(run.frame.counters.rays[RayKind::probe],
              64 * static_cast<std::int64_t>(run.frame.probes.updated));
    EXPECT_EQ(run.frame.probes.active + run.frame.probes.inactive, counts.x * counts.y * counts.z);
  }
}

}  // namespace
}  // namespace herr
