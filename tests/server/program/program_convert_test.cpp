// `herr convert` as its users run it: one command, exit codes, nothing half-written.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "server/output/png_encoder.h"
#include "sessions/files/atomic_file.h"
#include "sessions/session.h"
#include "tests/paths.h"
#include "tests/server/program/child_program.h"
#include "tests/server/program/program_runner.h"
#include "tests/temporary_folder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

class ConvertProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string rows;
    for (int i = 0; i < 11; ++i) rows += "100." + std::to_string(10 + i) + " 0 1.6 0 0 0 0 1\n";
    write_whole_file(root() / "walk.txt", rows);
    fs::create_directory(root() / "pictures");
    Srgb8Image picture;
    picture.width_px = picture.height_px = 4;
    for (const char* name : {"1.png", "2.png", "10.png"}) {
      picture.values.assign(4 * 4 * 3, static_cast<std::uint8_t>(20 * std::atoi(name)));
      picture.channels = 3;
      std::vector<std::uint8_t> png;
      encode_png(picture, png, 1);
      write_whole_file(root() / "pictures" / name, png);
    }
  }
  const fs::path& root() const { return folder_.path(); }

  Outcome convert(const std::string& arguments, const std::string& before = "") const {
    return run_program(root(), "convert " + arguments, before);
  }
  // What lies in the folder beside what the test itself put there.
  std::vector<std::string> made() const {
    std::vector<std::string> names;
    for (const std::string& name : folder_.names())
      if (name != "walk.txt" && name != "pictures" && name != "stdout.txt" && name != "stderr.txt" &&
          name != "bad.txt")
        names.push_back(name);
    return names;
  }
  TemporaryFolder folder_;
};

TEST_F(ConvertProgram, MakesASessionWithALoopedFeed) {
  const Outcome got = convert(
      "walk.txt session --preset tum --camera pictures --camera-hz 50 --camera-loop --camera-hfov 90 --json");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  EXPECT_EQ(made(), std::vector<std::string>{"session"});
  const auto report = nlohmann::json::parse(got.out);
  EXPECT_EQ(report["poses"]["rows"], 11);
  EXPECT_EQ(report["cameras"][0]["pictures"], 3);
  EXPECT_EQ(report["cameras"][0]["frames"], 6);
  // 0, 20, ... 100 ms of a tenth of a second.
  EXPECT_EQ(content_of(root() / "session/cam0/data.csv"),
            "timestamp_ns,filename\n100100000000,000000.png\n100120000000,000001.png\n"
            "100140000000,000002.png\n100160000000,000000.png\n100180000000,000001.png\n"
            "100200000000,000002.png\n");
  EXPECT_EQ(content_of(root() / "session/cam0/data/000002.png"), content_of(root() / "pictures/10.png"));
  const Session session = Session::open(root() / "session");
  // 4 pixels over 90 degrees: half of them over tan 45 = 1.
  EXPECT_NEAR(session.header().cameras[0].model.fx, 2, 1e-12);
}

TEST_F(ConvertProgram, StopsTheFeedWithThePicturesUnlessLooped) {
  ASSERT_EQ(convert("walk.txt s --preset tum --camera pictures --camera-hz 50 --camera-hfov 90").exit_code,
            0);
  EXPECT_EQ(Session::open(root() / "s").findings().camera_rows[0], 3);
}

