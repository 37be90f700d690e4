// `herr synth` as its users run it: what it writes, `herr replay` takes; mistakes are refused
// before anything is written.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/paths.h"
#include "tests/server/program/child_program.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class SynthProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
  }
  const fs::path& root() const { return folder_.path(); }

  // `before` stands before the program's name in the shell's line, e.g. "ulimit -f 8;".
  Outcome herr(const std::string& arguments, const std::string& before = "") const {
    return run_program(root(), arguments, before);
  }
  Outcome replay(const std::string& session, const std::string& flags) const {
    return herr(with_more(
        "replay " + session +
            " --profile small.profile.json --preset direct --polar 64x32 --frames 2 --overwrite --out o-" +
            session + " --contact-sheet none ",
        flags));
  }
  // What lies in the folder beside what the test itself put there.
  std::vector<std::string> made() const {
    std::vector<std::string> names;
    for (const std::string& name : folder_.names())
      if (name != "scene" && name != "small.profile.json" && !name.starts_with("std") &&
          !name.starts_with("o-"))
        names.push_back(name);
    return names;
  }
  // Every file of a session, one after the other, with its name; the header's name and seed left out.
  std::string bytes_of(const std::string& session) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(root() / session))
      if (entry.is_regular_file() && entry.path().filename() != "session.json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::string bytes;
    for (const fs::path& file : files)
      bytes += fs::relative(file, root() / session).string() + "\n" + content_of(file);
    return bytes;
  }
  std::vector<std::vector<double>> rows_of(const std::string& file) const {
    std::istringstream lines(content_of(root() / file));
    std::vector<std::vector<double>> rows;
    std::string line, cell;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      rows.emplace_back();
      for (std::istringstream cells(line); std::getline(cells, cell, ',');)
        rows.back().push_back(std::stod(cell));
    }
    return rows;
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(SynthProgram, TheSameSeedGivesTheSameBytesWithAnyNumberOfThreadsAndAnotherSeedOthers) {
  const std::string flags =
      " --scene scene/small.scene.json --duration 1.5 --camera 24x16 --camera-hz 4 --motion turning "
      "--hitches-per-minute 60 --stamp-jitter-ms 2 --gaze pursuit ";
  ASSERT_EQ(herr("synth a --seed 3 --threads 1" + flags).exit_code, 0);
  ASSERT_EQ(herr("synth b --seed 3 --threads 4" + flags).exit_code, 0);
  ASSERT_EQ(herr("synth c --seed 4 --threads 1" + flags).exit_code, 0);
  EXPECT_GT(bytes_of("a").size(), 20000u);
  EXPECT_TRUE(bytes_of("a") == bytes_of("b"));
  EXPECT_FALSE(bytes_of("a") == bytes_of("c"));
}

// One line of flags for each seed, anything that the help offers, sizes and rates down to the smallest.
std::string random_flags(unsigned seed) {
  std::mt19937 random(seed);
  const auto one_of = [&](const std::vector<std::string>& words) { return words[random() % words.size()]; };
  const auto maybe = [&](const std::string& flag, const std::vector<std::string>& words) {
    return random() % 2 == 0 ? " " + flag + " " + one_of(words) : std::string();
  };
  return maybe("--motion", {"desk", "standing", "turning", "walking", "still"}) +
         maybe("--gaze", {"fixations", "pursuit", "reading", "still", "jumping"}) +
         maybe("--seed", {"0", "1", "999999999"}) + maybe("--duration", {"0.1", "0.7", "3"}) +
         maybe("--pose-hz", {"1", "2.5", "59.94", "1000"}) + maybe("--gaze-hz", {"1", "30", "1000"}) +
         maybe("--stamp-jitter-ms", {"0", "0.8", "5"}) + maybe("--hitches-per-minute", {"0", "7", "60"}) +
         maybe("--blinks-per-minute", {"0", "60"}) + maybe("--gaze-noise-deg", {"0", "5"}) +
         maybe("--start-ns", {"0", "1700000000000000000", "3999999990000000000"}) +
         maybe("--at", {"0,0,0", "0,1.6,1", "-40,1,900000"}) + maybe("--radius", {"0.25", "1", "1000"}) +
         maybe("--origin", {"1000000,-1000000,1000000", "0,0,0"}) +
         maybe("--replay-scene", {"../scene/small.scene.json", "../scene/small.scene.json", "nowhere.json"}) +
         maybe("--profile", {"xr1", "xr1-half", "small.profile.json"}) + " --camera " +
         one_of({"1x1", "4x4", "2x9", "33x17", "none", "none", "16384x16384"}) +
         maybe("--camera-hz", {"0.1", "5"}) + maybe("--camera-hfov", {"10", "90", "150"});
}

