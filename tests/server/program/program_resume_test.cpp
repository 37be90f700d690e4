// `herr replay --resume` and what it finds: nothing, everything, files that went or were
// damaged, another command line.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/server/program/resumed_replay.h"

namespace herr {
namespace {

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

// Probes gather light from frame to frame: from the checkpoint, or from the start where that is too late.
TEST_F(Resume, WhatProbesHaveGatheredIsThereAgain) {
  const std::string probes = kFlags + "--probes --probe-budget 300 ";
  ASSERT_EQ(replay(probes + "--out with_probes").exit_code, 5);
  for (const int kept : {5, kFrames}) {
    const fs::path folder = root() / ("probes_" + std::to_string(kept));
    fs::create_directories(folder);
    copy_with_rows(root() / "with_probes/walk", folder / "walk", kept);
    fs::remove(folder / "walk/frames/frame_000015.left_focus.png");
    const Outcome outcome = replay(probes + "--resume --out " + folder.string());
    ASSERT_EQ(outcome.exit_code, 5) << outcome.err;
    for (const std::string& file : files_below(folder / "walk/frames")) {
      EXPECT_TRUE(content_of(folder / "walk/frames" / file) ==
                  content_of(root() / "with_probes/walk/frames" / file))
          << file;
    }
  }
}

std::vector<std::string> column_of(const fs::path& csv, const std::string& name) {
  std::ifstream file(csv);
  std::vector<std::string> values;
  std::ptrdiff_t wanted = -1;
  for (std::string line; std::getline(file, line);) {
    std::vector<std::string> cells;
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (wanted < 0) {
      wanted = std::find(cells.begin(), cells.end(), name) - cells.begin();
      continue;
    }
    values.push_back(cells.at(static_cast<std::size_t>(wanted)));
  }
  return values;
}

// The head starts from rest and is fast from then on: the width follows, the same way in every run.
TEST_F(Resume, FramesWhoseQualityFollowsTheHeadAreThoseOfAnUninterruptedRun) {
  const std::string motion = kFlags + "--policy motion --light-samples 16 ";
  ASSERT_EQ(replay(motion + "--out with_motion").exit_code, 5);
  const fs::path whole = root() / "with_motion/walk";
  const std::vector<std::string> widths = column_of(whole / "frames.csv", "polar_width");
  EXPECT_EQ(widths.front(), "16");
  EXPECT_EQ(widths.back(), "6") << "0.4 * 16 = 6.4";
  EXPECT_EQ(column_of(whole / "frames.csv", "light_samples").back(), "1");
  ASSERT_EQ(replay(motion + "--out again_with_motion").exit_code, 5);
  EXPECT_EQ(reproducible_rows(root() / "again_with_motion/walk/frames.csv"),
            reproducible_rows(whole / "frames.csv"));
  for (const int kept : {1, 5}) {
    const fs::path folder = root() / ("motion_" + std::to_string(kept));
    fs::create_directories(folder);
    copy_with_rows(whole, folder / "walk", kept);
    EXPECT_EQ(replay(kFlags + "--light-samples 16 --resume --out " + folder.string()).exit_code, 2);
    const Outcome outcome = replay(motion + "--resume --out " + folder.string());
    ASSERT_EQ(outcome.exit_code, 5) << outcome.err;
    EXPECT_EQ(reproducible_rows(folder / "walk/frames.csv"), reproducible_rows(whole / "frames.csv"));
    for (const std::string& file : files_below(folder / "walk/frames")) {
      EXPECT_TRUE(content_of(folder / "walk/frames" / file) == content_of(whole / "frames" / file)) << file;
    }
  }
}

// Buffers that follow the display, narrowed by motion relative to what each frame needs.
TEST_F(Resume, FramesWhoseBufferFollowsTheDisplayAreThoseOfAnUninterruptedRun) {
  const std::string flags =
      "replay walk --profile small.profile.json --polar acuity --policy motion --threads 1 --keep-going "
      "--frames 4 ";  // before the picture that does not decode
  ASSERT_EQ(replay(flags + "--out follows").exit_code, 0);
  const fs::path whole = root() / "follows/walk";
  // 200 ln(55.7356) = 804.06 columns, and 0.4 of them while the head is fast.
  const std::vector<std::string> widths = column_of(whole / "frames.csv", "polar_width");
  EXPECT_EQ(widths.front(), "805");
  EXPECT_EQ(widths.back(), "322");
  fs::create_directories(root() / "follows_2");
  copy_with_rows(whole, root() / "follows_2/walk", 2);
  ASSERT_EQ(replay(flags + "--resume --out follows_2").exit_code, 0);
  EXPECT_EQ(reproducible_rows(root() / "follows_2/walk/frames.csv"), reproducible_rows(whole / "frames.csv"));
  for (const std::string& file : files_below(whole / "frames"))
    EXPECT_TRUE(content_of(root() / "follows_2/walk/frames" / file) == content_of(whole / "frames" / file))
        << file;
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

// Files of one name, beside the scene's model and beside a model below an asset root: nothing changed, and
// each of them is guarded.
TEST_F(Resume, FilesOfOneNameInTwoFoldersAreToldApart) {
  const std::string model = content_of(root() / "scene/triangle.gltf");
  const std::string data =
      model.substr(model.find("data:"), model.find("\"}]", model.find("data:")) - model.find("data:"));
  std::string named = model;
  named.replace(named.find(data), data.size(), "corners.bin");
  const float corners[3][3] = {{-1, 0, -2}, {1, 0, -2}, {0, 2, -2}};
  std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
  write_text(root() / "two/near.gltf", named);
  write_text(root() / "two/corners.bin", bytes);
  write_text(root() / "models/far.gltf", named);
  write_text(root() / "models/corners.bin", bytes + "longer");
  write_text(root() / "two/two.scene.json", R"({"format_version": 1, "name": "two",
"gltf": [{"file": "near.gltf", "name": "near"}, {"file": "far.gltf", "name": "far"}], "ambient": [1, 1, 1]})");
  const std::string flags = kFlags + "--scene two/two.scene.json --asset-root models --out apart ";
  ASSERT_EQ(replay(flags).exit_code, 5);
  const Outcome same = replay(flags + "--resume");
  EXPECT_EQ(same.exit_code, 5) << same.err;
  EXPECT_NE(same.err.find("nothing to do"), std::string::npos) << same.err;
  for (const auto& [file, name] : {std::pair{"two/corners.bin", "apart/walk: corners.bin has changed"},
                                   {"models/corners.bin", "asset root 1/corners.bin has changed"}}) {
    const std::string kept = content_of(root() / file);
    write_text(root() / file, kept + "longer");
    const Outcome refused = replay(flags + "--resume");
    EXPECT_EQ(refused.exit_code, 2) << refused.err;
    EXPECT_NE(refused.err.find(name), std::string::npos) << refused.err;
    write_text(root() / file, kept);
  }
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
  // No file may be longer than eleven rows of frames.csv and a bit: that one fails,
  // if no picture does before.
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
  expect_rows_have_pictures("full", rows);
  const Outcome refused = replay(flags);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--resume"), std::string::npos) << refused.err;
  EXPECT_EQ(resume("full").exit_code, 5);
  expect_as_uninterrupted("full");
}

TEST_F(Resume, SessionsThatAreFinishedArePassedOver) {
  const std::string flags =
      "replay walk second --profile small.profile.json --preset direct --polar 32x32 --keep-going --out two";
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

}  // namespace
}  // namespace herr
