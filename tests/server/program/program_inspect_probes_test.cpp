// `herr inspect --probe-pictures` as its users run it: a folder that is whole or not there, the same bytes
// each time.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/paths.h"
#include "tests/server/program/child_program.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class InspectProbes : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_session(root() / "session", 0.5);
  }
  const fs::path& root() const { return folder_.path(); }
  Outcome herr(const std::string& arguments) const { return run_program(root(), "inspect " + arguments); }
  std::vector<std::string> names_in(const fs::path& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(root() / folder))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(InspectProbes, WritesPicturesAndAnIndexOfASession) {
  const Outcome got = herr("session --probe-pictures new/probes --probe-updates 3");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  EXPECT_EQ(names_in("new/probes"),
            (std::vector<std::string>{"catchers_distance.exr", "catchers_distance.png",
                                      "catchers_irradiance.exr", "catchers_irradiance.png", "distance.exr",
                                      "distance.png", "irradiance.exr", "irradiance.png", "probes.json"}));
  EXPECT_EQ(names_in("new"), std::vector<std::string>{"probes"}) << "nothing beside it";
  EXPECT_NE(got.out.find("probes in new/probes\n  2048 probes: "), std::string::npos) << got.out;
  EXPECT_NE(got.out.find("after 3 updates at 60 Hz of 64 rays each"), std::string::npos) << got.out;

  const auto index = nlohmann::json::parse(content_of(root() / "new/probes/probes.json"));
  EXPECT_EQ(index["grid"]["counts"], (std::vector<int>{16, 8, 16}));
  EXPECT_EQ(index["updates"], 3);
  ASSERT_EQ(index["probes"].size(), 2048u);
  std::int64_t active = 0, inactive = 0, relocated = 0;
  for (const auto& probe : index["probes"]) {
    ++(probe["state"] == "active" ? active : inactive);
    relocated += probe["relocated"] == true ? 1 : 0;
  }
  EXPECT_EQ(index["counts"]["active"], active);
  EXPECT_EQ(index["counts"]["inactive"], inactive);
  EXPECT_EQ(index["counts"]["relocated"], relocated);
  EXPECT_GT(active, 0);
  ASSERT_EQ(index["atlases"].size(), 4u);
  EXPECT_EQ(index["atlases"][3]["exr"], "catchers_distance.exr");
  EXPECT_EQ(index["atlases"][3]["tile_px"], 35);
}

TEST_F(InspectProbes, GivesTheSameBytesWithAnyNumberOfThreads) {
  ASSERT_EQ(herr("scene/small.scene.json --probe-pictures one --probe-updates 4 --threads 1").exit_code, 0);
  ASSERT_EQ(herr("scene/small.scene.json --probe-pictures two --probe-updates 4 --threads 3").exit_code, 0);
  ASSERT_FALSE(names_in("one").empty());
  ASSERT_EQ(names_in("one"), names_in("two"));
  for (const std::string& name : names_in("one"))
    EXPECT_EQ(content_of(root() / "one" / name), content_of(root() / "two" / name)) << name;
}

TEST_F(InspectProbes, ReplacesAnEarlierFolderOnlyWhenAskedAndNothingElse) {
  ASSERT_EQ(herr("scene/small.scene.json --probe-pictures p --probe-updates 2").exit_code, 0);
  const std::string before = content_of(root() / "p/irradiance.exr");
  EXPECT_EQ(herr("scene/small.scene.json --probe-pictures p").exit_code, 2);
  EXPECT_EQ(content_of(root() / "p/irradiance.exr"), before);
  EXPECT_EQ(herr("scene/small.scene.json --probe-pictures p --overwrite --probe-updates 3").exit_code, 0);
  EXPECT_NE(content_of(root() / "p/irradiance.exr"), before);
  write_text(root() / "p/thesis.txt", "years");
  const Outcome got = herr("scene/small.scene.json --probe-pictures p --overwrite");
  EXPECT_EQ(got.exit_code, 2);
  EXPECT_NE(got.err.find("thesis.txt"), std::string::npos) << got.err;
  EXPECT_EQ(content_of(root() / "p/thesis.txt"), "years");
}

TEST_F(InspectProbes, BadInputWritesNothing) {
  write_text(root() / "scene/empty.scene.json",
             R"({"format_version": 1, "name": "empty", "lights": [{"name": "lamp", "centre": [0, 1, 0],
"size": [0.1, 0.1, 0.1], "intensity_w_sr": [1, 1, 1]}]})");
  write_text(root() / "scene/broken.scene.json", "{");
  for (const char* what : {"scene/empty.scene.json", "scene/broken.scene.json", "nowhere"}) {
    const Outcome got = herr(std::string(what) + " --probe-pictures deep/p");
    EXPECT_EQ(got.exit_code, 3) << what << got.err;
    EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
    EXPECT_FALSE(fs::exists(root() / "deep")) << what;
  }
}

// Everywhere else --probes is a switch.
TEST_F(InspectProbes, TheFormerNameOfTheFlagIsRefusedWithTheNewOne) {
  for (const char* flags : {"--probes p", "--probes", "--probes=p"}) {
    const Outcome got = herr(std::string("scene/small.scene.json ") + flags);
    EXPECT_EQ(got.exit_code, 2) << flags;
    EXPECT_EQ(got.err, "herr: --probes: is called --probe-pictures here; give --probe-pictures DIR\n")
        << flags;
  }
}

TEST_F(InspectProbes, RefusesWrongUsage) {
  for (const char* flags : {"--probe-pictures ''", "--probe-pictures .", "--probe-pictures scene",
                            "--probe-pictures p --probe-updates 0", "--probe-updates 3", "--overwrite",
                            "--probe-pictures p --probe-rays 7"}) {
    const Outcome got = herr(std::string("scene/small.scene.json ") + flags);
    EXPECT_EQ(got.exit_code, 2) << flags << got.err;
    EXPECT_EQ(got.out, "") << flags;
    EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
  }
  EXPECT_FALSE(fs::exists(root() / "p"));
}

TEST_F(InspectProbes, ASignalLeavesNothingBehind) {
  ChildProgram herr(root(), {test::program_path(), "inspect", "scene/small.scene.json", "--probe-pictures",
                             "deep/p", "--probe-updates", "100000"});
  while (!fs::exists(root() / "deep") && herr.runs())
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  herr.send(SIGTERM);
  EXPECT_EQ(herr.finish(), 143);
  EXPECT_EQ(herr.out(), "");
  EXPECT_FALSE(fs::exists(root() / "deep"));
}

}  // namespace
}  // namespace herr