TEST_F(SynthProgram, WhateverItWritesReplayTakesAndWhateverItRefusesLeavesNothing) {
  int accepted = 0, refused = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const std::string flags = random_flags(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ":" + flags);
    const Outcome synth = herr("synth s" + flags);
    if (synth.exit_code == 2) {
      ++refused;
      EXPECT_EQ(std::count(synth.err.begin(), synth.err.end(), '\n'), 1) << synth.err;
      EXPECT_TRUE(made().empty());
      continue;
    }
    ++accepted;
    ASSERT_EQ(synth.exit_code, 0) << synth.err;
    const bool names_scene = flags.find("--replay-scene") != std::string::npos;
    const Outcome played = replay("s", names_scene ? "" : "--scene scene/small.scene.json");
    EXPECT_EQ(played.exit_code, 0) << played.err;
    fs::remove_all(root() / "s");
  }
  EXPECT_GE(accepted, 3);
  EXPECT_GE(refused, 3);
}

TEST_F(SynthProgram, LongStampsFarOriginsAndJumpingEyesRenderFiniteFrames) {
  ASSERT_EQ(herr("synth s --duration 7200 --pose-hz 10 --gaze-hz 30 --start-ns 1700000000000000000 "
                 "--origin 1000000,0,-1000000 --gaze jumping --motion turning")
                .exit_code,
            0);
  const Outcome played = replay("s", "--scene scene/small.scene.json --start 7199 --json");
  ASSERT_EQ(played.exit_code, 0) << played.err;
  const auto summary = nlohmann::json::parse(played.out)["sessions"][0];
  EXPECT_EQ(summary["frames"]["rendered"], 2);
  EXPECT_EQ(summary["counters"]["nonfinite_values"], 0);
}

TEST_F(SynthProgram, AnOriginThatTheSceneUndoesGivesTheSamePicture) {
  // Multiples of 1/4 m and micrometres below: the sum is exact to 2^-33 m, far below a float's step at 1 m.
  ASSERT_EQ(herr("synth near --duration 0.2 --at 0,1,1").exit_code, 0);
  ASSERT_EQ(herr("synth far --duration 0.2 --at 0,1,1 --origin 800000,-0.25,-1000000").exit_code, 0);
  std::string scene = content_of(root() / "scene/small.scene.json");
  scene.replace(scene.rfind('}'), 1,
                R"(, "world_from_session": {"position": [-800000, 0.25, 1000000],)"
                R"( "orientation_xyzw": [0, 0, 0, 1]}})");
  write_text(root() / "scene/far.scene.json", scene);
  ASSERT_EQ(replay("near", "--scene scene/small.scene.json").exit_code, 0);
  ASSERT_EQ(replay("far", "--scene scene/far.scene.json").exit_code, 0);
  for (const std::string name : {"frame_000000.left_context.png", "frame_000001.right_focus.png"}) {
    const std::string picture = content_of(root() / "o-near/near/frames" / name);
    EXPECT_FALSE(picture.empty());
    EXPECT_TRUE(picture == content_of(root() / "o-far/far/frames" / name)) << name;
  }
}

