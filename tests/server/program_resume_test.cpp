// `herr replay --resume`: a replay that was interrupted at any instant ends like one that was not.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "child_program.h"
#include "program_runner.h"
#include "small_session.h"
#include "temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 24;
const std::string kFlags =
    "walk --profile small.profile.json --polar 32x32 --threads 1 --keep-going --frames 24";

// Columns of frames.csv that are not times of the machine. motion_to_photon_ms holds the frame's time.
std::vector<std::string> reproducible_rows(const fs::path& csv) {
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
      if (!timed && name != "missed") kept += cell + ',';
    }
    rows.push_back(kept);
  }
  return rows;
}

// Sessions, scene and profile are made once, and the replay that nothing interrupts.
class Resume : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    write_small_scene(root() / "scene");
    write_small_profile(root() / "small.profile.json");
    write_small_session(root() / "walk", 0.5);
    walk_far();
    // Damaged behind a good header: from 0.2 s on the image before is held, and a resumed replay must hold
    // it too.
    const fs::path image = root() / "walk/cam0/data/000002.png";
    fs::resize_file(image, fs::file_size(image) - 20);
    const Outcome whole = run_program(root(), "replay " + kFlags + " --out whole");
    ASSERT_EQ(whole.exit_code, 5) << whole.err;
    ASSERT_NE(content_of(root() / "whole/walk/summary.json").find("the frame before is held"),
              std::string::npos);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static const fs::path& root() { return folder_->path(); }

  // 60 m/s along x from -30 m: the anchor, which follows the head by 24 m, moves under way, and lies where it
  // would not lie for a head that appears there.
  static void walk_far() {
    std::string rows = "timestamp_ns,px,py,pz,qx,qy,qz,qw\n";
    for (int i = 0; i <= 45; ++i) {
      const double time_s = i / 90.0;
      rows += std::to_string(1'000'000'000 + static_cast<TimeNs>(time_s * 1e9)) + ',' +
              std::to_string(-30 + 60 * time_s) + ",1.0,0.0,0.0,0.0,0.0,1.0\n";
    }
    write_text(root() / "walk/pose/data.csv", rows);
  }

  static Outcome resume(const std::string& out, const std::string& more = "") {
    return run_program(root(), "replay " + kFlags + " --out " + out + " --resume " + more);
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

  // Starts or goes on, and sends `signal` some random time after a random row of frames.csv, or after a
  // random time of the start.
  void interrupt(const std::string& out, int signal) {
    const long rows = engine_() % 4 == 0 ? -1 : static_cast<long>(engine_() % kFrames);
    const auto more = std::chrono::microseconds(engine_() % (rows < 0 ? 60'000 : 4'000));
    std::vector<std::string> words{HERR_PROGRAM, "replay", "--out", out, "--resume"};
    std::stringstream flags(kFlags);
    for (std::string word; flags >> word;) words.push_back(word);
    ChildProgram herr(root(), words);
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
  static void expect_rows_have_pictures(const std::string& out, long rows) {
    for (long i = 0; i < rows; ++i) {
      const std::string number = std::to_string(i);
      const fs::path picture = root() / out / "walk/frames" /
                               ("frame_" + std::string(6 - number.size(), '0') + number + ".right_focus.png");
      EXPECT_TRUE(fs::exists(picture)) << picture;
    }
  }

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
  static inline std::unique_ptr<TemporaryFolder> folder_;
  std::mt19937 engine_;
  int interrupted_in_the_middle_ = 0;
};

TEST_F(Resume, AfterSigtermAtAnyInstantAllIsAsIfNothingHadHappened) {
  interrupt_often(20, SIGTERM);
}

TEST_F(Resume, AfterSigkillAtAnyInstantAllIsAsIfNothingHadHappened) {
  interrupt_often(10, SIGKILL);
}

TEST_F(Resume, OfNothingIsAFreshRunAndOfAFinishedOneNothing) {
  ASSERT_EQ(resume("fresh").exit_code, 5);
  expect_as_uninterrupted("fresh");
  const std::string before = content_of(root() / "fresh/walk/summary.json");
  const fs::path picture = root() / "fresh/walk/frames/frame_000000.left_context.png";
  const auto written = fs::last_write_time(picture);
  const Outcome again = resume("fresh");
  EXPECT_EQ(again.exit_code, 5);  // images were skipped: the result is as partial as before
  EXPECT_NE(again.err.find("walk: nothing to do, all 24 frames are there"), std::string::npos) << again.err;
  EXPECT_EQ(content_of(root() / "fresh/walk/summary.json"), before);
  EXPECT_EQ(fs::last_write_time(picture), written);
}

// A copy of the finished run whose frames.csv keeps its first `rows` rows.
void copy_with_rows(const fs::path& from, const fs::path& to, int rows) {
  fs::copy(from, to, fs::copy_options::recursive);
  std::ifstream csv(from / "frames.csv");
  std::string text, line;
  for (int i = 0; i <= rows && std::getline(csv, line); ++i) text += line + "\n";
  write_text(to / "frames.csv", text);
}

TEST_F(Resume, ARowWhosePictureIsGoneIsNotTrusted) {
  fs::create_directories(root() / "gone");
  copy_with_rows(root() / "whole/walk", root() / "gone/walk", kFrames);
  fs::remove(root() / "gone/walk/frames/frame_000009.left_focus.png");
  const Outcome outcome = resume("gone");
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("frame_000009.left_focus.png: is missing; frames from 9 on"), std::string::npos)
      << outcome.err;
  expect_as_uninterrupted("gone");
  EXPECT_EQ(summary("gone")["frames"]["kept"], 9);
}

TEST_F(Resume, APictureWithoutItsRowIsRenderedAgain) {
  fs::create_directories(root() / "rowless");
  copy_with_rows(root() / "whole/walk", root() / "rowless/walk", 13);
  write_text(root() / "rowless/walk/frames/frame_000013.left_focus.png", "not a picture");
  EXPECT_EQ(resume("rowless").exit_code, 5);
  expect_as_uninterrupted("rowless");
  EXPECT_EQ(summary("rowless")["frames"]["kept"], 13);
}

TEST_F(Resume, FramesCsvCutOffOrGarbledKeepsTheRowsBefore) {
  const std::string text = content_of(root() / "whole/walk/frames.csv");
  std::size_t tenth = 0;  // the start of the row of frame 9
  for (int i = 0; i < 10; ++i) tenth = text.find('\n', tenth) + 1;
  const struct {
    std::string name, text, message;
    int kept;
  } cases[] = {
      {"empty", "", "", 0},
      {"header_cut", text.substr(0, 20), "", 0},
      {"row_cut", text.substr(0, tenth + 17), "", 9},
      {"end_cut", text.substr(0, text.size() - 1), "", kFrames - 1},
      {"garbled", text.substr(0, tenth) + "x" + text.substr(tenth),
       "frames.csv:11: is not the row of frame 9", 9},
      {"doubled", text.substr(0, tenth) + text.substr(text.find('\n') + 1),
       "frames.csv:11: is not the row of frame 9", 9},
      {"foreign", "a,b\n1,2\n", "frames.csv:1: is not the header", 0},
  };
  for (const auto& [name, changed, message, kept] : cases) {
    fs::create_directories(root() / name);
    copy_with_rows(root() / "whole/walk", root() / name / "walk", 0);
    write_text(root() / name / "walk/frames.csv", changed);
    const Outcome outcome = resume(name);
    EXPECT_EQ(outcome.exit_code, 5) << name << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << name << outcome.err;
    EXPECT_EQ(summary(name)["frames"]["kept"], kept) << name;
    expect_as_uninterrupted(name);
  }
}

TEST_F(Resume, WithOtherSettingsOrInputsIsRefusedAndNamesWhatDiffers) {
  fs::create_directories(root() / "other");
  copy_with_rows(root() / "whole/walk", root() / "other/walk", 5);
  const auto before = files_below(root() / "other");
  const auto refused = [&](const std::string& flags, const std::string& part) {
    const Outcome outcome = resume("other", flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags << outcome.err;
    EXPECT_EQ(lines_in(outcome.err), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--overwrite"), std::string::npos) << outcome.err;
    EXPECT_EQ(files_below(root() / "other"), before);
  };
  refused("--light-samples 4", ": --light-samples was 1, is 4; ");
  refused("--polar 32x34", "--polar was 32x32, is 32x34");
  refused("--no-camera", "--no-camera was not given, is given");
  refused("--format exr", "--format was png, is exr");
  refused("--frames 23", "--start, --duration, --frames was frames 0 ... 23, is frames 0 ... 22");
  refused("--profile xr1", "--profile was small, is xr1");
  refused("--contact-sheet all", "--contact-sheet was middle, is all");
  const auto changed = [&](const fs::path& file, const std::string& text, const std::string& part) {
    const std::string kept = content_of(file);
    write_text(file, text);
    refused("", part);
    write_text(file, kept);
  };
  const fs::path gaze = root() / "walk/gaze/data.csv";
  std::string other_gaze = content_of(gaze);
  other_gaze.insert(other_gaze.find('\n'), 1, '\r');
  changed(gaze, other_gaze, "gaze/data.csv has changed");
  changed(root() / "scene/triangle.gltf", content_of(root() / "scene/triangle.gltf") + " ",
          "triangle.gltf has changed");
  const fs::path image = root() / "walk/cam0/data/000001.png";
  const auto written = fs::last_write_time(image);
  fs::last_write_time(image, written + std::chrono::seconds(1));
  refused("", "cam0/data has changed");
  fs::last_write_time(image, written);
  EXPECT_EQ(resume("other").exit_code, 5);
  expect_as_uninterrupted("other");
}

TEST_F(Resume, ADamagedCheckpointIsBadInputAndNothingIsTouched) {
  fs::create_directories(root() / "damaged");
  copy_with_rows(root() / "whole/walk", root() / "damaged/walk", 5);
  write_text(root() / "damaged/walk/checkpoint.json", "{\"format_version\": 1,");
  const Outcome outcome = resume("damaged");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(lines_in(outcome.err), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("checkpoint.json: is damaged"), std::string::npos) << outcome.err;
  EXPECT_EQ(rows_in("damaged"), 5);
  fs::remove(root() / "damaged/walk/checkpoint.json");
  EXPECT_EQ(resume("damaged").exit_code, 2);
}

TEST_F(Resume, AFullDiskInTheMiddleIsGoneOnFromWhenThereIsRoom) {
  // Blocks of 512 bytes in dash, of 1024 in bash: between 6 and 12 kB, so that the contact sheet of the
  // middle frame fails and the pictures before it do not.
  const std::string flags = "replay " + kFlags + " --out full ";
  const Outcome full = run_program(root(), flags, "ulimit -f 12;");
  ASSERT_EQ(full.exit_code, 75) << full.err;
  EXPECT_EQ(lines_in(full.err), 1) << full.err;
  const long rows = rows_in("full");
  EXPECT_GT(rows, 0);
  EXPECT_LT(rows, kFrames);
  expect_rows_have_pictures("full", rows);
  const Outcome refused = run_program(root(), flags);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--resume"), std::string::npos) << refused.err;
  EXPECT_EQ(resume("full").exit_code, 5);
  expect_as_uninterrupted("full");
}

TEST_F(Resume, SessionsThatAreFinishedArePassedOver) {
  write_small_session(root() / "second", 0.2);
  const std::string flags =
      "replay walk second --profile small.profile.json --polar 32x32 --keep-going --out two";
  ASSERT_EQ(run_program(root(), flags).exit_code, 5);
  const std::string picture = content_of(root() / "two/second/frames/frame_000007.left_focus.png");
  fs::remove(root() / "two/second/frames/frame_000007.left_focus.png");
  const Outcome outcome = run_program(root(), flags + " --resume --json");
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("walk: nothing to do"), std::string::npos) << outcome.err;
  EXPECT_TRUE(content_of(root() / "two/second/frames/frame_000007.left_focus.png") == picture);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["sessions"][1]["frames"]["kept"], 7);
  // 0.5 s end at the pose at 45/90 s, frame 30; 0.2 s at 18/90 s, frame 12.
  EXPECT_EQ(json["total"]["frames"]["rendered"], 31 + 13);
}

TEST_F(Resume, WithoutPicturesRowsDecide) {
  const std::string flags = "replay " + kFlags + " --format none --contact-sheet none --out none ";
  ASSERT_EQ(run_program(root(), flags).exit_code, 5);
  const std::string text = content_of(root() / "none/walk/frames.csv");
  std::size_t sixth = 0;
  for (int i = 0; i < 6; ++i) sixth = text.find('\n', sixth) + 1;
  write_text(root() / "none/walk/frames.csv", text.substr(0, sixth));
  ASSERT_EQ(run_program(root(), flags + "--resume").exit_code, 5);
  EXPECT_EQ(summary("none")["frames"]["kept"], 5);
  EXPECT_EQ(reproducible_rows(root() / "none/walk/frames.csv"),
            reproducible_rows(root() / "whole/walk/frames.csv"));
}

TEST_F(Resume, ASignalInTheMiddleOfALongFrameEndsItWithoutAPicture) {
  // 4096 shadow rays for each of some hundred thousand samples: minutes.
  std::vector<std::string> words{HERR_PROGRAM,      "replay",   "--out",     "long",
                                 "--light-samples", "4096",     "--profile", "small.profile.json",
                                 "--polar",         "1576x768", "walk"};
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

}  // namespace
}  // namespace herr