TEST_F(ConvertProgram, RefusesWrongUsage) {
  const std::vector<std::pair<std::string, std::string>> lines{
      {"walk.txt s --preset tumm", "did you mean tum?"},
      {"walk.txt s --preset tum --map m.json", "--preset: --map is given too"},
      {"walk.txt --preset tum", "OUT: missing"},
      {"--preset tum", "HEAD: missing"},
      {"walk.txt s --preset tum --camera-hfov 180", "--camera-hfov"},
      {"walk.txt s --preset tum --camera-hfov 66", "--camera-hfov: there are no pictures"},
      {"walk.txt s --preset tum --camera-loop", "--camera-loop: there are no pictures"},
      {"walk.txt s --preset tum --feed-distance 3", "--feed-distance: there are no pictures"},
      {"walk.txt s --preset tum --no-camera --camera-hz 3",
       "--camera-hz: --no-camera leaves the pictures out"},
      {"walk.txt s --preset tum --no-camera --camera pictures", "--no-camera: --camera is given too"},
      {"walk.txt s --preset tum --camera pictures --camera pictures --camera pictures", "--camera: give one"},
      {"walk.txt s --preset tum --camera pictures --camera-hz 3 --camera-names {ms}",
       "--camera-hz: give one of"},
      {"walk.txt s --preset tum --camera pictures --camera-stamps a --camera-stamps b",
       "--camera-stamps: is given 2 times, and there is one camera"},
      {"walk.txt s --preset tum --camera pictures --camera pictures --camera-calibration c --camera-label "
       "left",
       "--camera-label: is given once, and there are two cameras"},
      {"walk.txt s --preset tum --camera pictures --camera-label left",
       "--camera-label: names a camera of a"},
      {"walk.txt s --preset tum --camera pictures --camera-zone Berlin", "--camera-zone: 'Berlin'"},
      {"walk.txt s --preset tum --camera pictures --camera-hz 3 --camera-zone Z", "--camera-zone: with"},
      {"walk.txt s --preset tum --camera pictures --camera-hfov 66 --camera-calibration c.json",
       "--camera-hfov: the calibration has a lens"},
      {"walk.txt s --preset tum --camera pictures --camera-hfov 66 --camera-label left",
       "--camera-label: names a camera of a calibration"},
      {"walk.txt s --preset tum --scene /room.scene.json", "--scene: is an absolute path"},
      {"walk.txt s --preset tum --scene ../room.scene.json",
       "--scene: there is no file s/../room.scene.json; write the path relative to OUT"},
      {"walk.txt pictures --preset tum", "is not empty; give --overwrite"},
      {"walk.txt pictures --preset tum --overwrite", "only a session is overwritten"},
      {"walk.txt walk.txt --preset tum", "OUT:"}};
  for (const auto& [line, message] : lines) {
    const Outcome got = convert(line);
    EXPECT_EQ(got.exit_code, 2) << line << "\n" << got.err;
    EXPECT_NE(got.err.find(message), std::string::npos) << got.err;
    EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
  }
  EXPECT_TRUE(made().empty());
}

TEST_F(ConvertProgram, RefusesPicturesOfAnUnknownLens) {
  const Outcome got = convert("walk.txt s --preset tum --camera pictures --camera-hz 50");
  EXPECT_EQ(got.exit_code, 3);
  EXPECT_EQ(got.err,
            "herr: pictures: has pictures of an unknown lens; give --camera-hfov DEGREES or "
            "--camera-calibration FILE\n");
  EXPECT_TRUE(made().empty());
}

TEST_F(ConvertProgram, RecognisesAFormatAndSaysWhich) {
  const Outcome got = convert("walk.txt s");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  EXPECT_NE(got.out.find("format: preset tum"), std::string::npos) << got.out;
}

