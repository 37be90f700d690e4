// Animation, skins and morph targets: values at times against arithmetic by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "scenes/animation/bend_mesh.h"
#include "scenes/animation/model_pose.h"
#include "scenes/changes/world.h"
#include "scenes/load_scene.h"
#include "tests/scenes/scene_files.h"

namespace herr::test {
namespace {

AnimationChannel channel(Interpolation interpolation, std::vector<float> times, std::vector<float> values) {
  AnimationChannel made;
  made.components = 1;
  made.value = AnimatedValue::weights;
  made.interpolation = interpolation;
  made.times_s = std::move(times);
  made.values = std::move(values);
  return made;
}

float value_at(const AnimationChannel& from, double time_s) {
  float value = 0;
  sample_channel(from, time_s, &value);
  return value;
}

TEST(AnimationTest, StepsHoldAndLinesRise) {
  const AnimationChannel step = channel(Interpolation::step, {1, 2, 4}, {10, 20, 40});
  EXPECT_EQ(value_at(step, 0), 10);  // held before the first key
  EXPECT_EQ(value_at(step, 1.99), 10);
  EXPECT_EQ(value_at(step, 2), 20);
  EXPECT_EQ(value_at(step, 9), 40);
  const AnimationChannel line = channel(Interpolation::linear, {1, 2, 4}, {10, 20, 40});
  EXPECT_EQ(value_at(line, 1.5), 15);
  EXPECT_EQ(value_at(line, 3), 30);
  EXPECT_EQ(value_at(line, 9), 40);
}

TEST(AnimationTest, ASplineFollowsHermitesCubic) {
  // Keys 0 and 1 at t = 0 and 2, out-tangent 3, in-tangent -1. At t = 1 (half way, span 2): h00 = h01 = 1/2,
  // h10 = 1/8, h11 = -1/8, so 0 / 2 + 2 * 3 / 8 + 1 / 2 - 2 * -1 / 8 = 1.5.
  const AnimationChannel spline = channel(Interpolation::cubic_spline, {0, 2}, {9, 0, 3, -1, 1, 9});
  EXPECT_FLOAT_EQ(value_at(spline, 1), 1.5f);
  EXPECT_EQ(value_at(spline, 0), 0);
  EXPECT_EQ(value_at(spline, 2), 1);
}

TEST(AnimationTest, RotationsTakeTheShorterArc) {
  // From no turn to a quarter turn about Z, written as -q: half way is an eighth of a turn.
  AnimationChannel turn = channel(Interpolation::linear, {0, 1}, {});
  const float h = std::sqrt(0.5f);
  turn.components = 4;
  turn.value = AnimatedValue::rotation;
  turn.values = {0, 0, 0, 1, 0, 0, -h, -h};
  float q[4];
  sample_channel(turn, 0.5, q);
  EXPECT_NEAR(std::abs(q[2]), std::sin(M_PI / 8), 1e-6);
  EXPECT_NEAR(std::abs(q[3]), std::cos(M_PI / 8), 1e-6);
  EXPECT_GT(q[2] * q[3], 0);
}

TEST(AnimationTest, AClipGoesRoundOrIsHeld) {
  const Playback loops{0, 2, 0.5, true}, holds{0, 2, 0.5, false}, backwards{0, -1, 0, true};
  EXPECT_DOUBLE_EQ(clip_time_s(loops, 3, 1), 2.5);
  EXPECT_DOUBLE_EQ(clip_time_s(loops, 3, 2), 1.5);
  EXPECT_DOUBLE_EQ(clip_time_s(holds, 3, 2), 3);
  EXPECT_DOUBLE_EQ(clip_time_s(backwards, 3, 1), 2);
  EXPECT_DOUBLE_EQ(clip_time_s(loops, 0, 5), 0);
}

// The triangle with more of a document and more bytes; views of floats are made from `floats` in turn.
std::filesystem::path write(const TemporaryFolder& folder, nlohmann::json document,
                            const std::vector<std::pair<const char*, std::vector<float>>>& arrays) {
  std::string bytes = triangle_bytes();
  bytes.resize(44);
  for (const auto& [type, floats] : arrays) {
    const int width = std::string(type) == "SCALAR" ? 1
                      : std::string(type) == "VEC3" ? 3
                      : std::string(type) == "VEC4" ? 4
                                                    : 16;
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size()},
                                     {"componentType", 5126},
                                     {"count", floats.size() / static_cast<std::size_t>(width)},
                                     {"type", type}});
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", 4 * floats.size()}});
    bytes += bytes_of(floats);
  }
  document["buffers"][0]["byteLength"] = bytes.size();
  folder.write("triangle.bin", bytes);
  return folder.write("model.gltf", document.dump());
}

