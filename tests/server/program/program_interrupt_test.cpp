// Signals that come at a bad moment; and a replay that was interrupted at any instant ends, with --resume,
// like one that was not.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/paths.h"
#include "tests/server/program/resumed_replay.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class Interrupted : public Resume {
 protected:
  // Starts or goes on, and sends `signal` some random time after a random row of frames.csv, or after a
  // random time of the start.
  void interrupt(const std::string& out, int signal) {
    const long rows = engine_() % 4 == 0 ? -1 : static_cast<long>(engine_() % kFrames);
    const auto more = std::chrono::microseconds(engine_() % (rows < 0 ? 60'000 : 10'000));
    const std::string flags = kFlags + "--resume --out " + out;
    ChildProgram herr(root(), [&flags] { return replay_with(flags); });
    while (rows >= 0 && rows_in(out) < rows && herr.runs() && !herr_is_done(out)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(more);
    herr.send(signal);
    herr.finish();
    const long left = rows_in(out);
    if (left > 0 && left < kFrames) ++interrupted_in_the_middle_;
    expect_rows_have_pictures(out, left);
  }
  // It may wait for a reader of its table then.
  static bool herr_is_done(const std::string& out) { return fs::exists(root() / out / "walk/summary.json"); }
  void interrupt_often(int times, int signal) {
    const auto seed = std::random_device{}();
    std::cout << "seed " << seed << '\n';
    engine_.seed(seed);
    for (int trial = 0; trial < times; ++trial) {
      SCOPED_TRACE("trial " + std::to_string(trial) + " of seed " + std::to_string(seed));
      const std::string out = "o" + std::to_string(trial);
      interrupt(out, signal);
      if (trial % 3 == 0) interrupt(out, signal);
      const Outcome outcome = resume(out);
      ASSERT_EQ(outcome.exit_code, 5) << outcome.err;
      expect_as_uninterrupted(out);
      fs::remove_all(root() / out);
    }
    // Three of four instants are chosen within the frames: that none hits is as good as impossible.
    EXPECT_GT(interrupted_in_the_middle_, 0);
  }

 private:
  std::mt19937 engine_;
  int interrupted_in_the_middle_ = 0;
};

TEST_F(Interrupted, AfterSigtermAtAnyInstantAllIsAsIfNothingHadHappened) {
  interrupt_often(20, SIGTERM);
}

TEST_F(Interrupted, AfterSigkillAtAnyInstantAllIsAsIfNothingHadHappened) {
  interrupt_often(10, SIGKILL);
}

TEST_F(Interrupted, ASignalInTheMiddleOfALongFrameEndsItWithoutAPicture) {
  // 4096 shadow rays for each of some hundred thousand samples: minutes.
  std::vector<std::string> words{
      test::program_path(), "replay",  "--out",    "long", "--light-samples", "4096", "--profile",
      "small.profile.json", "--polar", "1576x768", "walk"};
  ChildProgram herr(root(), words);
  while (!fs::exists(root() / "long/walk/frames.csv") && herr.runs()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const auto sent = std::chrono::steady_clock::now();
  herr.send(SIGTERM);
  EXPECT_EQ(herr.finish(), 143);
  // A tile of 1024 samples takes a second at worst.
  EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(10));
  EXPECT_TRUE(files_below(root() / "long/walk/frames").empty());
  EXPECT_EQ(nlohmann::json::parse(content_of(root() / "long/walk/summary.json"))["state"], "interrupted");
  EXPECT_EQ(rows_in("long"), 0);
}

// Waits until `reached` or the child's end.
void wait_until(ChildProgram& child, const std::function<bool()>& reached) {
  while (!reached() && child.runs()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

class Signals : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "first", 0.1);
    write_small_session(root() / "second", 0.1);
  }
  const fs::path& root() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

TEST_F(Signals, AfterTheLastFrameOfOneSessionTheOthersAreNotPassedOverInSilence) {
  ChildProgram herr(root(), {test::program_path(), "replay", "first", "second", "--profile",
                             "small.profile.json", "--polar", "64x64", "--format", "none", "--out", "o"});
  // All is written of the first session; the child now waits for somebody to read its table.
  wait_until(herr, [&] { return fs::exists(root() / "o/first/summary.json"); });
  herr.send(SIGINT);
  EXPECT_EQ(herr.finish(), 130) << herr.out();
  EXPECT_FALSE(fs::exists(root() / "o/second"));
}

TEST_F(Signals, BenchEndsWithTheSignalsNumberAndWithoutAResult) {
  // 1024 frames of 4 x 48 x 40 pixels: some seconds, long after the signal.
  ChildProgram herr(root(), {test::program_path(), "bench", "first", "--profile", "small.profile.json",
                             "--polar", "64x64", "--frames", "1024"});
  wait_until(herr, [&] { return herr.catches(SIGTERM); });
  herr.send(SIGTERM);
  EXPECT_EQ(herr.finish(), 143);
  EXPECT_EQ(herr.out(), "");
}

}  // namespace
}  // namespace herr
