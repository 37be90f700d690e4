// `herr replay --resume`: a replay that was interrupted at any instant ends like one that was not.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "child_program.h"
#include "program_runner.h"
#include "server/cli/command_line.h"
#include "server/cli/exit_code.h"
#include "server/cli/stop_signal.h"
#include "server/replay/replay_command.h"
#include "small_session.h"
#include "temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 16;
const std::string kFlags =
    "replay walk --profile small.profile.json --polar 32x32 --threads 1 --keep-going --frames 16 ";

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::stringstream stream(line);
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// What main() does, for a process that is a copy of the test: some hundred replays in seconds.
int replay_with(const std::string& flags) {
  install_signal_handling();
  return run_guarded(
      [&] { return run_replay(std::get<ReplayOptions>(parse_command_line(words_of(flags)))); });
}

// Where the row of a frame begins in the text of frames.csv.
std::size_t row_begin(const std::string& csv, int frame) {
  std::size_t begin = 0;
  for (int i = 0; i <= frame; ++i) begin = csv.find('\n', begin) + 1;
  return begin;
}

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
    // Thousands of syncs: in memory, where there is such a place. A killed process does not notice.
    const fs::path memory = "/dev/shm";
    folder_ = ::access(memory.c_str(), W_OK) == 0 ? std::make_unique<TemporaryFolder>(memory)
                                                  : std::make_unique<TemporaryFolder>();
    make_inputs();
    const Outcome whole = run_program(root(), kFlags + "--out whole");
    ASSERT_EQ(whole.exit_code, 5) << whole.err;
    ASSERT_NE(content_of(root() / "whole/walk/summary.json").find("the frame before is held"),
              std::string::npos);
    ASSERT_EQ(run_program(root(), kFlags + "--format exr --out whole_exr").exit_code, 5);
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
    // Damaged behind a good header: from 0.2 s on the image before is held, and a resumed replay must hold
    // it too.
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
    return replay(kFlags + "--out " + out + " --resume " + more);
  }
  static nlohmann::json summary(const std::string& out) {
    return nlohmann::json::parse(content_of(root() / out / "walk/summary.json"));
  }
  static long rows_in(const std::string& out) {
    return std::max(lines_in(content_of(root() / out / "walk/frames.csv")) - 1, 0L);
  }

  static void expect_as_uninterrupted(const std::string& out, const std::string& whole_out = "whole") {
    const auto files = files_below(root() / whole_out / "walk");
    EXPECT_EQ(files_below(root() / out / "walk"), files);
    for (const std::string& file : files) {
      if (!file.ends_with(".png") && !file.ends_with(".exr")) continue;
      EXPECT_TRUE(content_of(root() / out / "walk" / file) == content_of(root() / whole_out / "walk" / file))
          << file;
    }
    EXPECT_EQ(reproducible_rows(root() / out / "walk/frames.csv"),
              reproducible_rows(root() / whole_out / "walk/frames.csv"));
    const nlohmann::json whole = summary(whole_out), resumed = summary(out);
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
  void interrupt(const std::string& out, const std::string& format, int signal) {
    const long rows = engine_() % 4 == 0 ? -1 : static_cast<long>(engine_() % kFrames);
    const auto more = std::chrono::microseconds(engine_() % (rows < 0 ? 60'000 : 10'000));
    const std::string flags = kFlags + "--resume --out " + out + " --format " + format;
    ChildProgram herr(root(), [&flags] { return replay_with(flags); });
    while (rows >= 0 && rows_in(out) < rows && herr.runs() && !herr_is_done(out)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(more);
    herr.send(signal);
    herr.finish();
    const long left = rows_in(out);
    if (left > 0 && left < kFrames) ++interrupted_in_the_middle_;
    expect_rows_have_pictures(out, format, left);
  }
  // It may wait for a reader of its table then.
  static bool herr_is_done(const std::string& out) { return fs::exists(root() / out / "walk/summary.json"); }
  static void expect_rows_have_pictures(const std::string& out, const std::string& format, long rows) {
    for (long i = 0; i < rows; ++i) {
      const std::string number = std::to_string(i);
      const std::string name = "frame_" + std::string(6 - number.size(), '0') + number +
                               (format == "exr" ? ".exr" : ".right_focus.png");
      EXPECT_TRUE(fs::exists(root() / out / "walk/frames" / name)) << name;
    }
  }

  void interrupt_often(int times, const std::string& format, int signal) {
    const auto seed = std::random_device{}();
    std::cout << "seed " << seed << '\n';
    engine_.seed(seed);
    for (int trial = 0; trial < times; ++trial) {
      SCOPED_TRACE("trial " + std::to_string(trial) + " of seed " + std::to_string(seed));
      const std::string out = "o" + std::to_string(trial);
      interrupt(out, format, signal);
      if (trial % 3 == 0) interrupt(out, format, signal);
      const Outcome outcome = resume(out, "--format " + format);
      ASSERT_EQ(outcome.exit_code, 5) << outcome.err;
      expect_as_uninterrupted(out, format == "exr" ? "whole_exr" : "whole");
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
  interrupt_often(20, "exr", SIGTERM);
}

TEST_F(Resume, AfterSigkillAtAnyInstantAllIsAsIfNothingHadHappened) {
  interrupt_often(10, "png", SIGKILL);
}

TEST_F(Resume, OfNothingIsAFreshRunAndOfAFinishedOneNothing) {
  ASSERT_EQ(resume("fresh").exit_code, 5);
  expect_as_uninterrupted("fresh");
  const std::string before = content_of(root() / "fresh/walk/summary.json");
  const fs::path picture = root() / "fresh/walk/frames/frame_000000.left_context.png";
  const auto written = fs::last_write_time(picture);
  const Outcome again = resume("fresh");
  EXPECT_EQ(again.exit_code, 5);  // images were skipped: the result is as partial as before
  EXPECT_NE(again.err.find("walk: nothing to do, all 16 frames are there"), std::string::npos) << again.err;
  EXPECT_EQ(content_of(root() / "fresh/walk/summary.json"), before);
  EXPECT_EQ(fs::last_write_time(picture), written);
}

// A copy of the finished run whose frames.csv keeps its first `rows` rows.
void copy_with_rows(const fs::path& from, const fs::path& to, int rows) {
  fs::copy(from, to, fs::copy_options::recursive);
  const std::string text = content_of(from / "frames.csv");
  write_text(to / "frames.csv", text.substr(0, row_begin(text, rows)));
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
  const std::size_t tenth = row_begin(text, 9);
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
  refused("--frames 15", "--start, --duration, --frames was frames 0 ... 15, is frames 0 ... 14");
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
  // No file may be longer than eleven rows of frames.csv and a bit: that one fails, if no picture does
  // before.
  const std::string flags = kFlags + "--out full ";
  const rlim_t limit = row_begin(content_of(root() / "whole/walk/frames.csv"), 11) + 20;
  ChildProgram child(root(), [&] {
    const rlimit tight{limit, limit};
    return ::setrlimit(RLIMIT_FSIZE, &tight) == 0 ? replay_with(flags) : 99;
  });
  ASSERT_EQ(child.finish(), 75);
  const std::string errors = content_of(root() / "stderr.txt");
  EXPECT_NE(errors.find("cannot write: File too large"), std::string::npos) << errors;
  const long rows = rows_in("full");
  EXPECT_GT(rows, 0);
  EXPECT_LT(rows, kFrames);
  expect_rows_have_pictures("full", "png", rows);
  const Outcome refused = replay(flags);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--resume"), std::string::npos) << refused.err;
  EXPECT_EQ(resume("full").exit_code, 5);
  expect_as_uninterrupted("full");
}

TEST_F(Resume, SessionsThatAreFinishedArePassedOver) {
  const std::string flags =
      "replay walk second --profile small.profile.json --polar 32x32 --keep-going --out two";
  ASSERT_EQ(replay(flags).exit_code, 5);
  const std::string picture = content_of(root() / "two/second/frames/frame_000007.left_focus.png");
  fs::remove(root() / "two/second/frames/frame_000007.left_focus.png");
  const Outcome outcome = replay(flags + " --resume --json");
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
  EXPECT_NE(outcome.err.find("walk: nothing to do"), std::string::npos) << outcome.err;
  EXPECT_TRUE(content_of(root() / "two/second/frames/frame_000007.left_focus.png") == picture);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["sessions"][1]["frames"]["kept"], 7);
  // 0.5 s end at the pose at 45/90 s, frame 30; those of the other session a nanosecond before frame 12.
  EXPECT_EQ(json["total"]["frames"]["rendered"], 31 + 12);
}

TEST_F(Resume, WithoutPicturesRowsDecide) {
  const std::string flags = kFlags + "--format none --contact-sheet none --out none ";
  ASSERT_EQ(replay(flags).exit_code, 5);
  const std::string text = content_of(root() / "none/walk/frames.csv");
  write_text(root() / "none/walk/frames.csv", text.substr(0, row_begin(text, 5)));
  ASSERT_EQ(replay(flags + "--resume").exit_code, 5);
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
