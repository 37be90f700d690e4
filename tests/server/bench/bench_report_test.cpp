#include "server/bench/bench_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace herr {
namespace {

// Averages over all frames stand in `kinds`; `counters` is the last frame, which here saw next to nothing.
BenchResult result_with_an_empty_last_frame() {
  BenchResult result;
  result.kinds = {{"primary", 1000, 0.5, 0, 0},
                  {"shadow", 600, 0.3, 0, 0},
                  {"catcher_shadow", 200, 0.1, 0, 0},
                  {"mirror", 100, 0.05, 0, 0},
                  {"mirror_shadow", 50, 0.025, 0, 0}};
  for (const Stage stage : {Stage::first_hits, Stage::light_rays, Stage::second_hits, Stage::second_light,
                            Stage::resolve, Stage::viewports}) {
    result.median_times[stage] = 1;
  }
  result.counters.rays[RayKind::primary] = 1;
  result.counters.polar_samples = 1;
  result.counters.viewport_pixels = 4000;  // the same in every frame
  return result;
}

TEST(BenchReport, TimePerItemIsOverTheItemsOfTheAverageFrame) {
  const auto json = bench_json(result_with_an_empty_last_frame(), BenchSubject());
  const auto& stages = json["stages"];
  // 1 ms over 1000 rays, 600 + 200, 100 and 50 rays, 1000 / 0.5 samples, 4000 pixels.
  EXPECT_DOUBLE_EQ(stages["first_hits"]["ns_per_item"].get<double>(), 1000);
  EXPECT_DOUBLE_EQ(stages["light_rays"]["ns_per_item"].get<double>(), 1250);
  EXPECT_DOUBLE_EQ(stages["second_hits"]["ns_per_item"].get<double>(), 10'000);
  EXPECT_DOUBLE_EQ(stages["second_light"]["ns_per_item"].get<double>(), 20'000);
  EXPECT_DOUBLE_EQ(stages["resolve"]["ns_per_item"].get<double>(), 500);
  EXPECT_DOUBLE_EQ(stages["viewports"]["ns_per_item"].get<double>(), 250);
  EXPECT_EQ(json["polar_samples"], 2000);
}

}  // namespace
}  // namespace herr
