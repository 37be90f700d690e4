// A scene over time: what events and the timeline do to it, and which of them are
// refused before the first frame.
#include "scenes/changes/world.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/changes/check_changes.h"
#include "scenes/document/parse_change.h"
#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"
#include "tests/scenes/voxels/vox_files.h"

namespace herr::test {
namespace {

// A triangle "cup", another that is not there yet, and a lamp.
std::string document(const std::string& more = "") {
  return R"({"format_version": 1, "name": "world", "gltf": [
    {"file": "model.gltf", "name": "cup", "translation": [1, 0, 0]},
    {"file": "model.gltf", "name": "spare", "scale": 2, "present": false}],
    "lights": [{"name": "lamp", "centre": [0, 4, 0], "intensity_w_sr": [1, 1, 1]}])" +
         more + "}";
}

std::filesystem::path write_scene(const TemporaryFolder& folder, const std::string& text) {
  write_model(folder, triangle_document());
  return folder.write("world.scene.json", text);
}

Scene load(const TemporaryFolder& folder, const std::string& more = "") {
  return load_scene(write_scene(folder, document(more)));
}

SceneChange event(const std::string& json) {
  return parse_event(json, "events.jsonl", 7, 0);
}

std::string problem_of(World& world, const std::string& json) {
  const auto problem = world.apply(event(json));
  return problem ? problem->what + "; " + problem->remedy : "";
}

TEST(WorldTest, ASpawnedCopyStandsWhereTheEventSaysAndLeavesWhenItIsRemoved) {
  const TemporaryFolder folder;
  Scene scene = load(folder);
  World world(scene);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_FALSE(scene.instances[1].present);
  EXPECT_EQ(
      problem_of(world, R"({"t_ns": 5, "op": "spawn", "of": "cup", "name": "b", "translation": [0, 3, 0]})"),
      "");
  world.advance(1);
  // The slot of what is not there is taken first. The cup's own scale and rotation stay.
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_TRUE(scene.instances[1].present);
  EXPECT_EQ(scene.instances[1].world_from_object[3], glm::dvec3(0, 3, 0));
  EXPECT_EQ(scene.instances[1].world_from_object[0], glm::dvec3(1, 0, 0));
  EXPECT_EQ(problem_of(world, R"({"t_ns": 6, "op": "remove", "name": "b"})"), "");
  EXPECT_FALSE(scene.instances[1].present);
}

TEST(WorldTest, AnEntryOfAnyKindCanBeLeftForAnEvent) {
  const TemporaryFolder folder;
  folder.write("cube.vox", vox_bytes(vox_model(1, 1, 1, {{0, 0, 0, 1}})));
  const std::string later = R"("present": false})";
  Scene scene = load(
      folder, R"(, "catchers": [{"name": "door", "quad": [[0,0,0], [1,0,0], [1,2,0], [0,2,0]], )" + later +
                  R"(], "shapes": [{"name": "ball", "sphere": {"centre": [0, 1, 0], "radius": 0.5}, )" +
                  later + R"(], "voxels": [{"file": "cube.vox", "name": "cube", )" + later + "]");
  World world(scene);
  for (const char* name : {"spare", "door", "ball", "cube"}) {
    const auto there = [&] {
      return std::count_if(scene.instances.begin(), scene.instances.end(),
                           [](const Instance& i) { return i.present; });
    };
    const auto before = there();
    EXPECT_EQ(problem_of(world, R"({"t_ns": 1, "op": "spawn", "of": ")" + std::string(name) +
                                    R"(", "name": ")" + name + "\"}"),
              "");
    EXPECT_EQ(there(), before + 1) << name;
  }
  EXPECT_EQ(scene.instances.size(), 5u);  // each in a slot of its own kind's or another's that was free
}

