// Pictures that show nothing, without a word, are what a new user cannot explain: every command says why.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

// The small scene has one catcher, the floor, and a triangle two metres ahead of the head at (0, 1, 0).
class DarkPictures : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_session(root() / "session", 0.5);
    write_small_profile(root() / "small.json");
  }
  const fs::path& root() const { return folder_.path(); }
  Outcome herr(const std::string& arguments) const { return run_program(root(), arguments); }
  Outcome replay(const std::string& more) const {
    return herr(
        with_more("replay session --profile small.json --polar 64x32 --no-probes --frames 3 --format none "
                  "--contact-sheet none --overwrite ",
                  more));
  }
  // A scene of its own, beside the small one.
  void write_scene(const std::string& rest) const {
    write_text(root() / "scene/other.scene.json", R"({"format_version": 1, "name": "other", )" + rest + "}");
  }
  static bool says(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
  }
  TemporaryFolder folder_;
};

constexpr const char* kNotDrawn = "1 catcher and no camera feed: catchers are not drawn; use \"shapes\"";

TEST_F(DarkPictures, CatchersWithoutAFeedAreAWarningOfEveryCommandThatDraws) {
  EXPECT_FALSE(says(replay("").err, "catcher")) << "the feed shows the floor";
  EXPECT_FALSE(says(replay("--no-camera").err, "not drawn")) << "their shadows are in the alpha";
  EXPECT_FALSE(says(replay("--no-camera --see-through-colour FF00FF").err, "not drawn")) << "it is painted";
  EXPECT_TRUE(says(herr("look scene/small.scene.json --size 32x32 --samples 1 --out p.png").err, kNotDrawn));
  EXPECT_FALSE(says(herr("inspect scene/small.scene.json").out, "not drawn")) << "who knows the session?";
  EXPECT_FALSE(says(herr("inspect session").out, "not drawn"));
  fs::remove_all(root() / "session/cam0");
  std::string header = content_of(root() / "session/session.json");
  nlohmann::json json = nlohmann::json::parse(header);
  json.erase("cameras");
  write_text(root() / "session/session.json", json.dump());
  EXPECT_TRUE(says(herr("inspect session").out, kNotDrawn));
  EXPECT_TRUE(says(replay("").err, kNotDrawn));
  // Nor has a distance of the feed an effect.
  const std::string no_feed =
      "--feed-distance: session has no camera, so there is no feed to show; leave it out";
  EXPECT_FALSE(says(replay("").err, "--feed-distance"));
  EXPECT_TRUE(says(replay("--feed-distance 3").err, no_feed));
  EXPECT_TRUE(says(herr("inspect session --feed-distance 3").out, no_feed));
}

TEST_F(DarkPictures, LampsThatLightNothingAreAWarningOfEveryCommandThatDraws) {
  write_scene(
      R"("shapes": [{"name": "crate", "box": {"centre": [0, 1, -2], "half_extents": [0.5, 0.5, 0.5]}}],
    "lights": [{"name": "off", "centre": [0, 3, 0], "intensity_w_sr": [0, 0, 0]},
               {"name": "lamp", "centre": [0.4, 1, -2], "intensity_w_sr": [9, 9, 9]}])");
  for (const std::string& text :
       {replay("--scene scene/other.scene.json").err, herr("inspect scene/other.scene.json").out,
        herr("look scene/other.scene.json --size 32x32 --samples 1 --out p.png").err}) {
    EXPECT_TRUE(says(text, "light \"off\" has intensity 0 and lights nothing; write")) << text;
    EXPECT_TRUE(
        says(text, "light \"lamp\" stands inside \"crate\", which is opaque and hides its light; move"))
        << text;
  }
}

