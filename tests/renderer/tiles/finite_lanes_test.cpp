// What debug builds ask after each stage: is everything finite that it has filled?
#include "renderer/tiles/finite_lanes.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "tests/renderer/rendered_frames.h"
#include "tests/renderer/test_scenes.h"

namespace herr {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
constexpr int kHits = 3;

// An object, a catcher, and a ray that left the scene; every lane is 0.
std::unique_ptr<HitBatch> three_hits() {
  auto hits = std::make_unique<HitBatch>();
  hits->kind[0] = static_cast<int>(HitKind::object);
  hits->kind[1] = static_cast<int>(HitKind::catcher);
  hits->kind[2] = static_cast<int>(HitKind::miss);
  return hits;
}

FramePlan plan_with_everything() {
  FramePlan plan;
  plan.catchers = plan.catcher_mirrors = plan.probes = plan.catcher_probes = plan.refraction = true;
  plan.textures = plan.surface_details = true;
  return plan;
}

TEST(FiniteLanesTest, NamesTheLaneAndTheHitOfAnyStage) {
  struct Case {
    Stage stage;
    float* lane;
    const char* found;
  };
  const auto hits = three_hits();
  const FramePlan plan = plan_with_everything();
  for (const Case& one : {Case{Stage::surfaces, &hits->position.z[0], "position.z of hit 0"},
                          Case{Stage::second_hits, &hits->curvature[1], "curvature of hit 1"},
                          Case{Stage::probe_rays, &hits->held_back[0], "held_back of hit 0"},
                          Case{Stage::light_rays, &hits->direct_without.x[1], "direct_without.x of hit 1"},
                          Case{Stage::occlusion, &hits->open[0], "open of hit 0"},
                          Case{Stage::indirect_light, &hits->indirect.y[1], "indirect.y of hit 1"},
                          Case{Stage::second_light, &hits->mirrored.z[1], "mirrored.z of hit 1"}}) {
    EXPECT_EQ(first_not_finite(*hits, kHits, one.stage, plan), "") << one.found;
    *one.lane = kNan;
    EXPECT_EQ(first_not_finite(*hits, kHits, one.stage, plan), std::string(one.found) + " is nan");
    *one.lane = kInf;
    EXPECT_EQ(first_not_finite(*hits, kHits, one.stage, plan), std::string(one.found) + " is inf");
    *one.lane = 0;
  }
  EXPECT_THROW(first_not_finite(*hits, kHits, Stage::overlays, plan), std::logic_error);
}

TEST(FiniteLanesTest, WhatNoStageReadsMayHoldAnything) {
  const auto hits = three_hits();
  FramePlan plan = plan_with_everything();
  hits->direct.x[2] = kNan;          // the ray met nothing
  hits->direct.x[kHits] = kNan;      // beyond the last hit
  hits->direct_without.x[0] = kNan;  // of catchers alone
  EXPECT_EQ(first_not_finite(*hits, kHits, Stage::light_rays, plan), "");
  plan.catchers = plan.probes = plan.surface_details = false;
  hits->direct_without.x[1] = hits->indirect.x[0] = hits->f90[0] =
      kNan;  // lanes that the plan has no use for
  for (const Stage stage : {Stage::surfaces, Stage::light_rays, Stage::indirect_light}) {
    EXPECT_EQ(first_not_finite(*hits, kHits, stage, plan), "");
  }
}

TEST(FiniteLanesTest, FindsNumbersInARowAndHalfFloatsByTheirBits) {
  const std::vector<float> numbers{0, 1, -kInf};
  EXPECT_EQ(first_not_finite(numbers, "mean"), "mean, number 2 is -inf");
  EXPECT_EQ(first_not_finite(std::span(numbers).first(2), "mean"), "");
  std::vector<std::uint16_t> halfs{0x7bff, 0xfbff, 0x8000};  // the largest, the least, -0
  EXPECT_EQ(first_not_finite(halfs, "row 3"), "");
  for (const std::uint16_t bits :
       std::initializer_list<std::uint16_t>{0x7c00, 0xfc00, 0x7e01}) {  // inf, -inf, NaN
    halfs[1] = bits;
    EXPECT_EQ(first_not_finite(halfs, "row 3"), "row 3, half 1 is not finite");
  }
}

// No scene that passed validation has such a material.
TEST(FiniteLanesTest, AStageThatLeavesNanStopsDebugBuildsByNameAndIsCountedElsewhere) {
  Scene scene;
  test::add(scene, test::quad({-1, -1, -2}, {2, 0, 0}, {0, 2, 0}), test::glowing({1, kNan, 1}));
  const auto frame = [&] {
    return test::render(scene, test::single_view(8, 8, 10, 10), test::planar_settings(),
                        test::sample_from({0, 0, 0}));
  };
  if constexpr (kStagesAreChecked) {
    try {
      frame();
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::logic_error& error) {
      EXPECT_STREQ(error.what(), "stage surfaces: emission.y of hit 0 is nan");
    }
  } else {
    EXPECT_EQ(frame().counters.nonfinite_values, 64);
  }
}

}  // namespace
}  // namespace herr
