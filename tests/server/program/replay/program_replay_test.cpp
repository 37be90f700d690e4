// The program as its users run it: files, exit codes, one line for each mistake.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/paths.h"
#include "tests/server/program/child_program.h"
#include "tests/server/program/replay/replay_program.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class Program : public ReplayProgram {
 protected:
  // Two frames of the large profile, whose pictures are 14.3 Mpx of 8 bytes.
  nlohmann::json large_summary(const std::string& out, const std::string& flags) const {
    const Outcome outcome =
        herr("replay walk --profile xr1 --polar 128x64 --contact-sheet none --frames 2 --out " + out + " " +
             flags);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("ms of CPU for each frame"), std::string::npos) << outcome.out;
    return summary(out);
  }
  std::vector<double> column(const std::string& out, const std::string& name) const {
    std::istringstream lines(content_of(root() / out / "walk" / "frames.csv"));
    std::vector<double> values;
    std::size_t at = std::string::npos;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream cells(line);
      std::size_t i = 0;
      for (std::string cell; std::getline(cells, cell, ','); ++i) {
        if (cell == name) at = i;
        if (i == at && cell != name) values.push_back(std::stod(cell));
      }
    }
    return values;
  }
};

TEST_F(Program, ReplayWritesPicturesTimesSheetCheckpointAndSummary) {
  const Outcome outcome = replay("--out o");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // 0.25 s at 60 Hz: the last pose lies at 22/90 s = 0.2444 s, so frames 0 ... 14 (14/60 = 0.2333 s).
  const auto files = files_below(root() / "o" / "walk");
  EXPECT_EQ(files.size(), 15u * 4 + 4);
  EXPECT_TRUE(fs::exists(root() / "o/walk/frames/frame_000014.right_focus.png"));
  EXPECT_TRUE(fs::exists(root() / "o/walk/contact_sheet_000007.png"));
  EXPECT_EQ(lines_in(content_of(root() / "o/walk/frames.csv")), 16);
  const auto json = summary("o");
  EXPECT_EQ(json["state"], "done");
  EXPECT_EQ(json["frames"]["rendered"], 15);
  EXPECT_EQ(json["latency"]["frame"]["count"], 15);
  EXPECT_EQ(json["counters"]["nonfinite_values"], 0);
  EXPECT_NE(outcome.out.find("first hits"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Program, PicturesAreTheSameBytesWithAnyNumberOfThreadsAndInEveryRun) {
  ASSERT_EQ(replay("--frames 4 --format png,exr --out a").exit_code, 0);
  const auto files = files_below(root() / "a" / "walk" / "frames");
  ASSERT_EQ(files.size(), 4u * (4 + 1)) << "a PNG of each viewport and an EXR of all";
  for (const std::string threads : {"1", "2", "4"}) {
    ASSERT_EQ(herr("replay walk --profile small.profile.json --preset direct --polar 128x64 --frames 4 "
                   "--overwrite --out b --format exr,png --threads " +
                   threads)
                  .exit_code,
              0);
    for (const std::string& file : files) {
      EXPECT_TRUE(content_of(root() / "a/walk/frames" / file) == content_of(root() / "b/walk/frames" / file))
          << file << " with " << threads << " threads";
    }
  }
}

TEST_F(Program, TheSameFrameOfAPartOfTheSessionIsTheSamePicture) {
  ASSERT_EQ(replay("--out whole --contact-sheet none").exit_code, 0);
  ASSERT_EQ(replay("--out part --start 0.1 --frames 2 --contact-sheet none").exit_code, 0);
  for (const std::string name : {"frame_000006.left_context.png", "frame_000007.right_focus.png"}) {
    const std::string part = content_of(root() / "part/walk/frames" / name);
    EXPECT_FALSE(part.empty());
    EXPECT_TRUE(part == content_of(root() / "whole/walk/frames" / name)) << name;
  }
}

TEST_F(Program, AFullOutputFolderIsRefusedUnlessItMayBeOverwritten) {
  ASSERT_EQ(replay("--frames 2 --out o").exit_code, 0);
  const Outcome refused = replay("--frames 1 --out o");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(lines_in(refused.err), 1);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos);
  EXPECT_EQ(replay("--frames 1 --out o --overwrite --contact-sheet none").exit_code, 0);
  EXPECT_EQ(files_below(root() / "o/walk/frames").size(), 4u);
}

TEST_F(Program, BadInputEndsWithThreeAndWritesNothing) {
  write_text(root() / "walk/pose/data.csv",
             "timestamp_ns,px,py,pz,qx,qy,qz,qw\n1000000000,0,1,nan,0,0,0,1\n");
  const Outcome outcome = replay("--out o");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(lines_in(outcome.err), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("data.csv:2"), std::string::npos) << outcome.err;
  EXPECT_TRUE(files_below(root() / "o").empty());
  EXPECT_EQ(herr("replay nowhere --out o").exit_code, 3);
}

TEST_F(Program, ADiskThatRefusesEndsWithSeventyFiveAndLeavesNoHalfFiles) {
  // ulimit counts blocks of 512 bytes in dash and of 1024 in bash: 8 to 16 kB, less than one EXR of
  // 4 x 48 x 40 x 8 B = 61 kB of noise, more than any temporary file's first block.
  const Outcome outcome = replay("--format exr --out o --contact-sheet none --frames 3", "ulimit -f 4;");
  EXPECT_EQ(outcome.exit_code, 75) << outcome.err;
  EXPECT_EQ(lines_in(outcome.err), 1) << outcome.err;
  for (const std::string& file : files_below(root() / "o"))
    EXPECT_EQ(file.find(".tmp."), std::string::npos) << file;
  EXPECT_TRUE(files_below(root() / "o/walk/frames").empty());
}

// 16 or 32 kB: room for each PNG of 48 x 40 noisy pixels, none for the EXR.
TEST_F(Program, ADiskThatRefusesOneFormatLeavesNoRowOfTheFrame) {
  const Outcome outcome = replay("--format png,exr --out o --contact-sheet none --frames 3", "ulimit -f 32;");
  EXPECT_EQ(outcome.exit_code, 75) << outcome.err;
  EXPECT_NE(outcome.err.find("frame_000000.exr"), std::string::npos) << outcome.err;
  EXPECT_EQ(lines_in(content_of(root() / "o/walk/frames.csv")), 1) << "the header alone";
  EXPECT_EQ(files_below(root() / "o/walk/frames").size(), 4u) << "whole PNG files of frame 0";
}

TEST_F(Program, ASignalEndsTheRunAfterTheFrameAndTheSummarySaysSo) {
  write_small_session(root() / "long", 20);
  const auto rows = [&] { return lines_in(content_of(root() / "o/long/frames.csv")) - 1; };
  ChildProgram child(root(), {test::program_path(), "replay", "long", "--profile", "small.profile.json",
                              "--preset", "direct", "--out", "o", "--format", "none"});
  while (child.runs() && rows() < 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  child.send(SIGINT);
  EXPECT_EQ(child.finish(), 130);
  const auto json = nlohmann::json::parse(content_of(root() / "o/long/summary.json"));
  EXPECT_EQ(json["state"], "interrupted");
  EXPECT_EQ(json["exit_code"], 130);
  EXPECT_EQ(rows(), json["frames"]["rendered"].get<long>());
}

TEST_F(Program, UsageErrorsAreOneLineAndExitCodeTwo) {
  for (const std::string flags : {"", "replay", "replay walk --frames nan", "replay walk --sceen x",
                                  "rplay walk", "replay walk --policy best", "replay walk walk --out o",
                                  "replay walk --start 99", "synth walk --scene scene/small.scene.json"}) {
    const Outcome outcome = herr(flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_EQ(lines_in(outcome.err), 1) << flags << ": " << outcome.err;
    EXPECT_EQ(outcome.err.find("herr: "), 0u) << flags;
    EXPECT_EQ(outcome.out, "") << flags;
  }
}

// The columns of frames.csv with these names, row by row.
std::vector<std::vector<double>> columns_of(const fs::path& csv, const std::vector<std::string>& names) {
  std::ifstream file(csv);
  std::vector<std::size_t> places;
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (places.empty()) {
      for (const std::string& name : names) {
        places.push_back(
            static_cast<std::size_t>(std::find(cells.begin(), cells.end(), name) - cells.begin()));
      }
      continue;
    }
    rows.emplace_back();
    for (const std::size_t place : places) rows.back().push_back(std::stod(cells.at(place)));
  }
  return rows;
}

const std::vector<std::string> kAcuityColumns{"theta_max_left_deg",
                                              "k_radial_left_per_deg",
                                              "k_angular_left_per_deg",
                                              "k_angular_at_left_deg",
                                              "k_radial_right_per_deg",
                                              "k_angular_right_per_deg",
                                              "polar_width"};

// 64 columns an eye over ln(theta_max + 1), and of 64 rows the least of (theta + 1) / sin(theta).
TEST_F(Program, FramesTellTheAcuityThatTheyReach) {
  ASSERT_EQ(replay("--frames 3 --format none --contact-sheet none --out o").exit_code, 0);
  const auto rows = columns_of(root() / "o/walk/frames.csv", kAcuityColumns);
  ASSERT_EQ(rows.size(), 3u);
  double least = 1e300;
  for (double theta = 0.01; theta < 54; theta += 0.01) {
    least = std::min(least, 64 * (theta + 1) / (360 * std::sin(theta * std::acos(-1.0) / 180)));
  }
  for (const auto& row : rows) {
    EXPECT_NEAR(row[0], 54.7356, 1e-4) << "the corner of 45 x 45 degrees, seen from the middle";
    EXPECT_NEAR(row[1], 64 / std::log(row[0] + 1), 2e-6);
    EXPECT_NEAR(row[2], least, 1e-4);
    EXPECT_NEAR(row[3], 21.042, 1e-3);
    EXPECT_EQ(row[4], row[1]);
    EXPECT_EQ(row[5], row[2]);
    EXPECT_EQ(row[6], 64);
  }
  const auto quality = summary("o")["quality"];
  EXPECT_NEAR(quality["k_radial"]["min"].get<double>(), rows[0][1], 2e-6);
  EXPECT_NEAR(quality["k_angular"]["p50"].get<double>(), rows[0][2], 0.005 * rows[0][2]);
  EXPECT_EQ(quality["k_radial"]["count"], 3);
  EXPECT_NE(summary("o")["definitions"]["k_angular"].get<std::string>().find("theta + 1"), std::string::npos);
}

TEST_F(Program, PolarAcuityReachesTheAcuityFunctionAndSaysSo) {
  const std::string acuity = "replay walk --profile small.profile.json --polar acuity --frames 2 ";
  const Outcome outcome = herr(acuity + "--out o");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("polar acuity"), std::string::npos) << outcome.out;
  // 200 ln(55.7356) = 804.06: 805 columns, 200.23.
  EXPECT_NE(outcome.out.find("acuity: k radial 200.2 at least, 200.2 median; k angular 200.2 at least"),
            std::string::npos)
      << outcome.out;
  for (const auto& row : columns_of(root() / "o/walk/frames.csv", kAcuityColumns)) {
    for (const std::size_t k : {1, 2, 4, 5}) {
      EXPECT_GE(row[k], 200);
      EXPECT_LT(row[k], 200.3);
    }
    EXPECT_EQ(row[6], 805);
  }
  const auto settings = summary("o")["settings"];
  EXPECT_EQ(settings["polar"], "acuity");
  EXPECT_EQ(settings["polar_width_per_eye"], 1040) << "at most";
  EXPECT_EQ(settings["polar_height"], 1174);
  // The same pictures as of a buffer of that size.
  ASSERT_EQ(
      herr("replay walk --profile small.profile.json --polar 1610x1174 --frames 2 --out sized").exit_code, 0);
  for (const std::string& file : files_below(root() / "o/walk/frames")) {
    EXPECT_TRUE(content_of(root() / "o/walk/frames" / file) ==
                content_of(root() / "sized/walk/frames" / file))
        << file;
  }
  // Another size is another picture: a run does not go on with it.
  EXPECT_EQ(herr("replay walk --profile small.profile.json --polar 1610x1174 --frames 2 --out o --resume")
                .exit_code,
            2);
  EXPECT_EQ(herr(acuity + "--out o --resume").exit_code, 0);
  const Outcome wrong = herr("replay walk --polar accuity --out x");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("or acuity"), std::string::npos) << wrong.err;
}

