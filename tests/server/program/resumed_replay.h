// A small session, what is left of a replay of it that nothing interrupted, and replays in processes of their
// own to hold against it. Before: small_session.h. After: tests of --resume.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "server/cli/command_line.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/replay/replay_command.h"
#include "tests/server/program/child_program.h"
#include "tests/server/program/program_runner.h"
#include "tests/server/small_session.h"
#include "tests/temporary_folder.h"

namespace herr {

namespace fs = std::filesystem;

inline constexpr int kFrames = 16;
inline const std::string kFlags =
    "replay walk --profile small.profile.json --preset direct --polar 32x32 --threads 1 --keep-going "
    "--frames 16 ";

inline std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::stringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// What main() does, for a process that is a copy of the test: some hundred replays in seconds.
inline int replay_with(const std::string& flags) {
  install_signal_handling();
  return run_guarded(
      [&] { return run_replay(std::get<ReplayOptions>(parse_command_line(words_of(flags)))); });
}

// Where the row of a frame begins in the text of frames.csv.
inline std::size_t row_begin(const std::string& csv, int frame) {
  std::size_t begin = 0;
  for (int i = 0; i <= frame; ++i) begin = csv.find('\n', begin) + 1;
  return begin;
}

// Columns of frames.csv that are not times of the machine, nor follow from them. motion_to_photon_ms holds
// the frame's time.
inline std::vector<std::string> reproducible_rows(const fs::path& csv) {
  std::vector<std::string> rows, names;
  std::ifstream file(csv);
  for (std::string line; std::getline(file, line);) {
    std::stringstream cells(line);
    std::string kept;
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (rows.empty()) names.push_back(cell);
      const std::string& name = names.at(column);
      const bool timed = name.ends_with("_ms") && name.find("_age_") == std::string::npos;
      const bool follows =
          name == "missed" || name == "stutter" || name == "preemptions" || name == "miss_cause";
      if (!timed && !follows) kept += cell + ',';
    }
    rows.push_back(kept);
  }
  return rows;
}

// Sessions, scene and profile are made once, and the replay that nothing interrupts.
class Resume : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    // Thousands of syncs: in memory, where there is such a place. A killed process does not notice.
    const fs::path memory = "/dev/shm";
    folder_ = ::access(memory.c_str(), W_OK) == 0 ? std::make_unique<TemporaryFolder>(memory)
                                                  : std::make_unique<TemporaryFolder>();
    make_inputs();
    const Outcome whole = run_program(root(), kFlags + "--out whole");
    ASSERT_EQ(whole.exit_code, 5) << whole.err;
    ASSERT_NE(content_of(root() / "whole/walk/summary.json").find("the frame before is held"),
              std::string::npos);
  }
  // In a process of its own, so that this one has started no threads when it is copied.
  static void make_inputs() {
    ChildProgram child(root(), [] {
      write_small_scene(root() / "scene");
      write_small_profile(root() / "small.profile.json");
      write_small_session(root() / "walk", 0.5);
      write_small_session(root() / "second", 0.2);
      return 0;
    });
    ASSERT_EQ(child.finish(), 0);
    walk_far();
    // Damaged behind a good header: from 0.2 s on the image before is held, and a resumed
    // replay must hold it too.
    const fs::path image = root() / "walk/cam0/data/000002.png";
    fs::resize_file(image, fs::file_size(image) - 20);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static const fs::path& root() { return folder_->path(); }

  // 120 m/s along x from -30 m: the anchor, which follows the head by 24 m, moves under way, and lies where
  // it would not lie for a head that appears there.
  static void walk_far() {
    std::string rows = "timestamp_ns,px,py,pz,qx,qy,qz,qw\n";
    for (int i = 0; i <= 45; ++i) {
      const double time_s = i / 90.0;
      rows += std::to_string(1'000'000'000 + static_cast<TimeNs>(time_s * 1e9)) + ',' +
              std::to_string(-30 + 120 * time_s) + ",1.0,0.0,0.0,0.0,0.0,1.0\n";
    }
    write_text(root() / "walk/pose/data.csv", rows);
  }

  static Outcome replay(const std::string& flags) {
    ChildProgram herr(root(), [&flags] { return replay_with(flags); });
    const int exit_code = herr.finish();
    return {exit_code, herr.out(), content_of(root() / "stderr.txt")};
  }
  static Outcome resume(const std::string& out, const std::string& more = "") {
    return replay(with_more(kFlags + "--out " + out + " --resume ", more));
  }
  static nlohmann::json summary(const std::string& out) {
    return nlohmann::json::parse(content_of(root() / out / "walk/summary.json"));
  }
  static long rows_in(const std::string& out) {
    return std::max(lines_in(content_of(root() / out / "walk/frames.csv")) - 1, 0L);
  }

  static void expect_as_uninterrupted(const std::string& out) {
    const auto files = files_below(root() / "whole/walk");
    EXPECT_EQ(files_below(root() / out / "walk"), files);
    for (const std::string& file : files) {
      if (!file.ends_with(".png") && !file.ends_with(".exr")) continue;
      EXPECT_TRUE(content_of(root() / out / "walk" / file) == content_of(root() / "whole/walk" / file))
          << file;
    }
    EXPECT_EQ(reproducible_rows(root() / out / "walk/frames.csv"),
              reproducible_rows(root() / "whole/walk/frames.csv"));
    const nlohmann::json whole = summary("whole"), resumed = summary(out);
    for (const char* part : {"state", "exit_code", "session", "settings", "counters", "plan", "warnings"}) {
      EXPECT_EQ(resumed[part], whole[part]) << part;
    }
    EXPECT_EQ(resumed["frames"]["rendered"], kFrames);
    EXPECT_EQ(resumed["latency"]["frame"]["count"], kFrames);
    EXPECT_EQ(resumed["output"]["picture_files"], whole["output"]["picture_files"]);
    EXPECT_EQ(resumed["output"]["picture_bytes"], whole["output"]["picture_bytes"]);
    EXPECT_EQ(resumed["output"]["contact_sheets"], whole["output"]["contact_sheets"]);
  }

  static void expect_rows_have_pictures(const std::string& out, long rows) {
    for (long i = 0; i < rows; ++i) {
      const std::string number = std::to_string(i);
      const std::string name = "frame_" + std::string(6 - number.size(), '0') + number + ".right_focus.png";
      EXPECT_TRUE(fs::exists(root() / out / "walk/frames" / name)) << name;
    }
  }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

}  // namespace herr