nlohmann::json moving_document() {
  nlohmann::json document = triangle_document();
  document["animations"] = nlohmann::json::parse(
      R"([{"name": "slide", "samplers": [{"input": 2, "output": 3}],
           "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}])");
  return document;
}

TEST(AnimationTest, AnAnimatedNodeCarriesItsMeshAndLoops) {
  const TemporaryFolder folder;
  Scene scene =
      load_scene(write(folder, moving_document(), {{"SCALAR", {0, 2}}, {"VEC3", {1, 0, 0, 3, 0, 0}}}));
  // As loaded it stands where the clip has it at time 0, not where the node alone would be.
  EXPECT_EQ(scene.instances[0].world_from_object[3], glm::dvec3(1, 0, 0));
  World world(scene);
  world.advance(1.5);
  EXPECT_DOUBLE_EQ(scene.instances[0].world_from_object[3].x, 2.5);
  world.advance(2.5);
  EXPECT_DOUBLE_EQ(scene.instances[0].world_from_object[3].x, 1.5);
  const SlotChanges::Number latest = world.state().changes.latest();
  world.advance(4.5);  // the same place on the clip: nothing is new
  EXPECT_EQ(world.state().changes.latest(), latest);
}

TEST(AnimationTest, ANodeMovesBesideOneThatStandsBeforeIt) {
  const TemporaryFolder folder;
  nlohmann::json document = moving_document();
  document["nodes"] = nlohmann::json::parse(R"([{"mesh": 0}, {"mesh": 0}])");
  document["scenes"][0]["nodes"] = {0, 1};
  document["animations"][0]["channels"][0]["target"]["node"] = 1;
  Scene scene = load_scene(write(folder, document, {{"SCALAR", {0, 2}}, {"VEC3", {1, 0, 0, 3, 0, 0}}}));
  World world(scene);
  world.advance(1);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].world_from_object[3], glm::dvec3(0, 0, 0));
  EXPECT_EQ(scene.instances[1].world_from_object[3], glm::dvec3(2, 0, 0));
}

TEST(AnimationTest, APathPlacesAModelWhoseNodesMoveByThemselves) {
  const TemporaryFolder folder;
  write(folder, moving_document(), {{"SCALAR", {0, 2}}, {"VEC3", {1, 0, 0, 3, 0, 0}}});
  Scene scene = load_scene(folder.write("s.scene.json", R"({"format_version": 1, "name": "s", "gltf": [
    {"file": "model.gltf", "path": {"keys": [{"t_s": 0, "translation": [0, 10, 0]},
                                             {"t_s": 4, "translation": [0, 30, 0], "scale": 3}]}}]})"));
  EXPECT_EQ(scene.instances[0].world_from_object[3], glm::dvec3(1, 10, 0));
  World world(scene);
  // At 1 s the node stands at x = 2 of its model, which stands at y = 15 and is 1.5 times as large.
  world.advance(1);
  EXPECT_EQ(scene.instances[0].world_from_object[3], glm::dvec3(3, 15, 0));
  EXPECT_EQ(world.state().changes.latest(), 1u);  // two reasons, one move
  world.advance(4);                               // the clip has gone round twice, the path has ended
  EXPECT_EQ(scene.instances[0].world_from_object[3], glm::dvec3(3, 30, 0));
}