TEST_F(Program, ALostReaderIsNoErrorAndAFullStdoutIsOne) {
  EXPECT_EQ(herr("--help").exit_code, 0);
  EXPECT_EQ(herr("--version").out.find("herr "), 0u);
  const std::string program = test::program_path();
  EXPECT_EQ(std::system((program + " --help >/dev/full 2>/dev/null").c_str()), 75 << 8);
  // The pipe's reader is gone before the program starts to write.
  EXPECT_EQ(std::system(("bash -c 'set -o pipefail; (sleep 0.2; " + program + " --help) | true'").c_str()),
            0);
}

TEST_F(Program, SynthMakesASessionThatReplaysAndIsTheSameForTheSameSeed) {
  const std::string flags =
      " --scene scene/small.scene.json --replay-scene ../scene/small.scene.json --seed 3 "
      "--duration 0.3 --camera-size 32x24";
  ASSERT_EQ(herr("synth made" + flags).exit_code, 0);
  fs::rename(root() / "made", root() / "before");
  ASSERT_EQ(herr("synth made" + flags).exit_code, 0);
  const auto files = files_below(root() / "made");
  // session.json, three data.csv, camera frames at 0, 0.1, 0.2 and 0.3 s.
  EXPECT_EQ(files.size(), 8u);
  for (const std::string& file : files) {
    EXPECT_TRUE(content_of(root() / "made" / file) == content_of(root() / "before" / file)) << file;
  }
  const Outcome outcome =
      herr("replay made --profile small.profile.json --preset direct --polar 128x64 --frames 3 --out o");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(Program, PartsOfMemoryAreMostOfWhatIsResidentAndNoMore) {
  const nlohmann::json json = large_summary("o", "--format png --threads 1");
  const auto& parts = json["memory_bytes"];
  const double together = parts["together"], resident = json["load"]["peak_resident_bytes"];
  // Two contexts of 1980 x 1980 and two focus pictures of 2400 x 1350, rows padded to vectors; half floats.
  EXPECT_GE(parts["frame pictures"].get<double>(), 8.0 * 2 * (1980 * 1980 + 2400 * 1350));
  EXPECT_LE(parts["frame pictures"].get<double>(), 8.0 * 2 * (2048 * 1980 + 2432 * 1350));
  // The camera image of 64 x 48, half floats: one, though both eyes see it.
  EXPECT_EQ(parts["camera pictures"], 64 * 48 * 8);
  // 8-bit RGB of each picture at least.
  EXPECT_GE(parts["encoder buffers"].get<double>(), 3.0 * 2 * (1980 * 1980 + 2400 * 1350));
  EXPECT_LE(together, resident);
  // The program and its libraries take some 60 MB beside 160 MB and more of pictures.
  EXPECT_GE(together, 0.6 * resident);
}

TEST_F(Program, ALargerSceneGrowsItsPartByItsBytes) {
  const auto loaded = [&](const std::string& out) {
    return large_summary(out, "--format none --threads 1")["memory_bytes"]["loaded environment"]
        .get<std::int64_t>();
  };
  EXPECT_EQ(loaded("plain"), 0);
  // Radiance without runs: four bytes a pixel in the file, four floats in memory.
  std::string picture = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 128 +X 256\n";
  for (int i = 0; i < 128 * 256; ++i) picture += std::string("\x40\x40\x40\x80", 4);
  write_text(root() / "scene/sky.hdr", picture);
  std::string scene = content_of(root() / "scene/small.scene.json");
  scene.insert(scene.rfind('}'), ", \"environment_map\": {\"file\": \"sky.hdr\"}");
  write_text(root() / "scene/small.scene.json", scene);
  EXPECT_EQ(loaded("sky"), 128 * 256 * 16);
}

TEST_F(Program, CpuTimeOfAFrameIsNoMoreThanItsTimeOnEveryCore) {
  const nlohmann::json json = large_summary("o", "--format png --threads 2");
  const std::vector<double> cpu_ms = column("o", "cpu_ms"), frame_ms = column("o", "frame_ms");
  ASSERT_EQ(cpu_ms.size(), 2u);
  ASSERT_EQ(frame_ms.size(), 2u);
  const int cores = json["load"]["cores"];
  double cpu_sum = 0, frame_sum = 0;
  for (std::size_t i = 0; i < cpu_ms.size(); ++i) {
    EXPECT_GT(cpu_ms[i], 0);
    // Read within the frame time: beyond the cores' time lies only what the kernel books late, a tick of 4
    // ms.
    EXPECT_LE(cpu_ms[i], frame_ms[i] * cores + 4.0 * cores);
    cpu_sum += cpu_ms[i], frame_sum += frame_ms[i];
  }
  const auto& load = json["load"];
  EXPECT_NEAR(load["cpu"]["mean"].get<double>(), cpu_sum / 2, 1e-3);
  EXPECT_NEAR(load["cpu_share"].get<double>(), cpu_sum / (frame_sum * cores), 1e-4);
}

}  // namespace
}  // namespace herr
