// One session through the replay loop, in this process: what the program's own tests cannot bring about.
#include "server/replay/replay_session.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "server/cli/stop_signal.h"
#include "small_session.h"
#include "temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class ReplaySession : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "walk", 0.25);
    options_.out = root() / "o";
    options_.profile = (root() / "small.profile.json").string();
    options_.format = PictureFormat::none;
    options_.sheet = SheetChoice::none;
    options_.overwrite = true;
    options_.render.polar_width = 64;
    options_.render.polar_height = 64;
    options_.render.threads = 1;
  }
  const fs::path& root() const { return folder_.path(); }
  SessionReport replay() const { return replay_session(root() / "walk", options_); }
  nlohmann::json summary() const {
    return nlohmann::json::parse(content_of(root() / "o" / "walk" / "summary.json"));
  }

  ReplayOptions options_;

 private:
  TemporaryFolder folder_;
};

TEST_F(ReplaySession, CountsTrianglesOnceAndNoCatchers) {
  ASSERT_EQ(replay().exit_code, 0);
  // One triangle; the floor's two are a catcher's.
  EXPECT_EQ(summary()["scene"]["triangles"], 1);
}

using ReplaySessionDeathTest = ReplaySession;

TEST_F(ReplaySessionDeathTest, ASignalBeforeTheFirstFrameLeavesEarlierResultsAlone) {
  // The signal stays for the rest of a process, so it is sent in a process of its own.
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  write_text(root() / "o/walk/summary.json", "earlier");
  const auto interrupted = [&] {
    install_signal_handling();
    ::raise(SIGINT);
    const SessionReport report = replay();
    const bool kept = content_of(root() / "o/walk/summary.json") == "earlier";
    fs::remove_all(root());  // exit() does not end the fixture
    std::exit(kept && report.state == ReplayState::interrupted ? report.exit_code : 1);
  };
  EXPECT_EXIT(interrupted(), ::testing::ExitedWithCode(130), "");
}

}  // namespace
}  // namespace herr