TEST_F(ConvertProgram, LeavesNothingBehindBadInput) {
  write_whole_file(root() / "bad.txt",
                   std::string_view("1.0 0 0 0 0 0 0 1\n1.1 0 0 O 0 0 0 1\n1.2 0 0 0 0 0 0 1\n"));
  const Outcome got = convert("bad.txt s --preset tum");
  EXPECT_EQ(got.exit_code, 3);
  EXPECT_NE(got.err.find("bad.txt:2: column 4 is 'O'"), std::string::npos) << got.err;
  EXPECT_TRUE(made().empty());
  EXPECT_EQ(convert("missing.txt s --preset tum").exit_code, 3);
  EXPECT_EQ(convert("bad.txt far/below/s --preset tum").exit_code, 3);
  EXPECT_FALSE(fs::exists(root() / "far")) << "folders above OUT were made for nothing";
  // Nanoseconds taken for seconds: rows a nanosecond apart are no recording.
  write_whole_file(root() / "bad.txt",
                   std::string_view("1e-9 0 0 0 0 0 0 1\n2e-9 0 0 0 0 0 0 1\n3e-9 0 0 0 0 0 0 1\n"));
  const Outcome fast = convert("bad.txt s --preset tum");
  EXPECT_EQ(fast.exit_code, 3);
  EXPECT_NE(fast.err.find("bad.txt: gives no usable session"), std::string::npos) << fast.err;
  EXPECT_EQ(fast.err.find(".tmp."), std::string::npos) << fast.err;
  EXPECT_TRUE(made().empty());
}

TEST_F(ConvertProgram, LeavesBadRowsOutWhenToldToAndSaysSo) {
  write_whole_file(root() / "bad.txt",
                   std::string_view("1.0 0 0 0 0 0 0 1\n1.1 0 0 O 0 0 0 1\n1.2 0 0 0 0 0 0 1\n"));
  const Outcome got = convert("bad.txt s --preset tum --keep-going");
  EXPECT_EQ(got.exit_code, 5);
  EXPECT_NE(got.out.find("1 row left out: not readable (line 2)"), std::string::npos) << got.out;
  EXPECT_NE(got.err.find("bad.txt: 1 of 3 rows are not in the session"), std::string::npos) << got.err;
  EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
  EXPECT_EQ(Session::open(root() / "s").findings().pose_rows, 2);
}

TEST_F(ConvertProgram, ATwentiethOfBadRowsIsSaidAndNoPartialResult) {
  std::string rows = "1.0 0 0 O 0 0 0 1\n";
  for (int i = 100; i < 119; ++i) rows += "2." + std::to_string(i) + " 0 0 0 0 0 0 1\n";
  write_whole_file(root() / "bad.txt", rows);
  const Outcome got = convert("bad.txt s --preset tum --keep-going");
  EXPECT_EQ(got.exit_code, 0) << got.err;
  EXPECT_EQ(got.err, "");
  EXPECT_NE(got.out.find("1 row left out: not readable (line 1)"), std::string::npos) << got.out;
}

TEST_F(ConvertProgram, InspectTellsWhatAConversionLeftOut) {
  write_whole_file(root() / "bad.txt",
                   std::string_view("1.0 0 0 0 0 0 0 1\n1.1 0 0 O 0 0 0 1\n1.2 0 0 0 0 0 0 1\n"));
  ASSERT_EQ(convert("bad.txt s --preset tum --keep-going").exit_code, 5);
  const Outcome text = run_program(root(), "inspect s");
  EXPECT_NE(text.out.find("left out    pose: 1 of 3: rows left out: not readable"), std::string::npos)
      << text.out;
  const auto json = nlohmann::json::parse(run_program(root(), "inspect s --json").out);
  const auto& part = json["session"]["conversion"]["left_out"][0];
  EXPECT_EQ(part["stream"], "pose");
  EXPECT_EQ(part["rows"], 1);
  EXPECT_EQ(part["of"], 3);
  // A session that nobody converted has nothing to tell.
  ASSERT_EQ(run_program(root(), "synth made --duration 1").exit_code, 0);
  const auto made = nlohmann::json::parse(run_program(root(), "inspect made --json").out);
  EXPECT_TRUE(made["session"]["conversion"].is_null());
  EXPECT_TRUE(made["session"]["feed_distance_m"].is_null());
}