TEST(AnimationTest, ADocumentChoosesTheClipAndItsSpeed) {
  const TemporaryFolder folder;
  write(folder, moving_document(), {{"SCALAR", {0, 2}}, {"VEC3", {1, 0, 0, 3, 0, 0}}});
  const auto scene_with = [&](const std::string& animation) {
    return folder.write("s.scene.json",
                        R"({"format_version": 1, "name": "s", "gltf": [{"file": "model.gltf", "name": "a",
                          "translation": [0, 1, 0], "animation": )" +
                            animation + "}]}");
  };
  Scene fast = load_scene(scene_with(R"({"clip": "slide", "speed": 2})"));
  World world(fast);
  world.advance(0.5);
  EXPECT_EQ(fast.instances[0].world_from_object[3], glm::dvec3(2, 1, 0));
  const Scene still = load_scene(scene_with(R"({"play": false})"));
  EXPECT_EQ(still.instances[0].world_from_object[3], glm::dvec3(0, 1, 0));
  EXPECT_TRUE(still.models.empty());
  EXPECT_TRUE(contains(error_of(scene_with(R"({"clip": "slid"})")), "the nearest is \"slide\""));
  EXPECT_TRUE(contains(error_of(scene_with(R"({"clip": 4})")), "not number 4"));
}