TEST_F(DarkPictures, AReplayThatShowsNoObjectSaysWhereTheHeadLooked) {
  EXPECT_FALSE(says(replay("").err, "no virtual object"));
  // Half a turn about y: the triangle, whose middle lies straight ahead before, is behind. From (0, 1, 0) in
  // the session the head stands at the same place and looks along +z; to the triangle's box from (-1, 0) to
  // (1, 2), 2 m behind, the nearest corner is 180 - atan(sqrt(2) / 2) = 145 degrees off.
  std::string scene = content_of(root() / "scene/small.scene.json");
  scene.insert(scene.rfind('}'),
               R"(, "world_from_session": {"position": [0, 0, 0], "orientation_xyzw": [0, 1, 0, 0]})");
  write_text(root() / "scene/small.scene.json", scene);
  const Outcome got = replay("");
  EXPECT_EQ(got.exit_code, 0);
  EXPECT_TRUE(
      says(got.err,
           "no virtual object was in view in any of the 3 frames; the head stood at (0.00, 1.00, 0.00) in "
           "the scene and looked along (0.00, 0.00, 1.00), the nearest object \"triangle\" is 145 degrees "
           "away; move it, or set world_from_session"))
      << got.err;
  const auto summary = nlohmann::json::parse(content_of(root() / "out/session/summary.json"));
  EXPECT_TRUE(says(summary["warnings"].dump(), "no virtual object was in view")) << summary["warnings"];
  EXPECT_TRUE(says(content_of(root() / "out/session/frames.csv"), "object_samples"));
}

// A ball of 0.5 mm, 2 m ahead of the head at (0, 1, 0): 48 pixels over a tangent of 2 are 24 a tangent, of
// the focus over 2 tan 15 degrees 89.6: 0.0005 / 2 * 89.6 = 0.02 pixels. A box of 300 m about the head holds
// it.
TEST_F(DarkPictures, ObjectsTooSmallOrTooLargeAreToldByReplayAndInspect) {
  const std::string lamp =
      R"(, "lights": [{"name": "lamp", "centre": [0, 3, 1], "intensity_w_sr": [9, 9, 9]}])";
  const std::string tiny =
      "\"ball\" is 0.5 mm across, 2.0 m away: smaller than a pixel; is the model in another unit than "
      "metres? "
      "give a \"scale\"";
  write_scene(R"("shapes": [{"name": "ball", "sphere": {"centre": [0, 1, -2], "radius": 0.00025}}])" + lamp);
  const Outcome replayed = replay("--scene scene/other.scene.json");
  EXPECT_TRUE(says(replayed.err, "no virtual object was in view")) << replayed.err;
  EXPECT_TRUE(says(replayed.err, "the nearest object " + tiny)) << replayed.err;
  EXPECT_FALSE(says(replayed.err, "degrees away")) << replayed.err;
  EXPECT_TRUE(says(herr("inspect session --profile small.json --scene scene/other.scene.json").out, tiny));
  write_scene(R"("shapes": [{"name": "crate", "box": {"centre": [0, 0, 0], "half_extents": [150, 5, 9]}}])" +
              lamp);
  const std::string text = herr("inspect session --scene scene/other.scene.json").out;
  EXPECT_TRUE(says(text, "the head stands inside \"crate\" (300 m across); is the model in millimetres?"))
      << text;
  EXPECT_FALSE(says(herr("inspect session").out, "across"));
}