TEST_F(ConvertProgram, ReplacesASessionOnlyAsAWhole) {
  ASSERT_EQ(convert("walk.txt s --preset tum").exit_code, 0);
  const std::string before = content_of(root() / "s/pose/data.csv");
  EXPECT_EQ(convert("walk.txt s --preset tum").exit_code, 2);
  write_whole_file(root() / "bad.txt", std::string_view("1.0 0 0 O 0 0 0 1\n"));
  EXPECT_EQ(convert("bad.txt s --preset tum --overwrite").exit_code, 3);
  EXPECT_EQ(content_of(root() / "s/pose/data.csv"), before);
  // A file may have four blocks of 512 or 1024 bytes, and 300 rows have more than 20 bytes each.
  std::string rows;
  for (int i = 100; i < 400; ++i) rows += "1." + std::to_string(i) + " 0 0 0 0 0 0 1\n";
  write_whole_file(root() / "bad.txt", rows);
  const Outcome full = convert("bad.txt s --preset tum --overwrite", "ulimit -f 4;");
  EXPECT_EQ(full.exit_code, 75) << full.err;
  EXPECT_EQ(content_of(root() / "s/pose/data.csv"), before);
  ASSERT_EQ(convert("bad.txt s --preset tum --overwrite").exit_code, 0);
  EXPECT_EQ(Session::open(root() / "s").findings().pose_rows, 300);
  EXPECT_EQ(made(), std::vector<std::string>{"s"});
}

TEST_F(ConvertProgram, OverwritesNothingThatIsNoPartOfASession) {
  ASSERT_EQ(convert("walk.txt s --preset tum --camera pictures --camera-hz 50 --camera-hfov 90").exit_code,
            0);
  for (const char* own : {"s/notes.txt", "s/pose/raw.csv"}) {
    write_whole_file(root() / own, std::string_view("mine"));
    const Outcome got = convert("walk.txt s --preset tum --overwrite");
    EXPECT_EQ(got.exit_code, 2) << own;
    EXPECT_NE(got.err.find(std::string(own) + " is no part of the session"), std::string::npos) << got.err;
    EXPECT_EQ(content_of(root() / own), "mine");
    fs::remove(root() / own);
  }
  fs::create_directory_symlink("s", root() / "link");
  EXPECT_EQ(convert("walk.txt link --preset tum --overwrite").exit_code, 2);
  EXPECT_TRUE(fs::is_symlink(root() / "link"));
  EXPECT_EQ(convert("walk.txt s --preset tum --overwrite").exit_code, 0);
}

TEST_F(ConvertProgram, ASignalLeavesNothing) {
  std::string rows;  // a second or more of work
  for (int i = 100'000; i < 600'000; ++i) rows += std::to_string(i) + " 0 0 0 0 0 0 1\n";
  write_whole_file(root() / "long.txt", rows);
  const auto before = made();
  ChildProgram child(root(), {test::program_path(), "convert", "long.txt", "s", "--preset", "tum"});
  // It writes: so its handler of the signal is in place.
  while (child.runs() && made() == before) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  child.send(SIGTERM);
  EXPECT_EQ(child.finish(), 128 + SIGTERM);
  EXPECT_EQ(content_of(root() / "stderr.txt"), "herr: stopped: nothing was written\n");
  EXPECT_EQ(made(), before);
}

TEST_F(ConvertProgram, PrintsMapsThatItReadsBack) {
  const Outcome shown = convert("--show-map --preset tum");
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  write_whole_file(root() / "bad.txt", shown.out);
  EXPECT_EQ(convert("walk.txt s --map bad.txt").exit_code, 0);
}

// A head whose file holds poses alone, in the columns of the preset jov2023; `gaze`: the rows beside it.
void write_split_recording(const fs::path& folder, bool gaze) {
  std::string head = "time,head_pos_x,head_pos_y,head_pos_z,head_rot_x,head_rot_y,head_rot_z\n", eyes;
  eyes = "time,dir_x,dir_y,dir_z,pupil_l,pupil_r\n";
  for (int i = 0; i < 60; ++i) {
    const std::string t = std::to_string(1 + 0.011 * i);
    head += t + ",0.1,1.6," + std::to_string(0.001 * i) + "," + std::to_string(0.1 * i) + ",5,0\n";
    // As people's do, the eyes turn against the head: 0.1 degrees are 0.0017.
    eyes += t + ",0.01," + std::to_string(0.02 + 0.0017 * i) + ",0.99,3,3\n";
  }
  write_whole_file(folder / "walk_head.csv", head);
  if (gaze) write_whole_file(folder / "walk_gaze.csv", eyes);
}

