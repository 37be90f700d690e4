// What a replay says beside its results: of several sessions the bad ones, of flags those that do nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class ReplayMessages : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "walk", 0.25);
  }
  const fs::path& root() const { return folder_.path(); }

  Outcome herr(const std::string& arguments) const { return run_program(root(), arguments); }

 private:
  TemporaryFolder folder_;
};

TEST_F(ReplayMessages, OneBadSessionDoesNotStopTheOthers) {
  fs::create_directories(root() / "empty");
  const Outcome outcome = herr(
      "replay empty walk --profile small.profile.json --preset direct --polar 128x64 --frames 2 --out o "
      "--json");
  EXPECT_EQ(outcome.exit_code, 3);
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["sessions"].size(), 2u);
  EXPECT_EQ(json["sessions"][0]["exit_code"], 3);
  EXPECT_EQ(json["sessions"][1]["frames"]["rendered"], 2);
  EXPECT_EQ(json["exit_code"], 3);
}

// Of three sessions the second has a bad row: the first line on stderr names it, before the first frame; the
// other two have 2 frames each.
TEST_F(ReplayMessages, ABadSessionAmongOthersIsNamedFirstAndLastAndLeavesASummary) {
  write_small_session(root() / "broken", 0.2);
  write_small_session(root() / "third", 0.2);
  write_text(root() / "broken/pose/data.csv",
             content_of(root() / "broken/pose/data.csv") + "2000000000,0,1,nan,0,0,0,1\n");
  const std::string flags =
      " walk broken third --profile small.profile.json --preset direct --polar 128x64 --frames 2 --out o "
      "--format none --contact-sheet none";
  const Outcome bad = herr("replay" + flags);
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_NE(bad.out.find("\n2 of 3 sessions: 4 frames"), std::string::npos) << bad.out;
  EXPECT_EQ(bad.err.find("herr: broken/pose/data.csv:"), 0u) << bad.err;
  EXPECT_NE(bad.err.find("--keep-going\n"), std::string::npos) << bad.err;
  const std::size_t last = bad.err.rfind("herr: ");
  EXPECT_EQ(bad.err.find("herr: 1 of 3 sessions failed: broken (exit 3): broken/pose/data.csv:", last), last)
      << bad.err;
  EXPECT_EQ(files_below(root() / "o/broken"), std::vector<std::string>{"summary.json"});
  const auto summary = nlohmann::json::parse(content_of(root() / "o/broken/summary.json"));
  EXPECT_EQ(summary["state"], "failed");
  EXPECT_EQ(summary["exit_code"], 3);
  EXPECT_NE(summary["error"].get<std::string>().find("data.csv:"), std::string::npos);

  // --keep-going gets past it; the failed session's folder is as good as an empty one, done ones stay.
  const Outcome again = herr("replay" + flags + " --resume --keep-going");
  EXPECT_EQ(again.exit_code, 5) << again.err;
  EXPECT_NE(again.out.find("\nall 3 sessions: 6 frames"), std::string::npos) << again.out;
  EXPECT_EQ(lines_in(content_of(root() / "o/broken/frames.csv")), 3);
}

TEST_F(ReplayMessages, AnErrorThatKeepGoingDoesNotGetPastDoesNotNameIt) {
  fs::remove(root() / "walk/pose/data.csv");
  const Outcome outcome = herr("replay walk --profile small.profile.json --out o");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.err.find("--keep-going"), std::string::npos) << outcome.err;
}

TEST_F(ReplayMessages, AFlagThatDoesNothingIsWarnedOfOnceAndNotToldAsActing) {
  const Outcome outcome = herr(
      "replay walk --profile small.profile.json --foveation off --polar acuity --light-samples 4 "
      "--first-light-samples 8 --frames 1 --out o --format none --contact-sheet none");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err,
            "herr: warning: --polar acuity: no effect with --foveation off, which has no polar buffer; "
            "leave it out\n"
            "herr: warning: --first-light-samples 8: no effect with --light-samples 4, which are traced at "
            "once; give more of them, or leave it out\n");
  EXPECT_EQ(outcome.out.find("acuity"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("first light"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace herr
