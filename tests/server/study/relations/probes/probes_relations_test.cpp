// Relations of probes and of threads hold in a closed room, and say why they are not asked.
#include <gtest/gtest.h>

#include <algorithm>

#include "server/study/relations/probes/probe_memory.h"
#include "server/study/relations/relation.h"
#include "server/study/relations/relation_case.h"
#include "server/study/relations/relation_groups.h"

namespace herr {
namespace {

// A room of 4 x 2.5 x 5 m with a ball on its floor, seen from its middle.
RelationCase closed_room() {
  RelationCase subject;
  Scene& scene = subject.scene;
  scene.materials.resize(1);
  scene.materials[0].base_colour = {0.6f, 0.5f, 0.4f};
  Instance room, ball;
  room.kind = ShapeKind::box, ball.kind = ShapeKind::sphere;
  room.world_from_object = glm::dmat4x3(2, 0, 0, 0, 1.25, 0, 0, 0, 2.5, 0, 0, 0);
  ball.world_from_object = glm::dmat4x3(0.4, 0, 0, 0, 0.4, 0, 0, 0, 0.4, 0.5, -0.85, -1.5);
  scene.instances = {room, ball};
  AreaLight lamp;
  lamp.centre = {0.8, 0.9, -1};
  lamp.size = {0.4f, 0.1f, 0.4f};
  lamp.intensity_w_sr = glm::vec3{3.0f};
  scene.lights = {lamp};
  scene.probes.counts = {6, 4, 6};
  scene_state_at(scene, 0, subject.state);
  subject.sample.t_ns = 5'000'000'000;
  subject.profile = xr1_half_profile();
  for (Viewport& viewport : subject.profile.viewports) viewport.width_px = viewport.height_px = 32;
  subject.settings.polar_width = 48, subject.settings.polar_height = 48;
  subject.settings.probes.rays = 16;
  return subject;
}

const RelationResult* result_of(const RelationLog& log, const std::string& name) {
  for (const RelationResult& result : log.results()) {
    if (result.relation.name == name) return &result;
  }
  return nullptr;
}

void expect_all_hold(const RelationLog& log) {
  for (const RelationResult& result : log.results()) {
    EXPECT_TRUE(result.holds()) << result.relation.name << ": " << result.error << " of "
                                << result.relation.bound << " " << result.where;
  }
}

TEST(ProbesRelationsTest, HoldInAClosedRoomWhateverProbesRemember) {
  for (const double tau_s : {0.0, 0.01, 0.365, 1e6}) {
    SCOPED_TRACE(tau_s);
    RelationCase subject = closed_room();
    subject.settings.probes.hysteresis_tau_s = tau_s;
    RelationLog log;
    measure_probes(subject, log);
    expect_all_hold(log);
    const RelationResult* steps = result_of(log, "memory of probes does not depend on the step");
    ASSERT_NE(steps, nullptr);
    EXPECT_TRUE(steps->asked());
    // Light is read with 13 bits: something must be seen of their rounding.
    EXPECT_GT(steps->error, 0);
  }
}

// Surfaces that emit 0.01 and reflect 0.99 of 1 shine with 1 again: an irradiance of pi, bounce after bounce.
// With 0.01 more at each, of which the next gives back 0.99, 16 bounces add 1 - 0.99^16 = 0.149.
TEST(ProbesRelationsTest, AFurnaceStaysAsBrightAsItIsAndNoBrighter) {
  RelationCase subject = probe_case(closed_room());
  subject.settings.probes.hysteresis_tau_s = 0;
  for (const float too_much : {0.0f, 0.01f}) {
    RelationCase white = furnace_case(subject, 0.99f);
    white.scene.materials[0].emission += glm::vec3{too_much};
    ProbeMemory glowing(furnace_case(subject, 0)), memory(white);
    glowing.step(glowing.at(0));
    memory.renderer().restore(glowing.renderer().state());
    for (int frame = 1; frame <= 16; ++frame) memory.step(memory.at(frame));
    const double most = brightest(memory.light()) / 3.14159265358979;
    EXPECT_NEAR(most, too_much == 0 ? 1 : 1.149, 3e-3);
  }
}

TEST(ProbesRelationsTest, AreNotAskedWhereNothingIsThereToLight) {
  RelationCase subject = closed_room();
  subject.scene.instances.clear();
  RelationLog log;
  measure_probes(subject, log);
  ASSERT_EQ(log.results().size(), 1u);
  EXPECT_EQ(log.results()[0].not_applicable, "no surface to light");
}

TEST(ProbesRelationsTest, LightsThatAreNotThereAreNotSwitched) {
  RelationCase subject = closed_room();
  subject.scene.lights.clear();
  subject.state.lights.clear();
  subject.scene.materials[0].emission = glm::vec3{0.5f};
  RelationLog log;
  measure_probes(subject, log);
  expect_all_hold(log);
  EXPECT_EQ(result_of(log, "lights switched each frame")->not_applicable, "no light");
}

TEST(ThreadsRelationsTest, HoldInAClosedRoom) {
  RelationLog log;
  measure_threads(closed_room(), log);
  ASSERT_EQ(log.results().size(), 4u);
  expect_all_hold(log);
}

}  // namespace
}  // namespace herr