TEST_F(ConvertProgram, GazeThatLiesBesideTheHeadIsNamedAndProposed) {
  write_split_recording(root(), true);
  const Outcome alone = convert("walk_head.csv s --profile xr1-half");
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_NE(alone.out.find(
                "walk_head.csv holds no gaze, but walk_gaze.csv lies beside it (without it the eyes look "
                "straight ahead); to take it: herr convert walk_head.csv s --profile xr1-half --gaze "
                "walk_gaze.csv --overwrite\n"),
            std::string::npos)
      << alone.out;
  EXPECT_EQ(alone.out.find("no gaze was recorded"), std::string::npos) << alone.out;
  EXPECT_EQ(content_of(root() / "s/session.json").find("\"still\""), std::string::npos)
      << "nobody knows that it was not recorded";
  // The line is one to type.
  EXPECT_EQ(convert("walk_head.csv s --profile xr1-half --gaze walk_gaze.csv --overwrite").exit_code, 0);
  EXPECT_TRUE(fs::exists(root() / "s/gaze/data.csv"));
  // A head whose name says nothing of a head has its gaze beside it, too.
  fs::copy_file(root() / "walk_head.csv", root() / "walk.csv");
  const std::string plain = convert("walk.csv t").out;
  EXPECT_NE(plain.find("to take it: herr convert walk.csv t --gaze walk_gaze.csv --overwrite\n"),
            std::string::npos)
      << plain;
  const Outcome check = convert("--check walk_head.csv");
  EXPECT_NE(
      check.out.find("recommended: herr convert walk_head.csv OUT --gaze walk_gaze.csv --preset jov2023"),
      std::string::npos)
      << check.out;
  EXPECT_NE(check.out.find("The gaze lies beside the head, in walk_gaze.csv."), std::string::npos)
      << check.out;
}

TEST_F(ConvertProgram, AHeadAloneSaysThatNoGazeWasRecorded) {
  write_split_recording(root(), false);
  const Outcome got = convert("walk_head.csv s");
  EXPECT_NE(got.out.find("no gaze was recorded"), std::string::npos) << got.out;
  EXPECT_EQ(convert("--check walk_head.csv").out.find("--gaze"), std::string::npos);
  // The session says so itself: inspect notes it, and nothing warns of it later.
  const Outcome inspected = run_program(root(), "inspect s");
  EXPECT_NE(inspected.out.find("note     s/gaze/data.csv: no gaze was recorded, as session.json says"),
            std::string::npos)
      << inspected.out;
  EXPECT_EQ(inspected.out.find("does not exist"), std::string::npos) << inspected.out;
}

TEST_F(ConvertProgram, ARowWithoutANumberNamesItsColumn) {
  std::string table = "time,head_pos_x,head_pos_y,head_pos_z,head_rot_x,head_rot_y,head_rot_z\n";
  for (int i = 0; i < 60; ++i)
    table += std::to_string(1 + 0.011 * i) + (i == 3 ? ",nan,1.6," : ",0.1,1.6,") +
             std::to_string(0.001 * i) + "," + std::to_string(0.1 * i) + ",5,0\n";
  write_whole_file(root() / "holes_head.csv", table);
  const Outcome got = convert("holes_head.csv s");
  EXPECT_NE(got.out.find("1 row left out: without tracking (line 5); head_pos_x is 'nan'"), std::string::npos)
      << got.out << got.err;
}

}  // namespace
}  // namespace herr
