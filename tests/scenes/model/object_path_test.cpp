// Paths of objects: placements at times against arithmetic by hand, what a path does among other changes.
#include "scenes/model/object_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scenes/changes/world.h"
#include "scenes/document/parse_change.h"
#include "scenes/load_scene.h"
#include "scenes/model/transform_checks.h"
#include "tests/scenes/document/path_scenes.h"

namespace herr::test {
namespace {

PathKey key(double time_s, const glm::dvec3& translation, const glm::dquat& rotation = {1, 0, 0, 0},
            const glm::dvec3& scale = glm::dvec3(1.0)) {
  return {time_s, {translation, rotation, scale}};
}

TEST(ObjectPathTest, PlacesLieOnLinesAndEndsAreHeld) {
  const ObjectPath path{{key(1, {1, 0, 0}), key(2, {3, 0, 0}, {1, 0, 0, 0}, {2, 2, 4}), key(4, {3, 8, 0})},
                        false};
  EXPECT_EQ(path.at(0).translation, glm::dvec3(1, 0, 0));
  EXPECT_EQ(path.at(1).translation, glm::dvec3(1, 0, 0));
  EXPECT_EQ(path.at(1.25).translation, glm::dvec3(1.5, 0, 0));   // a quarter of the way from 1 to 3
  EXPECT_EQ(path.at(1.25).scale, glm::dvec3(1.25, 1.25, 1.75));  // and from 1 to 2, from 1 to 4
  EXPECT_EQ(path.at(2).scale, glm::dvec3(2, 2, 4));
  EXPECT_EQ(path.at(3).translation, glm::dvec3(3, 4, 0));  // half of two seconds
  EXPECT_EQ(path.at(4), path.keys[2].placement);
  EXPECT_EQ(path.at(1e300), path.keys[2].placement);
}

TEST(ObjectPathTest, ALoopTakesTimeModuloItsLastKey) {
  const ObjectPath path{{key(1, {1, 0, 0}), key(4, {4, 0, 0})}, true};
  EXPECT_EQ(path.at(0.5).translation.x, 1);
  EXPECT_EQ(path.at(3.5).translation.x, 3.5);
  // At 4 it starts again: first a second at the first key, then on.
  for (const double start : {4.0, 8.0, 4e6}) {
    EXPECT_EQ(path.at(start).translation.x, 1) << start;
    EXPECT_EQ(path.at(start + 0.75).translation.x, 1) << start;
    EXPECT_EQ(path.at(start + 2.5).translation.x, 2.5) << start;
  }
  const ObjectPath one{{key(0, {7, 0, 0})}, true};
  EXPECT_EQ(one.at(0).translation.x, 7);
  EXPECT_EQ(one.at(5).translation.x, 7);
}

TEST(ObjectPathTest, RotationsTakeTheShorterArc) {
  // No turn, and a quarter turn about Z written as -q: a third of the way is 30 degrees, so w = cos 15, z =
  // sin 15 degrees. A linear blend of the two would stand at 28.6 degrees.
  const double h = std::sqrt(0.5);
  const ObjectPath path{{key(0, {}), key(3, {}, {-h, 0, 0, -h})}, false};
  const glm::dquat turned = path.at(1).rotation;
  EXPECT_NEAR(turned.w, std::cos(M_PI / 12), 1e-15);
  EXPECT_NEAR(turned.z, std::sin(M_PI / 12), 1e-15);
}

TEST(ObjectPathTest, WhatRestsIsTheSameToTheLastBit) {
  const glm::dquat turn = glm::normalize(glm::dquat(0.3, 0.5, -0.7, 0.1));
  const ObjectPath path{
      {key(0, {0.1, 0.7, -3}, turn, {0.3, 0.3, 0.3}), key(0.7, {0.1, 0.7, -3}, turn, {0.3, 0.3, 0.3}),
       key(0.9, {0.1, 0.7, -3}, -turn, {0.3, 0.3, 0.3})},
      false};
  const glm::dmat4x3 rest = path.at(0).matrix();
  for (int frame = 0; frame < 90; ++frame) EXPECT_EQ(path.at(frame / 90.0).matrix(), rest) << frame;
}

TEST(ObjectPathTest, WhatCanBeTracedAtTwoKeysCanBeTracedBetweenThem) {
  constexpr unsigned kSeed = 20240611;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
  const auto turn = [&] { return glm::normalize(glm::dquat(unit(random), vector())); };
  int tried = 0;
  while (tried < 2000) {
    // Scales from 1e-5 to 1e5 of either sign; parts that stand askew, so that scales shear them.
    const glm::dvec3 signs = glm::sign(vector());
    const auto scale = [&] {
      const glm::dvec3 e = 5.0 * vector();
      return signs * glm::dvec3(std::pow(10, e.x), std::pow(10, e.y), std::pow(10, e.z));
    };
    const ObjectPath path{{key(0, 1e6 * vector(), turn(), scale()), key(1, 1e6 * vector(), turn(), scale())},
                          false};
    const glm::dmat4x3 part = Placement{vector(), turn(), glm::exp(vector())}.matrix();
    const auto problem = [&](double t) { return transform_problem(compose(path.at(t).matrix(), part)); };
    if (problem(0) || problem(1)) continue;
    ++tried;
    const double least =
        std::min(std::abs(determinant(path.at(0).matrix())), std::abs(determinant(path.at(1).matrix())));
    for (int i = 1; i < 32; ++i) {
      const double t = i / 32.0;
      EXPECT_FALSE(problem(t)) << *problem(t) << " at " << t;
      // The product of three numbers that are each linear in t is log-concave: no less than at an end. Its
      // rotation is orthogonal up to some 1e-15.
      EXPECT_GE(std::abs(determinant(path.at(t).matrix())), least * (1 - 1e-12));
    }
  }
}

const Instance& named(const Scene& scene, const std::string& name) {
  for (const Instance& instance : scene.instances) {
    if (instance.name == name || instance.name.substr(0, name.size() + 1) == name + "/") return instance;
  }
  throw std::invalid_argument("no instance " + name);
}

// A place and the image of the x axis, whose length is the scale.
void expect_place(const Instance& instance, const glm::dvec3& place, const glm::dvec3& x_axis) {
  SCOPED_TRACE(instance.name);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(instance.world_from_object[3][axis], place[axis], 1e-14);
    EXPECT_NEAR(instance.world_from_object[0][axis], x_axis[axis], 1e-14);
  }
}

TEST(ObjectPathTest, EveryKindOfEntryFollowsItsPath) {
  const TemporaryFolder folder;
  Scene scene = load_scene(write_kinds(folder));
  EXPECT_TRUE(scene.changes);
  World world(scene);
  world.advance(0);
  // As loaded it stands where the path begins, not where the entry would stand alone. A key without a scale
  // has the entry's: 1 for most, 2 for the cup. The ball's radius is its own, as are the door's two metres.
  expect_place(named(scene, "ball"), {0, 1, 0}, {0.5, 0, 0});
  expect_place(named(scene, "cup"), {0, 1, 0}, {2, 0, 0});
  expect_place(named(scene, "door"), {0, 1, 0}, {1, 0, 0});
  world.advance(1);
  // Half way: x = 2, an eighth of a turn about Z; the scale is half way from the entry's own to 3.
  const glm::dvec3 eighth(std::sqrt(0.5), std::sqrt(0.5), 0);
  expect_place(named(scene, "ball"), {2, 1, 0}, 0.5 * 2 * eighth);
  expect_place(named(scene, "cup"), {2, 1, 0}, 2.5 * eighth);
  expect_place(named(scene, "door"), {2, 1, 0}, 2.0 * eighth);
  world.advance(7);
  const glm::dvec3 quarter(0, 1, 0);
  expect_place(named(scene, "ball"), {4, 1, 0}, 0.5 * 3 * quarter);
  expect_place(named(scene, "cup"), {4, 1, 0}, 3.0 * quarter);
  expect_place(named(scene, "door"), {4, 1, 0}, 3.0 * quarter);
  EXPECT_EQ(named(scene, "crate").world_from_object[3], glm::dvec3(0, 5, 0));
}

void expect_same_places(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].present, b.instances[i].present) << i;
    EXPECT_EQ(a.instances[i].world_from_object, b.instances[i].world_from_object) << i;
  }
}