TEST(WorldTest, SlotsAreUsedAgain) {
  const TemporaryFolder folder;
  Scene scene = load(folder);
  World world(scene);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(problem_of(world, R"({"t_ns": 1, "op": "spawn", "of": "cup", "name": "b"})"), "");
    ASSERT_EQ(problem_of(world, R"({"t_ns": 1, "op": "spawn", "of": "spare", "name": "c"})"), "");
    ASSERT_EQ(
        problem_of(world, R"({"t_ns": 1, "op": "set_material", "name": "c", "material": {"mirror": 1}})"),
        "");
    ASSERT_EQ(problem_of(world, R"({"t_ns": 1, "op": "remove", "name": "b"})"), "");
    ASSERT_EQ(problem_of(world, R"({"t_ns": 1, "op": "remove", "name": "c"})"), "");
  }
  EXPECT_EQ(scene.instances.size(), 3u);  // never more than three at once
  EXPECT_LE(scene.materials.size(), 4u);  // the file's one and one for each slot that ever had its own
}

TEST(WorldTest, AMoveChangesOnlyWhatItNames) {
  const TemporaryFolder folder;
  Scene scene = load(folder);
  World world(scene);
  EXPECT_EQ(problem_of(world, R"({"t_ns": 1, "op": "move", "name": "cup", "scale": [2, 3, 4]})"), "");
  EXPECT_EQ(scene.instances[0].world_from_object,
            glm::dmat4x3(glm::dvec3(2, 0, 0), glm::dvec3(0, 3, 0), glm::dvec3(0, 0, 4), glm::dvec3(1, 0, 0)));
  std::vector<ChangedSlot> changed;
  world.state().changes.since(0, changed);
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].slot, 0u);
  EXPECT_FALSE(changed[0].renewed);
  EXPECT_EQ(scene.revision, world.state().changes.latest());
}

TEST(WorldTest, AStateDependsOnTheEventsAndNotOnTheFramesBetween) {
  const TemporaryFolder folder;
  const std::string timeline = R"(, "timeline": [
    {"t_s": 1, "op": "move", "name": "cup", "translation": [5, 0, 0]},
    {"t_s": 3, "op": "spawn", "of": "spare", "name": "spare"},
    {"t_s": 4, "op": "set_light", "name": "lamp", "intensity_w_sr": [3, 2, 1]}])";
  Scene frame_by_frame = load(folder, timeline), at_once = load(folder, timeline);
  World slow(frame_by_frame), fast(at_once);
  const SceneChange move =
      event(R"({"t_ns": 2000000000, "op": "move", "name": "cup", "translation": [6, 0, 0]})");
  for (int frame = 0; frame < 100; ++frame) slow.advance(0.02 * frame);
  ASSERT_FALSE(slow.apply(move));
  for (int frame = 100; frame <= 500; ++frame) slow.advance(0.02 * frame);
  ASSERT_FALSE(fast.apply(move));
  fast.advance(10);
  ASSERT_EQ(frame_by_frame.instances.size(), at_once.instances.size());
  for (std::size_t i = 0; i < at_once.instances.size(); ++i) {
    EXPECT_EQ(frame_by_frame.instances[i].present, at_once.instances[i].present);
    EXPECT_EQ(frame_by_frame.instances[i].world_from_object, at_once.instances[i].world_from_object);
  }
  // The timeline's move of t = 1 comes before the event of t = 2, whichever frame sees them first.
  EXPECT_EQ(at_once.instances[0].world_from_object[3].x, 6);
  EXPECT_TRUE(at_once.instances[1].present);
  EXPECT_EQ(fast.state().lights[0].intensity_w_sr, glm::vec3(3, 2, 1));
}

TEST(WorldTest, ALightBecomesVirtualAndRealAgain) {
  const TemporaryFolder folder;
  Scene scene = load(folder);
  World world(scene);
  const auto set = [&](const char* what) {
    return problem_of(
        world, std::string(R"({"t_ns": 1, "op": "set_light", "name": "lamp", "virtual": )") + what + "}");
  };
  const SlotChanges::Number before = world.state().changes.latest();
  ASSERT_EQ(set("true"), "");
  world.advance(1);
  EXPECT_TRUE(world.state().lights[0].is_virtual);
  EXPECT_TRUE(world.state().changes.relit_since(before));
  ASSERT_EQ(set("false"), "");
  world.advance(2);
  EXPECT_FALSE(world.state().lights[0].is_virtual);
  ASSERT_EQ(set("true"), "");
  world.restart();
  EXPECT_FALSE(world.state().lights[0].is_virtual);
}

