// Relations of light, samples and surfaces hold on a small scene, and see what is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "server/study/relations/light/plain_scene.h"
#include "server/study/relations/light/seed_means.h"
#include "server/study/relations/picture_distance.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_groups.h"
#include "tests/server/study/relations/light/lit_case.h"

namespace herr {
namespace {

using Measure = void (*)(const RelationCase&, RelationLog&);

std::map<std::string, RelationResult> results_of(Measure measure, const RelationCase& subject) {
  RelationLog log;
  log.begin_group("any");
  measure(subject, log);
  std::map<std::string, RelationResult> results;
  for (const RelationResult& result : log.results()) {
    EXPECT_TRUE(results.emplace(result.relation.name, result).second) << "twice: " << result.relation.name;
  }
  return results;
}

void expect_all_asked_hold(const std::map<std::string, RelationResult>& results) {
  for (const auto& [name, result] : results) {
    EXPECT_TRUE(result.holds()) << name << ": " << result.error << " of " << result.relation.bound << " "
                                << result.where;
  }
}

TEST(LightRelationsTest, LightAddsUpOnASmallScene) {
  const auto results = results_of(measure_light, test::case_of(test::lit_scene()));
  expect_all_asked_hold(results);
  EXPECT_EQ(results.at("hard light over the camera feed").not_applicable, "the session has no camera feed");
  for (const char* name : {"hard light times 4", "all light times 10", "sum of lights",
                           "light near a surface stays below I / r^2", "light gives numbers",
                           "light in the plane of a surface stays below I / r^2",
                           "light near a surface gives numbers", "light above a surface lights it"}) {
    ASSERT_TRUE(results.at(name).asked()) << name;
  }
  // White surfaces near the light are seen: at least a tenth of what is allowed.
  const auto& pictures = results.at("light near a surface stays below I / r^2").pictures;
  ASSERT_TRUE(pictures);
  EXPECT_GT(largest_value({pictures->got}), 0.1);
}

TEST(LightRelationsTest, OverAFeedLightIsAffineWhereCatchersAre) {
  Scene scene = test::lit_scene();
  scene.instances[0].catcher = true;
  RelationCase subject = test::case_of(std::move(scene));
  const auto camera = test::TestCamera::pinhole(16, 12, 45, [](int, int) {
    return std::array<std::uint16_t, 4>{0x3800, 0x3800, 0x3800, 0x3c00};
  });
  camera.attach_to(subject.sample);
  subject.camera = true;
  const auto results = results_of(measure_light, subject);
  expect_all_asked_hold(results);
  EXPECT_TRUE(results.at("hard light over the camera feed").asked());
  EXPECT_TRUE(results.at("virtual lights over the camera feed").asked());
}

TEST(LightRelationsTest, WithoutLightNothingIsAsked) {
  Scene scene = test::lit_scene();
  scene.lights.clear();
  scene.ambient = scene.environment = glm::vec3(0.0f);
  const RelationCase subject = test::case_of(std::move(scene));
  const auto light = results_of(measure_light, subject);
  EXPECT_FALSE(light.at("hard light times 4").asked());
  EXPECT_EQ(light.at("sum of lights").not_applicable, "no light");
  EXPECT_EQ(results_of(measure_samples, subject).at("mean with 4 light samples").not_applicable, "no light");
}

TEST(LightRelationsTest, ALampThatLightsNothingSeenIsSaidToShine) {
  Scene scene = test::lit_scene();
  scene.instances.clear();
  scene.ambient = scene.environment = glm::vec3(0.0f);
  const auto light = results_of(measure_light, test::case_of(std::move(scene)));
  EXPECT_EQ(light.at("hard light times 4").not_applicable, "nothing lit is seen");
}

// Lights are boxes along the axes of the world: none of them is flat in a plane that leans by atan(3/4).
TEST(LightRelationsTest, NoLightLiesInAPlaneThatLeans) {
  Scene scene = test::lit_scene();
  scene.instances.clear();
  test::add(scene, test::quad({-8, -3, 2}, {16, 0, 0}, {0, 6, -8}), test::matte({0.6f, 0.5f, 0.4f}));
  const auto light = results_of(measure_light, test::case_of(std::move(scene)));
  expect_all_asked_hold(light);
  EXPECT_EQ(light.at("light in the plane of a surface stays below I / r^2").not_applicable,
            "no surface seen around the gaze lies along the axes that lights have");
  EXPECT_TRUE(light.at("light near a surface stays below I / r^2").asked());
  EXPECT_TRUE(light.at("light above a surface lights it").asked());
}

TEST(LightRelationsTest, APointHasNoSamples) {
  Scene scene = test::lit_scene();
  scene.lights[0].size = glm::vec3(0.0f);
  const auto results = results_of(measure_samples, test::case_of(std::move(scene)));
  EXPECT_EQ(results.at("mean with 4 light samples").not_applicable, "no light that shines has an extent");
}

// A picture that is a sum, with one pixel off by a hundredth of what is added there.
TEST(LightRelationsTest, AnAlteredPictureIsNoSum) {
  LinearPicture one;
  one.width_px = 2, one.height_px = 1;
  for (auto& plane : one.plane) plane = {1, 3};
  std::vector<LinearPicture> got{one}, wanted{one}, sum{one};
  for (auto& plane : sum[0].plane) plane = {3, 9};
  DisplayProfile profile = test::single_view(2, 1, 45, 45);
  EXPECT_EQ(largest_of_sum(got, wanted, sum, 1e-3, profile).error, 0);
  got[0].plane[1][1] += 0.09f;
  EXPECT_NEAR(largest_of_sum(got, wanted, sum, 1e-3, profile).error, 0.01, 1e-4);
}

TEST(SamplesRelationsTest, MeansStayOnASmallScene) {
  auto results = results_of(measure_samples, test::case_of(test::lit_scene()));
  const RelationResult adaptive = results.at("mean with adaptive light samples");
  EXPECT_EQ(adaptive.relation.option, "adaptive light samples");
  EXPECT_FALSE(adaptive.counts());
  results.erase("mean with adaptive light samples");
  expect_all_asked_hold(results);
  for (const auto& [name, result] : results) EXPECT_TRUE(result.asked()) << name << result.not_applicable;
}

TEST(SamplesRelationsTest, AdaptiveSamplesOfTheRunCount) {
  RelationCase subject = test::case_of(test::lit_scene());
  subject.settings.adaptive_min_samples = 8;
  EXPECT_TRUE(results_of(measure_samples, subject).at("mean with adaptive light samples").counts());
}

SeedRows rows_of(const RelationCase& subject, std::uint32_t first) {
  const auto renderer = renderer_of(subject);
  next_picture(*renderer, subject);
  SeedRows rows(16);
  for (std::uint32_t i = 0; i < 16; ++i) {
    for (const LinearPicture& picture : picture_of_seed(*renderer, subject, first + i)) {
      for (const auto& plane : picture.plane) rows[i].insert(rows[i].end(), plane.begin(), plane.end());
    }
  }
  return rows;
}

// Samples that never reach the last eighth of the light, as if its last column of strata were left out: a
// lamp that is narrower on that side.
TEST(SamplesRelationsTest, ALightWithoutItsLastColumnIsFound) {
  RelationCase whole = soft_light(test::case_of(test::lit_scene()), 16);
  make_matte(whole.scene);
  RelationCase narrower = whole;
  AreaLight& light = narrower.state.lights[0];
  light.centre.x -= 0.5 * 0.125 * static_cast<double>(light.size.x);
  light.size.x *= 0.875f;
  const SeedRows reference = rows_of(whole, 101);
  EXPECT_LE(mean_difference(rows_of(whole, 1), reference, 0x1p-9).worst(), 4);
  EXPECT_GT(mean_difference(rows_of(narrower, 1), reference, 0x1p-9).worst(), 4);
}

TEST(SurfacesRelationsTest, HoldOnASmallScene) {
  const auto results = results_of(measure_surfaces, test::case_of(test::lit_scene()));
  expect_all_asked_hold(results);
  for (const auto& [name, result] : results) EXPECT_TRUE(result.asked()) << name << result.not_applicable;
}

TEST(SurfacesRelationsTest, GlassBeforeTheSkyCannotBeSeenEither) {
  Scene scene = test::lit_scene();
  scene.instances.erase(scene.instances.begin() + 1);  // the wall
  const auto results = results_of(measure_surfaces, test::case_of(std::move(scene)));
  expect_all_asked_hold(results);
  EXPECT_TRUE(results.at("index of refraction 1").asked());
}

// Rays follow 12 surfaces, 7 panes have 14: half of them stay.
TEST(SurfacesRelationsTest, AsManyPanesAreAskedAsRaysFollow) {
  Scene scene = test::lit_scene();
  Material glass = test::matte({1, 1, 1});
  glass.roughness = 0;
  glass.transmission = 1;
  for (int pane = 0; pane < 7; ++pane) {
    const float z = -0.4f - 0.1f * static_cast<float>(pane);
    test::add(scene, test::box({-1, 0.3f, z}, {1, 1.5f, z + 0.02f}), glass);
  }
  const auto results = results_of(measure_surfaces, test::case_of(std::move(scene)));
  expect_all_asked_hold(results);
  const RelationResult& panes = results.at("index of refraction 1");
  EXPECT_TRUE(panes.asked());
  EXPECT_TRUE(panes.where.starts_with("4 of 8 clear bodies")) << panes.where;
}

TEST(SurfacesRelationsTest, WithoutGlassItsIndexIsNotAsked) {
  Scene scene = test::lit_scene();
  scene.instances.pop_back();
  const auto results = results_of(measure_surfaces, test::case_of(std::move(scene)));
  EXPECT_EQ(results.at("index of refraction 1").not_applicable, "no material is transparent");
  EXPECT_EQ(results.at("index of refraction 10").not_applicable, "no material is transparent");
}

// Light times 4 of a lamp that is 4 times as bright already, and so on: what moderate_light does is a factor.
TEST(PlainSceneTest, ModerateLightLeavesThePicture) {
  for (const float factor : {1e-9f, 1.0f, 1e8f}) {
    RelationCase subject = hard_light(test::case_of(test::lit_scene()));
    show_plainly(subject);
    scale_light(subject, factor);
    const double brightest = moderate_light(subject);
    EXPECT_GE(brightest, 0.125) << factor;
    EXPECT_LT(brightest, 0.25) << factor;
    EXPECT_NEAR(largest_value(picture_of(subject)), brightest, 1e-3 * brightest) << factor;
  }
}

}  // namespace
}  // namespace herr