TEST(ObjectPathTest, AStateDependsOnItsTimeAloneAlsoAfterARestart) {
  const TemporaryFolder folder;
  const auto file = write_kinds(folder);
  Scene often = load_scene(file), once = load_scene(file);
  World slow(often), fast(once);
  for (int frame = 0; frame <= 90; ++frame) slow.advance(frame / 60.0);
  fast.advance(1.5);
  expect_same_places(often, once);
  slow.advance(4);
  slow.restart();
  expect_same_places(often, load_scene(file));
  slow.advance(1.5);
  expect_same_places(often, once);
}

TEST(ObjectPathTest, OnlyWhatStandsElsewhereCountsAsMoved) {
  const TemporaryFolder folder;
  Scene scene = load_scene(write_kinds(folder));
  World world(scene);
  const SlotChanges& changes = world.state().changes;
  EXPECT_EQ(changes.latest(), 0u);  // time 0 is as it was loaded
  world.advance(1);
  std::vector<ChangedSlot> changed;
  changes.since(0, changed);
  std::size_t next = 0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].name == "crate" || !scene.instances[i].present) continue;
    ASSERT_LT(next, changed.size()) << scene.instances[i].name;
    EXPECT_EQ(changed[next].slot, i) << scene.instances[i].name;
    EXPECT_FALSE(changed[next++].renewed) << scene.instances[i].name;
  }
  EXPECT_EQ(next, changed.size());
  world.advance(2);
  const SlotChanges::Number latest = changes.latest();
  for (int frame = 0; frame < 300; ++frame) world.advance(2 + frame / 60.0);  // it rests, and has ended
  EXPECT_EQ(changes.latest(), latest);
}

