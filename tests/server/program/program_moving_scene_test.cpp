// Replay, check and bench count the same in the same frames of a scene that moves.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/missing_tool.h"
#include "tests/paths.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCounters[] = {"commits",           "instances_moved",    "instances_spawned",
                                     "instances_removed", "instances_restyled", "primary_rays"};

class ProgramMovingScene : public ::testing::Test {
 protected:
  // Six frames, a third of a second apart: t = 1.2 ... 1.6 s brings both hares of the sample scene.
  void SetUp() override {
    const fs::path scene = fs::path(test::source_dir()) / "scenes/samples/moving.scene.json";
    if (!fs::exists(scene.parent_path() / "generated/teapot.glb")) {
      HERR_MISSING_TOOL("scenes/samples/generated is missing; an ordinary build makes it");
    }
    write_small_profile(root() / "slow.json");
    std::string profile = content_of(root() / "slow.json");
    profile.replace(profile.find("60"), 2, "3");
    write_text(root() / "slow.json", profile);
    write_small_session(root() / "walk", 2.0);
    arguments_ =
        " walk --profile slow.json --polar 64x32 --threads 1 --isa sse4 --scene " + scene.string() + " ";
    const Outcome run =
        run_program(root(), "replay" + arguments_ + "--format none --contact-sheet none --out o");
    ASSERT_EQ(run.exit_code, 0) << run.err;
    read_rows();
    ASSERT_EQ(frames(), 6u);  // at 0, 1/3, ... 5/3 s
  }
  const fs::path& root() const { return folder_.path(); }
  std::size_t frames() const { return rows_.size() - 1; }

  void read_rows() {
    std::istringstream file(content_of(root() / "o/walk/frames.csv"));
    for (std::string line; std::getline(file, line);) {
      rows_.emplace_back();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');) rows_.back().push_back(cell);
    }
  }

  // What replay counted per frame, on average over the frames from `first` on.
  double replayed(const std::string& name, std::size_t first) const {
    const auto column =
        static_cast<std::size_t>(std::find(rows_[0].begin(), rows_[0].end(), name) - rows_[0].begin());
    double sum = 0;
    for (std::size_t i = first; i < frames(); ++i) sum += std::stod(rows_[1 + i].at(column));
    return sum / static_cast<double>(frames() - first);
  }

  std::string arguments_;

 private:
  TemporaryFolder folder_;
  std::vector<std::vector<std::string>> rows_;  // header first
};

TEST_F(ProgramMovingScene, CheckCountsWhatReplayCounts) {
  const Outcome run = run_program(
      root(), "check" + arguments_ + "--frames 6 --only counters --json --against " + test::program_path());
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  const auto json = nlohmann::json::parse(run.out);
  const std::size_t warm_up = 3;  // of six
  EXPECT_GT(replayed("instances_moved", warm_up), 1);
  EXPECT_EQ(replayed("instances_spawned", warm_up), 2.0 / 3);
  for (const char* name : kCounters) {
    const std::string counted = name == std::string("primary_rays") ? "rays.primary" : name;
    bool found = false;
    for (const auto& counter : json["counters"]) {
      if (counter["name"] != counted) continue;
      found = true;
      EXPECT_DOUBLE_EQ(counter["candidate"].get<double>(), replayed(name, warm_up)) << name;
    }
    EXPECT_TRUE(found) << name;
  }
}

TEST_F(ProgramMovingScene, BenchCountsWhatReplayCountsHoweverOftenItRepeats) {
  for (const char* repeats : {"1", "3"}) {
    const Outcome run = run_program(root(), "bench" + arguments_ + "--frames 6 --json --repeats " + repeats);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["frames"], 6);
    for (const char* name : kCounters) {
      if (name == std::string("primary_rays")) continue;
      EXPECT_DOUBLE_EQ(json["counters"][name].get<double>(), replayed(name, 0)) << name;
    }
  }
}

TEST_F(ProgramMovingScene, BenchTellsPeopleToo) {
  const Outcome run = run_program(root(), "bench" + arguments_ + "--frames 6 --repeats 1");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name : {"commits", "instances moved", "instances spawned"}) {
    EXPECT_NE(run.out.find(name), std::string::npos) << run.out;
  }
}

TEST_F(ProgramMovingScene, BenchWeighsAndAveragesItToo) {
  const Outcome left_out = run_program(root(), "bench" + arguments_ + "--left-out --frames 3 --repeats 1");
  EXPECT_EQ(left_out.exit_code, 0) << left_out.err;
  const Outcome table =
      run_program(root(), "bench" + arguments_ + "--table --preset direct --seconds 0.001 --frames 2 --json");
  ASSERT_EQ(table.exit_code, 0) << table.err;
  // Whole sequences alone.
  for (const auto& cell : nlohmann::json::parse(table.out)["table"]) EXPECT_EQ(cell["frames"], 2);
}

}  // namespace
}  // namespace herr
