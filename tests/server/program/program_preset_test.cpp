// `herr replay` with no flags renders the frame of the paper, and says so.
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

// Two frames: poses at 0, 1/90 and 2/90 s, the display at 60 Hz.
class ProgramPreset : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(folder_.path() / "scene");
    write_small_session(folder_.path() / "walk", 0.025);
  }

  Outcome herr(const std::string& arguments) const { return run_program(folder_.path(), arguments); }
  nlohmann::json summary(const std::string& out) const {
    return nlohmann::json::parse(content_of(folder_.path() / out / "walk" / "summary.json"));
  }
  // Entries of the frame plan, by name.
  static std::map<std::string, bool> runs(const nlohmann::json& plan) {
    std::map<std::string, bool> entries;
    for (const auto& entry : plan) entries[entry["name"]] = entry["runs"];
    return entries;
  }
  nlohmann::json inspected(const std::string& flags) const {
    const Outcome outcome = herr("inspect walk --json " + flags);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(ProgramPreset, WithNoFlagsReplayRendersThePapersFrameAndSaysSo) {
  const Outcome outcome = herr("replay walk");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("occlusion rays 1"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(", probes"), std::string::npos) << outcome.out;
  const auto json = summary("out");
  for (const auto& plan : {json["plan"], inspected("")["plan"]}) {
    const auto entries = runs(plan);
    EXPECT_TRUE(entries.at("probes"));
    EXPECT_TRUE(entries.at("ambient occlusion"));
    EXPECT_FALSE(entries.at("constant ambient light"));
  }
  EXPECT_EQ(json["settings"]["probes"], true);
  EXPECT_EQ(json["settings"]["occlusion_rays"], 1);
  // 64 rays of each active probe in each of two frames, none asleep yet.
  EXPECT_EQ(json["frames"]["rendered"], 2);
  EXPECT_GT(json["probes"]["active"], 0);
  EXPECT_EQ(json["counters"]["probe_rays"], 2 * 64 * json["probes"]["active"].get<int>());
  EXPECT_GT(json["counters"]["occlusion_rays"], 0);
}

TEST_F(ProgramPreset, DirectLightAloneIsAskedForByItsName) {
  const Outcome outcome = herr("replay walk --preset direct");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("occlusion rays 0"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("no probes"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("probe rays"), std::string::npos) << outcome.out;
  const auto json = summary("out");
  for (const auto& plan : {json["plan"], inspected("--preset direct")["plan"]}) {
    const auto entries = runs(plan);
    EXPECT_FALSE(entries.at("probes"));
    EXPECT_FALSE(entries.at("ambient occlusion"));
    EXPECT_TRUE(entries.at("constant ambient light"));
  }
  EXPECT_EQ(json["settings"]["probes"], false);
  EXPECT_EQ(json["settings"]["occlusion_rays"], 0);
  EXPECT_FALSE(json.contains("probes"));
  for (const std::string rays : {"probe_rays", "occlusion_rays", "catcher_occlusion_rays"}) {
    EXPECT_EQ(json["counters"][rays], 0) << rays;
  }
}

}  // namespace
}  // namespace herr