std::string problem_of(World& world, const std::string& json) {
  const auto problem = world.apply(parse_event(json, "events.jsonl", 7, 0));
  return problem ? problem->what + "; " + problem->remedy : "";
}

TEST(ObjectPathTest, BothModelsOfAVoxFileMoveAsOne) {
  const TemporaryFolder folder;
  Scene scene = load_scene(write_kinds(folder));
  World world(scene);
  std::vector<const Instance*> cubes;
  for (const Instance& instance : scene.instances) {
    if (instance.kind == ShapeKind::voxels) cubes.push_back(&instance);
  }
  ASSERT_EQ(cubes.size(), 2u);
  const auto apart = [&] { return cubes[1]->world_from_object[3] - cubes[0]->world_from_object[3]; };
  EXPECT_NEAR(apart().x, 0.2, 1e-15);
  world.advance(2);
  // Scaled by 3 and turned by a quarter about Z: 0.2 along x have become 0.6 along y.
  EXPECT_NEAR(apart().x, 0, 1e-15);
  EXPECT_NEAR(apart().y, 0.6, 1e-15);
  // They are one object to events, too.
  EXPECT_EQ(problem_of(world, R"({"t_ns": 2000000000, "op": "move", "name": "cubes", "scale": 1})"), "");
  EXPECT_NEAR(apart().y, 0.2, 1e-15);
}

TEST(ObjectPathTest, AMoveEndsThePathWhereTheObjectIsThen) {
  const TemporaryFolder folder;
  const auto file = write_kinds(folder);
  for (const double frame_before_s : {0.0, 0.3, 0.999}) {
    SCOPED_TRACE(frame_before_s);
    Scene scene = load_scene(file);
    World world(scene);
    world.advance(frame_before_s);
    // At 1 s the path has it at x = 2, an eighth of a turn on: what the event does not give stays like that.
    EXPECT_EQ(problem_of(world, R"({"t_ns": 1000000000, "op": "move", "name": "cup", "scale": 7})"), "");
    for (const double t : {1.0, 2.0, 9.0}) {
      world.advance(t);
      expect_place(named(scene, "cup"), {2, 1, 0}, 7.0 * glm::dvec3(std::sqrt(0.5), std::sqrt(0.5), 0));
    }
    EXPECT_NEAR(named(scene, "ball").world_from_object[3].x, 4, 1e-14);  // the others go on
    world.restart();
    world.advance(1);
    expect_place(named(scene, "cup"), {2, 1, 0}, 2.5 * glm::dvec3(std::sqrt(0.5), std::sqrt(0.5), 0));
  }
}

