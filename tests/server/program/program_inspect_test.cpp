// `herr inspect` as its users run it: exit codes, one line on stderr, the same verdict as replay, JSON.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "sessions/files/atomic_file.h"
#include "tests/paths.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class InspectProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_session(root() / "session", 0.5);
  }
  const fs::path& root() const { return folder_.path(); }

  Outcome herr(const std::string& arguments) const { return run_program(root(), arguments); }
  void append(const std::string& file, const std::string& text) const {
    write_whole_file(root() / file, content_of(root() / file) + text);
  }
  TemporaryFolder folder_;
};

TEST_F(InspectProgram, FindsTheSmallSessionSound) {
  const Outcome got = herr("inspect session");
  EXPECT_EQ(got.exit_code, 0) << got.err;
  EXPECT_EQ(got.err, "");
  for (const char* part : {"session small", "head turns, deg/s", "gaze eccentricity", "frame plan",
                           "one flat catcher cannot shadow itself", "0 errors", "sound: replay takes it"})
    EXPECT_NE(got.out.find(part), std::string::npos) << part;
  EXPECT_EQ(herr("inspect session/session.json").out, got.out);
}

// 788 / ln(55.7356) = 196.00 for a gaze straight ahead, as that of the session is; 768 * 22.04 / (360
// sin 21.04 deg) = 131.0. xr1-half has 1200 pixels over 2 tan 20 deg: 28.8 a degree in the middle.
TEST_F(InspectProgram, TellsTheAcuityThatFramesReach) {
  const Outcome text = herr("inspect session");
  for (const char* part :
       {"recorded gaze, worst frame", "196.0", "131.0", "samples per degree, gaze straight ahead"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << "\n" << text.out;
  const auto json = nlohmann::json::parse(herr("inspect session --json").out)["acuity"];
  EXPECT_EQ(json["frames"]["k_radial_per_deg"]["count"], 31) << "half a second at 60 Hz";
  EXPECT_NEAR(json["frames"]["k_radial_per_deg"]["min"].get<double>(), 196.0, 0.05);
  EXPECT_NEAR(json["gazes"][0]["k_angular_per_deg"].get<double>(), 131.0, 0.05);
  EXPECT_NEAR(json["gazes"][2]["theta_max_deg"].get<double>(), 109.47, 0.01) << "from corner to corner";
  const auto curves = json["straight_ahead"];
  EXPECT_NEAR(curves["display_per_deg"][0].get<double>(), 28.77, 0.01);
  EXPECT_EQ(curves["acuity_per_deg"][0], 200.0);
  EXPECT_TRUE(curves["angular_per_deg"][0].is_null());
  const auto follows = nlohmann::json::parse(herr("inspect session --polar acuity --json").out)["acuity"];
  EXPECT_GE(follows["frames"]["k_radial_per_deg"]["min"].get<double>(), 200);
  EXPECT_GE(follows["frames"]["k_angular_per_deg"]["min"].get<double>(), 200);
  EXPECT_FALSE(nlohmann::json::parse(herr("inspect session --foveation off --json").out).contains("acuity"));
}

TEST_F(InspectProgram, WritesTheAcuityPlotOnceAndOnlyAsSvg) {
  const Outcome got = herr("inspect session --acuity-plot plot.svg");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  const std::string svg = content_of(root() / "plot.svg");
  EXPECT_EQ(svg.find("<svg xmlns="), 0u);
  for (const char* part :
       {"acuity function", "samples along the radius, k 196.0", "k 131.0 at least", "pixels of"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
  EXPECT_EQ(herr("inspect session --acuity-plot plot.svg").exit_code, 2) << "it is there already";
  EXPECT_EQ(herr("inspect session --acuity-plot plot.svg --overwrite").exit_code, 0);
  EXPECT_EQ(content_of(root() / "plot.svg"), svg);
  EXPECT_EQ(herr("inspect session --acuity-plot plot.png").exit_code, 2);
  EXPECT_EQ(herr("inspect session --acuity-plot other.svg --foveation off").exit_code, 2);
  EXPECT_EQ(herr("inspect session --overwrite").exit_code, 2);
  EXPECT_EQ(herr("inspect session --acuity-plot missing/plot.svg").exit_code, 75);
}

TEST_F(InspectProgram, RefusesABadRowInTheWordsOfReplay) {
  append("session/pose/data.csv", "0,0,0,0,0,0,0,1\nx,0,0,0,0,0,0,1\n");
  const Outcome got = herr("inspect session");
  EXPECT_EQ(got.exit_code, 3);
  EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
  // Replay adds the flag that inspect does not have.
  EXPECT_EQ(got.err.substr(0, got.err.size() - 1) + ", or leave it out with --keep-going\n",
            herr("replay session --format none").err);
  EXPECT_NE(got.out.find("2 errors"), std::string::npos) << got.out;
  EXPECT_NE(got.out.find("with --keep-going it leaves out 2 rows"), std::string::npos) << got.out;
}

TEST_F(InspectProgram, RefusesAMissingSceneAndOneThatIsBroken) {
  fs::remove(root() / "scene/triangle.gltf");
  const Outcome got = herr("inspect session");
  EXPECT_EQ(got.exit_code, 3);
  EXPECT_EQ(got.err, herr("replay session --format none").err);
  EXPECT_NE(got.out.find("head turns"), std::string::npos) << "the recording is described all the same";
  EXPECT_EQ(herr("inspect scene/small.scene.json").exit_code, 3);
  EXPECT_EQ(herr("inspect nowhere").err, herr("replay nowhere --format none").err);
}

TEST_F(InspectProgram, ATableNamesTheCommandThatMakesASessionOfIt) {
  write_whole_file(root() / "my walk.csv", "t,x\n0,1\n");
  const Outcome table = herr("inspect 'my walk.csv'");
  EXPECT_EQ(table.exit_code, 3);
  EXPECT_NE(table.err.find(
                "my walk.csv: is neither a session nor a scene; make a session of a recording: 'herr convert "
                "'my walk.csv' OUT', or name a .scene.json"),
            std::string::npos)
      << table.err;
  const Outcome stream = herr("inspect session/pose/data.csv");
  EXPECT_EQ(stream.exit_code, 3);
  EXPECT_NE(stream.err.find("is one stream of a session; inspect the session: 'herr inspect "),
            std::string::npos)
      << stream.err;
}

// The triangle stands two metres ahead; by half a turn about y it stands behind, and the line that inspect
// prints brings it back: the head stays where it is, at (0, 1, 0), and is turned by half a turn again.
TEST_F(InspectProgram, SaysWhichObjectsAreInViewAndHowToTurnTheRecording) {
  const Outcome ahead = herr("inspect session");
  EXPECT_NE(ahead.out.find("in view\n"), std::string::npos) << ahead.out;
  EXPECT_EQ(ahead.out.find("the head looks past it"), std::string::npos) << ahead.out;
  auto scene = nlohmann::json::parse(content_of(root() / "scene/small.scene.json"));
  scene["world_from_session"] = {{"position", {0, 0, 0}}, {"orientation_xyzw", {0, 1, 0, 0}}};
  write_whole_file(root() / "scene/small.scene.json", scene.dump());
  const auto report = nlohmann::json::parse(herr("inspect session --json").out);
  EXPECT_EQ(report["in_view"]["subject_share"], 0);
  for (const auto& object : report["scene"]["objects"]) {
    if (!object["catcher"]) {
      EXPECT_EQ(object["in_view_share"], 0) << object;
    }
  }
  const std::string text = herr("inspect session").out;
  const std::size_t line = text.find("\"world_from_session\": {");
  ASSERT_NE(line, std::string::npos) << text;
  scene.update(nlohmann::json::parse("{" + text.substr(line, text.find('\n', line) - line) + "}"));
  write_whole_file(root() / "scene/small.scene.json", scene.dump());
  const auto turned = nlohmann::json::parse(herr("inspect session --json").out);
  EXPECT_EQ(turned["in_view"]["subject_share"], 1);
  EXPECT_TRUE(turned["in_view"]["world_from_session"].is_null());
}

// The head goes along +x at 0.1 m/s and looks ahead: it passes a middle at x = 0.035 m after 0.35 s, a tenth
// is told.
TEST_F(InspectProgram, SaysWhenAnObjectIsMostCentral) {
  auto scene = nlohmann::json::parse(content_of(root() / "scene/small.scene.json"));
  scene["gltf"][0]["translation"] = {0.035, 0, 0};
  write_whole_file(root() / "scene/small.scene.json", scene.dump());
  const std::string text = herr("inspect session").out;
  EXPECT_NE(text.find("100 %     100 %   at 0.3 s: --start 0.3\n"), std::string::npos) << text;
  const auto report = nlohmann::json::parse(herr("inspect session --json").out);
  for (const auto& object : report["scene"]["objects"]) {
    EXPECT_EQ(object["most_central_s"], object["catcher"] ? nlohmann::json() : nlohmann::json(0.3)) << object;
    EXPECT_EQ(object["middle_in_view_share"], object["catcher"] ? nlohmann::json() : nlohmann::json(1));
  }
}

TEST_F(InspectProgram, TakesACutOffLineForAnErrorOnlyWhenStrict) {
  append("session/gaze/data.csv", "1500");
  const Outcome lenient = herr("inspect session");
  EXPECT_EQ(lenient.exit_code, 0);
  EXPECT_NE(lenient.out.find("the file ends within this line"), std::string::npos);
  EXPECT_EQ(herr("inspect session --strict").exit_code, 3);
}

TEST_F(InspectProgram, WritesOneJsonDocument) {
  const Outcome got = herr("inspect session --json --profile xr1 --light-samples 64");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  const auto report = nlohmann::json::parse(got.out);
  EXPECT_EQ(report["kind"], "session");
  EXPECT_EQ(report["exit_code"], 0);
  const auto& streams = report["session"]["streams"];
  ASSERT_EQ(streams.size(), 3u);
  EXPECT_EQ(streams[0]["rows"], 46);  // 0.5 s at 90 Hz and the one at 0
  EXPECT_EQ(streams[1]["name"], "gaze");
  EXPECT_EQ(streams[2]["nominal_hz"], 10);
  EXPECT_EQ(report["session"]["frames"], 31);  // at 60 Hz
  EXPECT_EQ(streams[0]["age_at_frames"]["frames"], 31);
  EXPECT_EQ(report["scene"]["triangles"], 1);
  EXPECT_EQ(report["profile"]["name"], "xr1");
  const auto& plan = report["plan"];
  const auto samples =
      std::find_if(plan.begin(), plan.end(), [](const auto& e) { return e["name"] == "light samples"; });
  ASSERT_NE(samples, plan.end());
  EXPECT_EQ((*samples)["reason"], "64 jittered strata per light");
  // A document also where the input is bad.
  EXPECT_EQ(nlohmann::json::parse(herr("inspect nowhere --json").out)["exit_code"], 3);
}

TEST_F(InspectProgram, DescribesASceneAlone) {
  const Outcome got = herr("inspect scene/small.scene.json");
  EXPECT_EQ(got.exit_code, 0) << got.err;
  for (const char* part : {"1 in 1 instance, and 2 in 1 catcher", "no session is inspected", "sound:"})
    EXPECT_NE(got.out.find(part), std::string::npos) << got.out;
  EXPECT_EQ(nlohmann::json::parse(herr("inspect scene/triangle.gltf --json").out)["kind"], "scene");
}

TEST_F(InspectProgram, RefusesWrongUsage) {
  for (const char* line : {"inspect", "inspect ''", "inspect session --sceen x", "inspect session session",
                           "inspect scene/small.scene.json --scene scene/small.scene.json",
                           "inspect session --light-samples 0"}) {
    const Outcome got = herr(line);
    EXPECT_EQ(got.exit_code, 2) << line << got.err;
    EXPECT_EQ(got.out, "") << line;
    EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
  }
}

}  // namespace
}  // namespace herr