TEST_F(SynthProgram, RowsComeAtTheirRateButForHitches) {
  ASSERT_EQ(herr("synth s --duration 60 --pose-hz 90 --gaze-hz 200 --hitches-per-minute 30 --motion walking "
                 "--gaze-noise-deg 0")
                .exit_code,
            0);
  const auto poses = rows_of("s/pose/data.csv");
  int hitches = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double gap_ms = (poses[i][0] - poses[i - 1][0]) * 1e-6;
    const double moved_m = std::hypot(poses[i][1] - poses[i - 1][1], poses[i][2] - poses[i - 1][2],
                                      poses[i][3] - poses[i - 1][3]);
    EXPECT_LT(moved_m / (gap_ms * 1e-3), 1.5) << "walkers do not teleport, not even in a hitch";
    if (gap_ms < 11.2) continue;
    ++hitches;
    // 40-350 ms without rows at 11.1 ms.
    EXPECT_GT(gap_ms, 40 - 0.001);
    EXPECT_LT(gap_ms, 350 + 11.2);
  }
  EXPECT_GT(hitches, 15);
  for (const auto& row : rows_of("s/gaze/data.csv")) {
    ASSERT_EQ(row.size(), 10u);
    const bool valid = row[4] == 1;
    EXPECT_EQ(row[8], row[4]);
    // Lids half closed: no pupil. A direction is unit to its seven digits, or 0 where there is none.
    EXPECT_EQ(valid, row[9] >= 0.5) << row[9];
    EXPECT_NEAR(std::hypot(row[1], row[2], row[3]), valid ? 1 : 0, 2e-7);
  }
}

TEST_F(SynthProgram, RefusesWhatReplayWouldRefuseBeforeItWrites) {
  fs::create_directories(root() / "full/below");
  const std::vector<std::pair<std::string, std::string>> lines{
      {"s --replay-scene nowhere.json", "--replay-scene: there is no file s/nowhere.json"},
      {"s --motion walking --at 30,1,0 --scene scene/small.scene.json", "--at: leaves no half metre"},
      {"full", "is not empty; give --overwrite"},
      {"full --overwrite", "only a session is overwritten"},
      {"..", "OUT: is no name of a folder"}};
  for (const auto& [line, message] : lines) {
    const Outcome got = herr("synth " + line);
    EXPECT_EQ(got.exit_code, 2) << line << "\n" << got.err;
    EXPECT_NE(got.err.find(message), std::string::npos) << got.err;
    EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
  }
  EXPECT_EQ(herr("synth s --scene nowhere.json").exit_code, 3);
  write_text(root() / "scene/bad.scene.json", "{]");
  EXPECT_EQ(herr("synth s --replay-scene ../scene/bad.scene.json").exit_code, 3);
  EXPECT_EQ(made(), std::vector<std::string>{"full"});
}

TEST_F(SynthProgram, ReplacesASessionOnlyAsAWhole) {
  ASSERT_EQ(herr("synth s --duration 1").exit_code, 0);
  const std::string before = bytes_of("s");
  EXPECT_EQ(herr("synth s --duration 2").exit_code, 2);
  // Files of 4 blocks of 512 or 1024 bytes; a second of poses has more than 5000 bytes.
  const Outcome full = herr("synth s --duration 2 --overwrite", "ulimit -f 4;");
  EXPECT_EQ(full.exit_code, 75) << full.err;
  EXPECT_TRUE(bytes_of("s") == before);
  ASSERT_EQ(herr("synth s --duration 2 --overwrite").exit_code, 0);
  EXPECT_FALSE(bytes_of("s") == before);
  EXPECT_EQ(made(), std::vector<std::string>{"s"});
}

TEST_F(SynthProgram, ASignalLeavesNothing) {
  ChildProgram child(root(),
                     {test::program_path(), "synth", "s", "--duration", "80000", "--pose-hz", "1000"});
  // It writes: so its handler of the signal is in place.
  while (child.runs() && made().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  child.send(SIGTERM);
  EXPECT_EQ(child.finish(), 128 + SIGTERM);
  EXPECT_EQ(content_of(root() / "stderr.txt"), "herr: stopped: nothing was written\n");
  EXPECT_TRUE(made().empty());
}

TEST_F(SynthProgram, SaysWhatItMade) {
  const Outcome got = herr("synth s --duration 10 --json --motion turning --gaze reading");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  const auto report = nlohmann::json::parse(got.out);
  EXPECT_EQ(report["poses"]["rows"], 901);  // 0 ... 10 s at 90 Hz
  EXPECT_EQ(report["poses"]["kind"], "turning");
  EXPECT_EQ(report["gaze"]["rows"], 1201);
  EXPECT_EQ(report["gaze"]["kind"], "reading");
  EXPECT_FALSE(report.contains("camera"));
}

}  // namespace
}  // namespace herr
