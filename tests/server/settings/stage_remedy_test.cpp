// Each stage with its flags, and all of them together.
#include "server/settings/stage_remedy.h"

#include <gtest/gtest.h>

#include <string>

namespace herr {
namespace {

TEST(StageRemedy, IsTheFlagThatLeavesTheStageOut) {
  EXPECT_EQ(stage_remedy(Stage::probe_rays, 1), "--no-probes leaves it out");
  EXPECT_EQ(stage_remedy(Stage::probe_update, 1), "--no-probes leaves it out");
  EXPECT_EQ(stage_remedy(Stage::indirect_light, 1), "--no-probes leaves it out");
  EXPECT_EQ(stage_remedy(Stage::occlusion, 1), "--occlusion-rays 0 leaves it out");
  EXPECT_EQ(stage_remedy(Stage::second_hits, 1), "--no-reflections --no-refraction leave it out");
  EXPECT_EQ(stage_remedy(Stage::second_light, 1), "--no-reflections --no-refraction leave it out");
  EXPECT_EQ(stage_remedy(Stage::edges, 1), "--edge-samples 0 leaves it out");
  EXPECT_EQ(stage_remedy(Stage::viewports, 0.5), "a smaller --profile-scale makes it shorter");
  EXPECT_EQ(stage_remedy(Stage::viewports, 0.1), "a --profile of fewer pixels makes it shorter");
  EXPECT_EQ(stage_remedy(Stage::first_hits, 1), "");
}

// Of 100 ms: occlusion 30, probes 4 + 6 (the second is enough), second hits 4.9 (too little).
TEST(StageRemedy, TogetherAreThoseOfTheStagesThatTakeATwentieth) {
  StageTimes mean;
  mean.frame_ms = 100;
  mean[Stage::first_hits] = 50;
  mean[Stage::probe_rays] = 4, mean[Stage::probe_update] = 6;
  mean[Stage::occlusion] = 30;
  mean[Stage::second_hits] = 4.9;
  EXPECT_EQ(flags_text(changes_without_long_stages(mean)), "--no-probes --occlusion-rays 0");
  EXPECT_TRUE(changes_without_long_stages(StageTimes{.frame_ms = 100}).empty());
}

}  // namespace
}  // namespace herr