TEST(ObjectPathTest, ASpawnedCopyFollowsThePathUnlessItIsGivenAPlace) {
  const TemporaryFolder folder;
  Scene scene = load_scene(write_kinds(folder));
  World world(scene);
  EXPECT_EQ(problem_of(world, R"({"t_ns": 500000000, "op": "spawn", "of": "spare", "name": "spare"})"), "");
  EXPECT_EQ(problem_of(world, R"({"t_ns": 500000000, "op": "spawn", "of": "spare", "name": "still",
                                  "translation": [0, 0, -7]})"),
            "");
  const auto place_of = [&](const char* name) { return named(scene, name).world_from_object; };
  world.advance(1);
  // In step with its model, whenever it came: time is the session's.
  EXPECT_EQ(place_of("spare")[3], glm::dvec3(2, 1, 0));
  // The other has the entry's own rotation and scale, and stays.
  const Instance& still = scene.instances.back();
  expect_place(still, {0, 0, -7}, {1, 0, 0});
  world.advance(2);
  EXPECT_EQ(place_of("spare")[3], glm::dvec3(4, 1, 0));
  expect_place(still, {0, 0, -7}, {1, 0, 0});
}

TEST(ObjectPathTest, AnotherMeshGoesOnAlongThePath) {
  const TemporaryFolder folder;
  Scene scene = load_scene(write_kinds(folder));
  World world(scene);
  EXPECT_EQ(problem_of(world, R"({"t_ns": 500000000, "op": "replace_mesh", "name": "ball", "of": "crate"})"),
            "");
  world.advance(2);
  // The crate's half extent of 1 along x, times 3, turned to y.
  const Instance& crate = named(scene, "crate");
  EXPECT_EQ(crate.kind, ShapeKind::box);
  int on_path = 0;
  for (const Instance& instance : scene.instances) {
    if (instance.kind != ShapeKind::box || !instance.present || instance.catcher) continue;
    if (instance.world_from_object[3] == glm::dvec3(0, 5, 0)) continue;  // the crate itself
    expect_place(instance, {4, 1, 0}, {0, 3, 0});
    ++on_path;
  }
  EXPECT_EQ(on_path, 1);
}

TEST(ObjectPathTest, AMeshThatDoesNotFitThePathIsRefusedForAllItsKeys) {
  const TemporaryFolder folder;
  // 1e-6 of a ball of radius 1 can be traced; of a ball of radius 1e-7 the determinant would be 1e-39.
  const auto file = folder.write("s.scene.json", R"({"format_version": 1, "name": "s", "shapes": [
    {"name": "ball", "sphere": {"centre": [0, 0, 0], "radius": 1},
     "path": {"keys": [{"t_s": 0}, {"t_s": 9, "scale": 1e-6}]}},
    {"name": "bead", "sphere": {"centre": [0, 0, 0], "radius": 1e-7}}]})");
  Scene scene = load_scene(file);
  World world(scene);
  EXPECT_TRUE(
      contains(problem_of(world, R"({"t_ns": 1, "op": "replace_mesh", "name": "ball", "of": "bead"})"),
               "a larger scale"));
  EXPECT_TRUE(scene.instances[0].present);
}

TEST(ObjectPathTest, LightsOfAModelStayWhereItsPathStarts) {
  const TemporaryFolder folder;
  nlohmann::json document = triangle_document();
  document["extensionsUsed"] = {"KHR_lights_punctual"};
  document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  document["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  write_model(folder, document);
  Scene scene = load_scene(folder.write("s.scene.json", R"({"format_version": 1, "name": "s", "gltf": [
    {"file": "model.gltf", "path": {"keys": [{"t_s": 0, "translation": [0, 1, 0]}, {"t_s": 1}]}}]})"));
  EXPECT_TRUE(any_contains(scene.warnings, "gltf[0]: the lights of a glTF file do not follow its path"));
  World world(scene);
  world.advance(1);
  EXPECT_EQ(world.state().lights[0].centre, glm::dvec3(0, 1, 0));
  EXPECT_EQ(scene.instances[0].world_from_object[3], glm::dvec3(0, 0, 0));
}

}  // namespace
}  // namespace herr::test
