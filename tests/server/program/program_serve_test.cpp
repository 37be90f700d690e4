// `herr serve` as its users run it: an address on stdout, pages while frames are rendered, a clean end.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/paths.h"
#include "tests/server/program/serve_program.h"

namespace herr {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

TEST_F(ServeProgram, AnswersWhileItRendersAndEndsCleanlyOnEitherSignal) {
  for (const int signal : {SIGTERM, SIGINT}) {
    start({"--port", "0"});
    const int port = this->port();
    ASSERT_NE(port, 0) << content_of(root() / "stderr.txt");
    ASSERT_TRUE(wait_for_frames(port));
    for (const char* path : {"/", "/livez", "/v1/status", "/v1/latency", "/v1/frames", "/v1/plan", "/metrics",
                             "/v1/frames/latest/left_focus.png"}) {
      EXPECT_EQ(get(port, path).status, 200) << path;
    }
    EXPECT_EQ(end(signal), 0);
    EXPECT_NE(content_of(root() / "stdout.txt").find("first hits"), std::string::npos);
    EXPECT_EQ(content_of(root() / "stderr.txt"), "");
  }
}

TEST_F(ServeProgram, LapsFollowEachOtherUnderEveryClock) {
  for (const char* clock : {"realtime", "virtual", "max"}) {
    start({"--port", "0", "--clock", clock});
    const int port = this->port();
    ASSERT_TRUE(port != 0 && wait_for_frames(port));
    nlohmann::json status{{"lap", 0}};
    // A lap has 15 frames, a quarter of a second in real time.
    for (int i = 0; i < 1000 && status["lap"] < 2; ++i) {
      status = nlohmann::json::parse(get(port, "/v1/status").body);
      std::this_thread::sleep_for(milliseconds(10));
    }
    EXPECT_GE(status["lap"], 2) << clock;
    EXPECT_EQ(status["clock"], clock);
    EXPECT_EQ(end(SIGTERM), 0);
  }
}

TEST_F(ServeProgram, APortInUseIsOneClearLineAndExitCode75) {
  start({"--port", "0"});
  const int port = this->port();
  ASSERT_NE(port, 0);
  const std::string second = "cd '" + root().string() + "' && " + test::program_path() +
                             " serve walk --port " + std::to_string(port) + " >second.txt 2>&1";
  const int status = std::system(second.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 75);
  const std::string message = content_of(root() / "second.txt");
  EXPECT_EQ(message,
            "herr: --port: cannot listen on 127.0.0.1:" + std::to_string(port) +
                ": Address already in use; end the program that has it, or choose another --port (0: a "
                "free one)\n");
  EXPECT_EQ(end(SIGTERM), 0);
}

TEST_F(ServeProgram, ABadSessionEndsItWithExitCode3) {
  fs::remove(root() / "walk" / "pose" / "data.csv");
  start({"--port", "0"});
  EXPECT_EQ(wait(), 3);
}

// 0.25 s at 60 Hz are frames 0 ... 14: each is rendered or dropped.
TEST_F(ServeProgram, ReplayInRealTimeAccountsForEveryFrame) {
  const std::string line = "cd '" + root().string() + "' && " + test::program_path() +
                           " replay walk --profile small.profile.json --preset direct --polar 128x64 --clock "
                           "realtime --format none "
                           "--contact-sheet none --out o >/dev/null 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 0);
  const auto frames = nlohmann::json::parse(content_of(root() / "o" / "walk" / "summary.json"))["frames"];
  EXPECT_EQ(frames["rendered"].get<int>() + frames["dropped"].get<int>(), 15);
  EXPECT_GE(frames["rendered"].get<int>(), 1);
}

}  // namespace
}  // namespace herr
