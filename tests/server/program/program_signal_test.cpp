// Signals that come at a bad moment.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "tests/paths.h"
#include "tests/server/program/child_program.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

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