TEST(WorldTest, ARestartBringsBackTheSceneAsItWasLoaded) {
  const TemporaryFolder folder;
  Scene scene = load(folder);
  const Scene loaded = scene;
  World world(scene);
  ASSERT_EQ(problem_of(world, R"({"t_ns": 1, "op": "spawn", "of": "cup", "name": "b"})"), "");
  ASSERT_EQ(problem_of(world, R"({"t_ns": 1, "op": "spawn", "of": "cup", "name": "c"})"), "");
  ASSERT_EQ(problem_of(world, R"({"t_ns": 1, "op": "replace_mesh", "name": "cup", "of": "spare"})"), "");
  ASSERT_EQ(problem_of(world, R"({"t_ns": 1, "op": "set_light", "name": "lamp", "centre": [9, 9, 9]})"), "");
  std::vector<ChangedSlot> touched, taken_back;
  world.state().changes.since(0, touched);
  const SlotChanges::Number before = world.state().changes.latest();
  world.restart();
  for (std::size_t i = 0; i < loaded.instances.size(); ++i) {
    EXPECT_EQ(scene.instances[i].present, loaded.instances[i].present);
    EXPECT_EQ(scene.instances[i].world_from_object, loaded.instances[i].world_from_object);
  }
  for (std::size_t i = loaded.instances.size(); i < scene.instances.size(); ++i)
    EXPECT_FALSE(scene.instances[i].present);
  EXPECT_EQ(world.state().lights[0].centre, loaded.lights[0].centre);
  EXPECT_TRUE(world.state().changes.relit_since(before));
  // The slots of b and c are empty again. The third looked like the cup all along: the spare is of the same
  // file and took the cup's place.
  world.state().changes.since(before, taken_back);
  EXPECT_EQ(touched.size(), 3u);
  ASSERT_EQ(taken_back.size(), 2u);
  EXPECT_EQ(taken_back[0].slot, 1u);
  EXPECT_EQ(taken_back[1].slot, 2u);
  // A restart of what is as it was loaded changes nothing.
  const SlotChanges::Number restarted = world.state().changes.latest();
  world.restart();
  EXPECT_EQ(world.state().changes.latest(), restarted);
}

TEST(WorldTest, ReplacingAMeshKeepsThePlaceOfTheObject) {
  const TemporaryFolder folder;
  Scene scene = load(folder);
  World world(scene);
  ASSERT_EQ(problem_of(world, R"({"t_ns": 1, "op": "replace_mesh", "name": "cup", "of": "spare"})"), "");
  EXPECT_TRUE(scene.instances[0].present);
  EXPECT_EQ(scene.instances[0].world_from_object[3], glm::dvec3(1, 0, 0));
  EXPECT_EQ(scene.instances[0].world_from_object[0],
            glm::dvec3(1, 0, 0));  // the cup's scale, not the spare's
}

TEST(WorldTest, ImpossibleChangesSayWhyAndChangeNothing) {
  const TemporaryFolder folder;
  Scene scene = load(folder);
  World world(scene);
  const auto before = scene.instances[0].world_from_object;
  EXPECT_TRUE(contains(problem_of(world, R"({"t_ns": 1, "op": "move", "name": "cap", "scale": 2})"),
                       "the nearest is \"cup\""));
  EXPECT_TRUE(contains(problem_of(world, R"({"t_ns": 1, "op": "remove", "name": "spare"})"), "not there"));
  EXPECT_TRUE(contains(problem_of(world, R"({"t_ns": 1, "op": "spawn", "of": "cup", "name": "cup"})"),
                       "there already"));
  EXPECT_TRUE(contains(problem_of(world, R"({"t_ns": 1, "op": "move", "name": "cup", "scale": 1e-13})"),
                       "a larger scale"));
  EXPECT_TRUE(
      contains(problem_of(world, R"({"t_ns": 1, "op": "set_light", "name": "lamp", "direction": [0, 1, 0]})"),
               "does not have"));
  EXPECT_EQ(scene.instances[0].world_from_object, before);
}