// No ambient, no probes: all light is the lamp's. On the ball's front, about 1.5 m below and 2.5 m from a
// lamp of 0.001 W/sr, less than 0.001 / 2.5^2 / pi = 5e-5 arrives: 77 times less than 1/255. 2^12 of it is
// more.
TEST_F(DarkPictures, AReplayOfBlackPicturesNamesExposureAndLamp) {
  const auto with_lamp = [&](const std::string& intensity) {
    write_scene(R"("shapes": [{"name": "ball", "sphere": {"centre": [0, 1, -2], "radius": 0.5}}],
      "lights": [{"name": "lamp", "centre": [0, 3, 0], "intensity_w_sr": [)" +
                intensity + ", " + intensity + ", " + intensity + "]}]");
  };
  with_lamp("0.001");
  const std::string flags = "--scene scene/other.scene.json --no-camera ";
  const Outcome dark = replay(flags);
  EXPECT_TRUE(says(dark.err, "all pictures are darker than 1/255 of white at 0.0 EV")) << dark.err;
  EXPECT_TRUE(says(dark.err, "give --auto-exposure, or --exposure 1")) << dark.err;  // 10 to 19
  EXPECT_TRUE(says(dark.err, "or light \"lamp\" more than its intensity of 0.001 W/sr")) << dark.err;
  EXPECT_FALSE(says(replay(flags + "--auto-exposure").err, "darker than 1/255"));
  EXPECT_FALSE(says(replay(flags + "--exposure 14").err, "darker than 1/255"));
  with_lamp("9");
  EXPECT_FALSE(says(replay(flags).err, "darker than 1/255"));
}

TEST_F(DarkPictures, ASceneOfCatchersAloneHasNothingToSee) {
  write_scene(R"("catchers": [{"name": "floor", "quad": [[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5]]}])");
  const Outcome got = replay("--scene scene/other.scene.json --frames 1");
  EXPECT_TRUE(says(got.err, "no virtual object was in view in the one frame")) << got.err;
  EXPECT_TRUE(says(got.err, "the scene has none but catchers")) << got.err;
}

// With probes the ambient term is left out: to say that it lights the scene would be false.
TEST_F(DarkPictures, WhatLightsASceneWithoutLightsFollowsThePlan) {
  const std::string ball = R"("shapes": [{"name": "ball", "sphere": {"centre": [0, 1, -2], "radius": 0.5}}])";
  const std::string inspect = "inspect scene/other.scene.json ";
  write_scene(ball + R"(, "ambient": [0.2, 0.2, 0.2])");
  EXPECT_TRUE(
      says(herr(inspect).out,
           "no lights, and probes take the place of ambient: pictures are black but for emission; add a "
           "light, or give --no-probes"));
  EXPECT_TRUE(
      says(herr(inspect + "--no-probes").out, "no lights: only ambient and emission light it; add a light"));
  write_scene(ball + R"(, "environment": [0.2, 0.2, 0.2])");
  EXPECT_TRUE(
      says(herr(inspect).out,
           "no lights, and probes take the place of ambient: only emission and environment light it; add a "
           "light\n"));
  EXPECT_TRUE(
      says(herr(inspect + "--no-probes").out,
           "no lights and no ambient: pictures are black but for emission and the environment behind"));
}

TEST_F(DarkPictures, InspectSaysWhereTheHeadStandsAndLooks) {
  // The head goes from x = 0 to 0.05 m in half a second, at a height of 1 m, looking along -z.
  const Outcome text = herr("inspect session");
  EXPECT_TRUE(says(text.out,
                   "head: stands at (0.02, 1.00, 0.00) m and looks along (0.00, 0.00, -1.00) in the median"))
      << text.out;
  const auto head = nlohmann::json::parse(herr("inspect session --json").out)["session"]["head"];
  EXPECT_NEAR(head["median_m"][0].get<double>(), 0.025, 0.002);
  EXPECT_EQ(head["median_forward"][2], -1);
}

TEST_F(DarkPictures, AStartBehindTheEndSaysHowLongTheSessionLasts) {
  const Outcome got = replay("--start 500");
  EXPECT_EQ(got.exit_code, 2);
  EXPECT_TRUE(says(got.err, "no frame of session lies in that span; the session lasts 0.50 s")) << got.err;
}

TEST_F(DarkPictures, ABrokenSceneShowsItsErrorAndNoAcuity) {
  write_scene(R"("lihgts": [])");
  const Outcome got = herr("inspect scene/other.scene.json");
  EXPECT_EQ(got.exit_code, 3);
  EXPECT_TRUE(says(got.out, "1 error")) << got.out;
  EXPECT_FALSE(says(got.out, "samples per degree")) << got.out;
}

}  // namespace
}  // namespace herr
