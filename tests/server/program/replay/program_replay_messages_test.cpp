// What a replay says beside its results: of several sessions the bad ones, of flags those that do nothing.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/server/program/replay/replay_program.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class ReplayMessages : public ReplayProgram {};

TEST_F(ReplayMessages, OneBadSessionDoesNotStopTheOthers) {
  fs::create_directories(root() / "empty");
  const Outcome outcome = replay_of("empty walk", "--frames 2 --out o --json");
  EXPECT_EQ(outcome.exit_code, 3);
  const auto json = nlohmann::json::parse(outcome.out);
  ASSERT_EQ(json["sessions"].size(), 2u);
  EXPECT_EQ(json["sessions"][0]["exit_code"], 3);
  EXPECT_EQ(json["sessions"][1]["frames"]["rendered"], 2);
  EXPECT_EQ(json["exit_code"], 3);
}

TEST_F(ReplayMessages, AFormatThatStandsApartIsNoSession) {
  const Outcome outcome = replay_of("walk", "--frames 2 --out o --format png exr");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("there is no session 'exr', but a format of that name; did you mean --format "
                             "png,exr?\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_FALSE(fs::exists(root() / "o"));
}

// The folder of a refused session is written before the first frame of the others: its summary is older than
// the rows of the session that stands before it on the line.
TEST_F(ReplayMessages, RefusedSessionsAreToldBeforeTheFirstFrame) {
  fs::create_directories(root() / "empty");
  fs::create_directories(root() / "bare");
  const Outcome all = herr("replay empty bare --profile small.profile.json --out none");
  EXPECT_EQ(all.exit_code, 3);
  EXPECT_EQ(lines_in(all.err), 4) << all.err;
  EXPECT_NE(all.err.find("2 of 2 sessions refused: empty (exit 3), bare (exit 3); none is left to replay\n"),
            std::string::npos)
      << all.err;
  EXPECT_NE(all.err.find("0 of 2 sessions done, 2 failed: empty (empty"), std::string::npos) << all.err;
  const Outcome one = replay_of("walk empty", "--frames 2 --out o --format none --contact-sheet none");
  EXPECT_EQ(one.exit_code, 3);
  EXPECT_NE(one.err.find("1 of 2 sessions refused: empty (exit 3); the other one is replayed\n"),
            std::string::npos)
      << one.err;
  EXPECT_LE(fs::last_write_time(root() / "o/empty/summary.json"),
            fs::last_write_time(root() / "o/walk/frames.csv"));
}

// Of three sessions the second has a bad row: the first line on stderr names it, before the first frame; the
// other two have 2 frames each.
TEST_F(ReplayMessages, ABadSessionAmongOthersIsNamedFirstAndLastAndLeavesASummary) {
  write_small_session(root() / "broken", 0.2);
  write_small_session(root() / "third", 0.2);
  write_text(root() / "broken/pose/data.csv",
             content_of(root() / "broken/pose/data.csv") + "2000000000,0,1,nan,0,0,0,1\n");
  const std::string sessions = "walk broken third",
                    flags = "--frames 2 --out o --format none --contact-sheet none";
  const Outcome bad = replay_of(sessions, flags);
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_NE(bad.out.find("\n2 of 3 sessions: 4 frames"), std::string::npos) << bad.out;
  EXPECT_EQ(bad.err.find("herr: broken/pose/data.csv:"), 0u) << bad.err;
  // One line tells the error, one counts, one is the last; nothing else, and two of them before a frame.
  ASSERT_EQ(lines_in(bad.err), 3) << bad.err;
  EXPECT_NE(bad.err.find("--keep-going\nherr: 1 of 3 sessions refused: broken (exit 3); the other 2 are "
                         "replayed\n"),
            std::string::npos)
      << bad.err;
  const std::size_t last = bad.err.rfind("herr: ");
  EXPECT_EQ(bad.err.find("herr: 2 of 3 sessions done, 1 failed: broken (broken/pose/data.csv:", last), last)
      << bad.err;
  EXPECT_TRUE(bad.err.ends_with(", exit 3)\n")) << bad.err;
  EXPECT_EQ(files_below(root() / "o/broken"), std::vector<std::string>{"summary.json"});
  const auto refused = summary("o", "broken");
  EXPECT_EQ(refused["state"], "failed");
  EXPECT_EQ(refused["exit_code"], 3);
  EXPECT_NE(refused["error"].get<std::string>().find("data.csv:"), std::string::npos);

  // --keep-going gets past it; the failed session's folder is as good as an empty one, done ones stay.
  const Outcome again = replay_of(sessions, flags + " --resume --keep-going");
  EXPECT_EQ(again.exit_code, 5) << again.err;
  EXPECT_NE(again.out.find("\nall 3 sessions: 6 frames"), std::string::npos) << again.out;
  EXPECT_TRUE(
      again.err.ends_with("herr: 3 of 3 sessions done, 1 of them in part: broken (1 row left out, exit 5)\n"))
      << again.err;
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
            "once; give --light-samples 9 or more, or leave it out\n");
  EXPECT_EQ(outcome.out.find("acuity"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("first light"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace herr