TEST(WorldTest, AnEventThatIsNoneNamesItsLineAndTheNearestKey) {
  const auto error_at = [](const std::string& json) {
    try {
      event(json);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_TRUE(contains(error_at(R"({"t_ns": 1, "op": "mvoe", "name": "cup"})"), "events.jsonl:7: "));
  EXPECT_TRUE(contains(error_at(R"({"t_ns": 1, "op": "mvoe", "name": "cup"})"), "the nearest is move"));
  EXPECT_TRUE(contains(error_at(R"({"t_ns": 1, "op": "move", "name": "cup", "translatoin": [0,0,0]})"),
                       "translation"));
  EXPECT_TRUE(contains(error_at(R"({"t_ns": 1, "op": "move", "name": "cup"})"), "moves nothing"));
  EXPECT_TRUE(contains(error_at(R"({"t_ns": 1, "op": "move", "name": "cup", "scale": 0})"), "is 0"));
}

TEST(WorldTest, ATimelineThatCannotBePlayedIsRefusedWhenTheSceneIsLoaded) {
  const TemporaryFolder folder;
  const auto error = [&](const std::string& entries) {
    return error_of(write_scene(folder, document(", \"timeline\": [" + entries + "]")));
  };
  EXPECT_EQ(error(R"({"t_s": 1, "op": "remove", "name": "cup"})"), "");
  EXPECT_TRUE(contains(
      error(R"({"t_s": 1, "op": "remove", "name": "cup"}, {"t_s": 2, "op": "remove", "name": "cup"})"),
      "timeline[1] names object \"cup\""));
  EXPECT_TRUE(contains(
      error(R"({"t_s": 2, "op": "remove", "name": "cup"}, {"t_s": 1, "op": "remove", "name": "cup"})"),
      "goes backwards"));
}

TEST(WorldTest, ARehearsalPlaysEventsWithoutTouchingTheScene) {
  const TemporaryFolder folder;
  const Scene scene = load(folder);
  ChangeRehearsal rehearsal(scene);
  rehearsal.play(R"({"t_ns": 1, "op": "spawn", "of": "cup", "name": "b"})", "events.jsonl", 1, 0);
  rehearsal.play(R"({"t_ns": 2, "op": "remove", "name": "b"})", "events.jsonl", 2, 0);
  EXPECT_THROW(rehearsal.play(R"({"t_ns": 3, "op": "remove", "name": "b"})", "events.jsonl", 3, 0),
               InputError);
  rehearsal.finish();
  EXPECT_EQ(rehearsal.counts()[0], 1);
  EXPECT_EQ(rehearsal.counts()[1], 1);
  EXPECT_EQ(scene.instances.size(), 2u);
}

TEST(WorldTest, ARehearsalTellsOnceOfEventsWhoseQuaternionLooksWFirst) {
  const TemporaryFolder folder;
  const Scene scene = load(folder);
  ChangeRehearsal rehearsal(scene);
  rehearsal.play(R"({"t_ns": 1, "op": "move", "name": "cup", "rotation_xyzw": [0, 0, 0, 1]})", "e.jsonl", 1,
                 0);
  EXPECT_FALSE(rehearsal.w_first_warning());
  for (int line = 2; line < 5; ++line)
    rehearsal.play(R"({"t_ns": 2, "op": "move", "name": "cup", "rotation_xyzw": [0.70711, 0, 0.70711, 0]})",
                   "e.jsonl", line, 0);
  ASSERT_TRUE(rehearsal.w_first_warning());
  EXPECT_STREQ(
      rehearsal.w_first_warning()->what(),
      "e.jsonl:2: field rotation_xyzw is [0.70711, 0, 0.70711, 0], which looks w-first (and 2 more); "
      "here w is last: write [0, 0.70711, 0, 0.70711], or where half a turn is meant [-0.70711, 0, "
      "-0.70711, 0]");
}

}  // namespace
}  // namespace herr::test
