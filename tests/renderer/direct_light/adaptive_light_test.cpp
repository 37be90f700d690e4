// Light samples that are spent only where they disagree: how many rays they save, and the order of strata.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <vector>

#include "renderer/direct_light/light_records.h"
#include "renderer/direct_light/strata_order.h"
#include "renderer/tiles/place_ranks.h"
#include "tests/renderer/direct_light/penumbra_error.h"

namespace herr {
namespace {

using test::edge_scene;
using test::penumbra_error;

TEST(AdaptiveLightTest, APenumbraKeepsItsErrorAndTheRestOfTheFloorTracesFewerRays) {
  FrameCounters all, adaptive;
  const double error_all = penumbra_error({0.3f, 0, 0.3f}, 64, 0, &all);
  const double error_adaptive = penumbra_error({0.3f, 0, 0.3f}, 64, 8, &adaptive);
  const double saved =
      static_cast<double>(all.rays[RayKind::shadow]) / static_cast<double>(adaptive.rays[RayKind::shadow]);
  std::cout << "mean error " << error_all << " and " << error_adaptive << " with " << saved
            << " times fewer rays\n";
  // The penumbra of a light of 0.3 m is a quarter of the floor that is seen. Were every hit of it to trace 32
  // rays of its own and the others 8, that would be 64 / (0.25 * 32 + 0.75 * 8) = 4.6 times fewer; those that
  // take the rays of hits around them trace 16.
  EXPECT_GT(saved, 4.6);
  EXPECT_LE(error_adaptive, error_all + 1e-3);
}

TEST(AdaptiveLightTest, AsManyFirstSamplesAsThereAreIsTheSamePicture) {
  const Scene scene = edge_scene({1, 0, 1});
  RenderSettings settings = test::small_settings();
  settings.light_samples = 16;
  const RenderedFrame plain =
      test::render(scene, test::small_profile(), settings, test::looking_down({0, 0.9, 0}));
  settings.adaptive_min_samples = 16;
  test::expect_same_bits(
      plain, test::render(scene, test::small_profile(), settings, test::looking_down({0, 0.9, 0})));
}

// What the picture then is: SplitLightTest.
TEST(AdaptiveLightTest, WithoutAnythingInTheWayTheFirstRaysAreAll) {
  Scene scene;
  test::add(scene, test::floor_quad(10), test::matte(glm::vec3{0.5f}));
  scene.lights = {test::light_at({0.2, 2, 0.1}, glm::vec3{4.0f}, {1, 0.5f, 1})};
  RenderSettings settings = test::small_settings();
  settings.light_samples = 64;
  const RenderedFrame plain =
      test::render(scene, test::small_profile(), settings, test::looking_down({0, 1, 0}));
  settings.adaptive_min_samples = 4;
  const RenderedFrame adaptive =
      test::render(scene, test::small_profile(), settings, test::looking_down({0, 1, 0}));
  EXPECT_EQ(plain.counters.rays[RayKind::shadow], 16 * adaptive.counters.rays[RayKind::shadow]);
}

TEST(AdaptiveLightTest, ThePlanSaysWhenTooManySamplesAreAllTraced) {
  const Scene scene = edge_scene({1, 0, 1});
  RenderSettings settings = test::small_settings();
  settings.adaptive_min_samples = 8;
  settings.light_samples = 256;
  EXPECT_TRUE(plan_frame(scene, settings, false).light_sampling(256).adaptive());
  settings.light_samples = 257;
  EXPECT_FALSE(plan_frame(scene, settings, false).light_sampling(257).adaptive());
}

LightRecord ordered_light(const glm::vec3& size, int samples) {
  const std::vector<AreaLight> lamps{test::light_at({0, 2, 0}, glm::vec3{1.0f}, size)};
  std::vector<LightRecord> records;
  light_records(lamps, glm::dvec3{0.0}, {samples, 1, true}, {}, records);
  return records.at(0);
}

TEST(StrataOrderTest, HoldsEachStratumOnce) {
  for (const glm::vec3& size : {glm::vec3{1, 0, 1}, glm::vec3{1, 0.3f, 1}, glm::vec3{0, 2, 0}}) {
    for (const int samples : {2, 12, 30, 64, 256}) {
      const LightRecord light = ordered_light(size, samples);
      const std::set<int> taken(light.order.begin(), light.order.begin() + samples);
      EXPECT_EQ(taken.size(), static_cast<std::size_t>(samples));
      EXPECT_EQ(*taken.rbegin(), samples - 1);
    }
  }
}

// Of 16 x 16 strata, 2^k in a row lie in 2^k different parts of the lamp: halves, quarters, ... of 16 parts
// of 4 x 4 strata, and of 64 of 2 x 2.
TEST(StrataOrderTest, AnyFewInARowLieInDifferentPartsOfTheLamp) {
  const LightRecord light = ordered_light({1, 0, 1}, 256);
  ASSERT_EQ(light.strata[0], 16);
  ASSERT_EQ(light.strata[2], 16);
  for (const int parts_along : {2, 4, 8}) {
    const int row = parts_along * parts_along, edge = 16 / parts_along;
    for (int begin = 0; begin < 256; ++begin) {
      std::set<int> parts;
      for (int i = 0; i < row; ++i) {
        const int stratum = light.order[static_cast<std::size_t>((begin + i) % 256)];
        parts.insert(stratum % 16 / edge + parts_along * (stratum / 16 / edge));
      }
      EXPECT_EQ(parts.size(), static_cast<std::size_t>(row)) << parts_along << " from " << begin;
    }
  }
}

TEST(PlaceRanksTest, EveryWindowOfFourByFourHoldsEachOnce) {
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      std::set<int> ranks;
      for (int i = 0; i < 16; ++i) ranks.insert(rank_of_place(x + i % 4, y + i / 4));
      EXPECT_EQ(ranks.size(), 16u);
      EXPECT_EQ(column_of_rank(rank_of_place(x, y)), x);
      EXPECT_EQ(row_of_rank(rank_of_place(x, y)), y);
    }
  }
}

}  // namespace
}  // namespace herr