TEST(AnimationTest, FaultyKeysAreRefused) {
  const TemporaryFolder folder;
  const std::vector<float> two{1, 0, 0, 3, 0, 0};
  EXPECT_TRUE(contains(error_of(write(folder, moving_document(), {{"SCALAR", {2, 2}}, {"VEC3", two}})),
                       "do not grow"));
  EXPECT_TRUE(contains(error_of(write(folder, moving_document(), {{"SCALAR", {-1, 2}}, {"VEC3", two}})),
                       "do not grow"));
  EXPECT_TRUE(contains(error_of(write(folder, moving_document(), {{"SCALAR", {0, 1, 2}}, {"VEC3", two}})),
                       "has 2 values where its keys need 3"));
  nlohmann::json spline = moving_document();
  spline["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE";
  EXPECT_TRUE(contains(error_of(write(folder, spline, {{"SCALAR", {0, 2}}, {"VEC3", two}})), "need 6"));
}

TEST(AnimationTest, MorphTargetsAreAddedTimesTheirWeights) {
  const TemporaryFolder folder;
  nlohmann::json document = triangle_document();
  document["meshes"][0]["primitives"][0]["targets"] = nlohmann::json::parse(R"([{"POSITION": 2}])");
  document["meshes"][0]["weights"] = {0.5};
  const Scene still = load_scene(write(folder, document, {{"VEC3", {0, 0, 0, 2, 0, 0, 0, 4, 0}}}));
  // (1,0,0) + 0.5 (2,0,0) and (0,1,0) + 0.5 (0,4,0); nothing plays, so nothing is kept for later.
  EXPECT_EQ(still.meshes[0].positions[1], glm::vec3(2, 0, 0));
  EXPECT_EQ(still.meshes[0].positions[2], glm::vec3(0, 3, 0));
  EXPECT_TRUE(still.deformations.empty());
}

TEST(AnimationTest, ASkinnedVertexIsTheWeightedMeanOfItsJoints) {
  // Two joints; inverse bind matrices bring the mesh to each joint's own space. Joint 1 stands at x = 1 and
  // is lifted by 2; a vertex that hangs on both alike goes up by 1, whatever the mesh's own node says.
  const TemporaryFolder folder;
  nlohmann::json document = triangle_document();
  document["scenes"][0]["nodes"] = {0, 1, 2};
  document["nodes"][0]["skin"] = 0;
  document["nodes"][0]["translation"] = {100, 0, 0};
  document["nodes"].push_back({{"name", "joint 0"}});
  document["nodes"].push_back({{"name", "joint 1"}, {"translation", {1, 0, 0}}});
  document["skins"] = nlohmann::json::parse(R"([{"joints": [1, 2], "inverseBindMatrices": 4}])");
  auto& attributes = document["meshes"][0]["primitives"][0]["attributes"];
  attributes["WEIGHTS_0"] = 2;
  attributes["JOINTS_0"] = 3;
  document["animations"] = nlohmann::json::parse(
      R"([{"samplers": [{"input": 5, "output": 6}], "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}]}])");
  const std::vector<float> one{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  std::vector<float> bind = one;
  bind.insert(bind.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
  const std::vector<std::pair<const char*, std::vector<float>>> arrays{
      {"VEC4", {1, 0, 0, 0, 2, 2, 0, 0, 0, 7, 0, 0}},  // not normalised: one; half each; the other
      {"VEC4", {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}},
      {"MAT4", bind},
      {"SCALAR", {0, 1}},
      {"VEC3", {1, 0, 0, 1, 2, 0}}};
  // JOINTS must be integers: this file is refused by nobody, since the reader takes any component type.
  Scene scene = load_scene(write(folder, document, arrays));
  ASSERT_EQ(scene.deformations.size(), 1u);
  EXPECT_EQ(scene.instances[0].world_from_object, glm::dmat4x3(1.0));
  World world(scene);
  world.advance(0.999999999);
  TriangleMesh bent;
  bend_mesh(scene.deformations[0], world.state().poses[0], bent);
  const std::vector<glm::vec3>& positions = bent.positions;
  EXPECT_NEAR(positions[0].y, 0, 1e-6);
  EXPECT_NEAR(positions[1].y, 1, 1e-6);
  EXPECT_NEAR(positions[2].y, 3, 1e-6);
  EXPECT_NEAR(positions[1].x, 1, 1e-6);
  nlohmann::json wrong = document;
  wrong["skins"][0]["joints"] = {1};
  EXPECT_TRUE(contains(error_of(write(folder, wrong, arrays)), "names joint 1 of 1"));
}

TEST(AnimationTest, ASmallFileCannotAskForMorphTargetsWithoutEnd) {
  // 256 targets over one accessor of zeros, which needs no bytes.
  const TemporaryFolder folder;
  nlohmann::json document = nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0,
      "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "accessors": [{"componentType": 5126, "count": 450000, "type": "VEC3"}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "targets": []}]}]})");
  nlohmann::json& targets = document["meshes"][0]["primitives"][0]["targets"];
  targets.push_back({{"POSITION", 0}});
  EXPECT_NO_THROW(load_scene(write_model(folder, document)));
  while (targets.size() < 256) targets.push_back({{"POSITION", 0}});
  EXPECT_TRUE(contains(error_of(write_model(folder, document)), "too many vertices that bend"));
}

TEST(AnimationTest, AMirroringJointMirrorsWhatANormalTextureShows) {
  for (const bool flat : {false, true}) {
    MeshDeformation deformation;
    deformation.rest_positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    deformation.rest_normals.assign(3, {0, 0, 1});
    deformation.rest_tangents.assign(3, {1, 0, 0, 1});
    deformation.flat_normals = flat;
    deformation.skin = 0;
    deformation.influences = 4;
    deformation.joints.assign(12, 0);
    deformation.weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    DeformationPose pose;
    pose.joints = {{-1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}};  // x changes its sign
    TriangleMesh bent;
    bend_mesh(deformation, pose, bent);
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec3 n = bent.normals[i], t(bent.tangents[i]), b = bent.tangents[i].w * glm::cross(n, t);
      // The texel (0.3, 0.2, 0.9), which shading turns to the viewer whole.
      const glm::vec3 shown = 0.3f * t + 0.2f * b + 0.9f * n;
      const glm::vec3 expected(-0.3f, 0.2f, 0.9f);
      EXPECT_LT(std::min(glm::distance(shown, expected), glm::distance(shown, -expected)), 1e-6f)
          << (flat ? "flat" : "smooth");
    }
  }
}

}  // namespace
}  // namespace herr::test
