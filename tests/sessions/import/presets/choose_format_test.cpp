// Which format a recording is taken for: by its columns, and among siblings by what its data say.
#include "sessions/import/presets/choose_format.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "sessions/import/presets/recording_folder.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

constexpr double kPi = std::numbers::pi;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9f", value);
  return text;
}

// 300 rows of 100 Hz: a head that turns to and fro by 60 degrees about the axis `up` (0 x, 1 y, 2 z) of the
// file, its own axes parallel to the world's at the beginning.
std::string turning_about(int up) {
  std::string rows = "t,x,y,z,qx,qy,qz,qw\n";
  for (int i = 0; i < 300; ++i) {
    const double half = std::sin(i * 0.03) * kPi / 6;
    const double q[3] = {up == 0 ? std::sin(half) : 0, up == 1 ? std::sin(half) : 0,
                         up == 2 ? std::sin(half) : 0};
    rows += number(1 + i * 0.01) + ",0.1,1.6,0.2," + number(q[0]) + "," + number(q[1]) + "," + number(q[2]) +
            "," + number(std::cos(half)) + "\n";
  }
  return rows;
}

std::string head(const std::string& variant, const std::string& axes) {
  return R"({"variant": ")" + variant + R"(", "time": {"column": "t", "unit": "s"},
    "position": {"columns": ["x", "y", "z"]}, "orientation": {"quaternion_xyzw": ["qx", "qy", "qz", "qw"]},
    "world_axes": )" +
         axes + R"(, "head_axes": )" + axes + "}";
}

const std::string kYUp = R"(["right", "up", "back"])", kZUp = R"(["forward", "left", "up"])";

FormatRequest request(const RecordedFolder& folder, const std::string& heads) {
  FormatRequest request;
  request.files.head = folder / "head.csv";
  request.map = std::make_shared<const ColumnMap>(
      parse_column_map(R"({"format_version": 1, "name": "lab", "head": [)" + heads + "]}", "lab.json"));
  return request;
}

TEST(ChooseFormat, AFileWithASlashBehindItsNameIsToldAsSuch) {
  const RecordedFolder folder;
  folder.write("head.csv", turning_about(1));
  FormatRequest asked;
  asked.files.head = folder / "head.csv/";
  EXPECT_INPUT_ERROR(choose_format(asked),
                     "head.csv/: ends with '/', and what stands before it is a file; leave the '/' out");
  asked.files.head = folder / "heads.csv/";
  EXPECT_INPUT_ERROR(choose_format(asked), "heads.csv/: does not exist; name a recording");
}

TEST(ChooseFormat, TakesTheSiblingInWhichTheHeadTurnsAboutTheVertical) {
  const RecordedFolder folder;
  const std::string both = head("y-up", kYUp) + "," + head("z-up", kZUp);
  folder.write("head.csv", turning_about(2));
  const ChosenFormat z_up = choose_format(request(folder, both));
  EXPECT_EQ(z_up.format.variant(), "z-up");
  ASSERT_FALSE(z_up.remarks.empty());
  EXPECT_NE(z_up.remarks.front().find("variant z-up was taken"), std::string::npos) << z_up.remarks.front();
  folder.write("head.csv", turning_about(1));
  EXPECT_EQ(choose_format(request(folder, both)).format.variant(), "y-up");
}

TEST(ChooseFormat, RefusesWithTheNamesOfBothWhereAStillHeadCannotTell) {
  const RecordedFolder folder;
  std::string rows = "t,x,y,z,qx,qy,qz,qw\n";
  for (int i = 0; i < 300; ++i) rows += number(1 + i * 0.01) + ",0.1,1.6,0.2,0,0,0,1\n";
  folder.write("head.csv", rows);
  FormatRequest both = request(folder, head("y-up", kYUp) + "," + head("z-up", kZUp));
  const std::string error = error_of([&] { choose_format(both); });
  EXPECT_NE(error.find("variant y-up"), std::string::npos) << error;
  EXPECT_NE(error.find("z-up"), std::string::npos) << error;
  EXPECT_NE(error.find("--variant"), std::string::npos) << error;
  both.variant = "z-up";
  EXPECT_EQ(choose_format(both).format.variant(), "z-up");
}

TEST(ChooseFormat, OfOneVariantTakesTheFirstWhoseColumnsAreThere) {
  const RecordedFolder folder;
  folder.write("head.csv", turning_about(1));
  std::string richer = head("", kYUp);
  richer.replace(richer.find("\"position\""), 10, "\"part\": \"graph\", \"position\"");
  const FormatRequest asked = request(folder, richer + "," + head("", kYUp));
  const ChosenFormat chosen = choose_format(asked);
  EXPECT_EQ(chosen.format.columns.head, &asked.map->head[1]);
  EXPECT_TRUE(chosen.remarks.empty());
}

TEST(ChooseFormat, RecognisesAPresetByItsColumnsAndNamesItWhereAnotherWasAskedFor) {
  const RecordedFolder folder;
  std::string rows = "time,head_pos_x,head_pos_y,head_pos_z,head_rot_x,head_rot_y,head_rot_z\n";
  for (int i = 0; i < 300; ++i)
    rows += number(1 + i * 0.011) + ",0.1,1.6,0.2,10," + number(30 * std::sin(i * 0.02)) + ",1\n";
  folder.write("head.csv", rows);
  FormatRequest asked;
  asked.files.head = folder / "head.csv";
  EXPECT_EQ(choose_format(asked).format.preset, "jov2023");
  asked.preset = "pico-neo";
  const std::string error = error_of([&] { choose_format(asked); });
  EXPECT_NE(error.find("pico-neo"), std::string::npos) << error;
  EXPECT_NE(error.find("jov2023"), std::string::npos) << error;
}

TEST(ChooseFormat, SaysWhatToDoWithColumnsThatNobodyKnows) {
  const RecordedFolder folder;
  folder.write("head.csv", "a,b\n1,2\n3,4\n");
  FormatRequest asked;
  asked.files.head = folder / "head.csv";
  EXPECT_NE(error_of([&] { choose_format(asked); }).find("--check"), std::string::npos);
  asked.files.head = folder / "missing.csv";
  EXPECT_NE(error_of([&] { choose_format(asked); }).find("does not exist"), std::string::npos);
}

TEST(ChooseFormat, AsksForAStillHeadWhereOnlyGazeWasRecorded) {
  const RecordedFolder folder;
  folder.write("gaze.csv", "t,gx,gy,gz\n1,0,0,1\n1.1,0,0,1\n");
  FormatRequest asked;
  asked.files.head = folder / "gaze.csv";
  asked.map = std::make_shared<const ColumnMap>(parse_column_map(
      R"({"format_version": 1, "name": "lab", "gaze": [{"in_head_file": true, "time": {"column": "t", "unit": "s"},
          "axes": ["right", "up", "forward"], "combined": {"vector": ["gx", "gy", "gz"]}}]})",
      "lab.json"));
  EXPECT_NE(error_of([&] { choose_format(asked); }).find("--still-head"), std::string::npos);
  asked.files = {"", folder / "gaze.csv"};
  asked.still.head = true;
  EXPECT_EQ(choose_format(asked).format.columns.head, nullptr);
}

FormatRequest of_file(const std::filesystem::path& head, const std::string& preset = "") {
  FormatRequest asked;
  asked.files.head = head;
  asked.preset = preset;
  return asked;
}

// The same poses as EuRoC (ns, w first, commas) and as TUM (s, w last, blanks) write them.
TEST(ChooseFormat, NamesThePresetThatReadsRowsWithoutNames) {
  const RecordedFolder folder;
  std::string euroc, tum;
  for (int i = 0; i < 60; ++i) {
    const std::string z = number(std::sin(0.002 * i)), w = number(std::cos(0.002 * i));
    euroc += std::to_string(1520530308000000000 + i * 10000000) + ",0,0.2,1.4," + w + ",0,0," + z + "\n";
    tum += number(1305031102 + 0.01 * i) + " 0 1.5 0.2 0 " + z + " 0 " + w + "\n";
  }
  folder.write("euroc.csv", euroc);
  folder.write("tum.txt", tum);
  const std::string error = error_of([&] { choose_format(of_file(folder / "euroc.csv", "tum")); });
  EXPECT_NE(error.find("can be read by preset euroc, not by tum"), std::string::npos) << error;
  const std::string other = error_of([&] { choose_format(of_file(folder / "tum.txt", "euroc")); });
  EXPECT_NE(other.find("can be read by preset tum, not by euroc"), std::string::npos) << other;
}

// Stray Scanner's second column is the frame's number: taken by their place, all columns would shift by one.
TEST(ChooseFormat, RefusesAPresetThatCountsColumnsWhereTheirNamesAreAnothers) {
  const RecordedFolder folder;
  std::string rows = "timestamp, frame, x, y, z, qx, qy, qz, qw\n";
  for (int i = 0; i < 60; ++i) rows += number(86421.5 + i / 60.0) + ", 000001, 0, 0, 0, 1, 0, 0, 0\n";
  folder.write("odometry.csv", rows);
  const std::string error = error_of([&] { choose_format(of_file(folder / "odometry.csv", "tum")); });
  EXPECT_NE(error.find("those of preset stray-scanner, not of tum"), std::string::npos) << error;
}

// w first, as ios_logger writes it: read as TUM's x y z w the level head is turned by 180 degrees about z.
TEST(ChooseFormat, NamesThePresetWhoseOrderOfNumbersMakesALevelHead) {
  const RecordedFolder folder;
  std::string rows;
  for (int i = 0; i < 60; ++i) {
    const double half = std::sin(0.1 * i) / 8;
    rows += number(1700000000 + i / 60.0) + ",0,1.5,0.2," + number(std::cos(half)) + ",0," +
            number(std::sin(half)) + ",0\n";
  }
  folder.write("poses.txt", rows);
  FormatRequest asked = of_file(folder / "poses.txt", "tum");
  const std::string error = error_of([&] { choose_format(asked); });
  EXPECT_NE(error.find("it does as preset ios-logger"), std::string::npos) << error;
  asked.variant = "y-up";
  EXPECT_EQ(choose_format(asked).format.variant(), "y-up") << "the user insists";
  asked = of_file(folder / "poses.txt", "ios-logger");
  EXPECT_TRUE(choose_format(asked).remarks.empty()) << "the user's own word";
}

TEST(ChooseFormat, SaysWhatIsWrongWithAFileThatCannotBeOpenedAsAnything) {
  const RecordedFolder folder;
  const auto fault = [&](const std::string& content) {
    folder.write("f.txt", content);
    return error_of([&] { choose_format(of_file(folder / "f.txt")); });
  };
  EXPECT_NE(fault("").find("is empty"), std::string::npos);
  EXPECT_NE(fault("# t x y z\n").find("no rows"), std::string::npos) << fault("# t x y z\n");
  EXPECT_NE(fault("a b\r1 2\r3 4\r").find("CR alone"), std::string::npos);
  const std::string entity = fault(
      "<?xml version=\"1.0\"?>\n<!DOCTYPE d [<!ENTITY a \"1\">]><Data><GazeData "
      "TimeStamp=\"&a;\"/></Data>\n");
  EXPECT_NE(entity.find("f.txt:2: "), std::string::npos) << entity;
  EXPECT_NE(entity.find("entities"), std::string::npos) << entity;
  const std::string broken = fault("<Data>\n<GazeData TimeStamp=\"1\"></Gaze>\n</Data>\n");
  EXPECT_NE(broken.find("no well-formed XML"), std::string::npos) << broken;
}

TEST(ChooseFormat, NamesTheRoleOfAFileThatHoldsGazeAlone) {
  const RecordedFolder folder;
  folder.write("gaze.csv",
               "timestamp [ns],worn,blink id,azimuth [deg],elevation [deg]\n1700000001000000000,1,,1,2\n");
  folder.write("imu.csv",
               "timestamp [ns],recording id,quaternion w,quaternion x,quaternion y,quaternion z\n"
               "1700000001000000000,a,1,0,0,0\n");
  FormatRequest asked = of_file(folder / "gaze.csv");
  const std::string alone = error_of([&] { choose_format(asked); });
  EXPECT_NE(alone.find("the gaze of preset neon and no head"), std::string::npos) << alone;
  EXPECT_NE(alone.find("--still-head"), std::string::npos) << alone;
  asked.files.gaze = folder / "imu.csv";
  const std::string swapped = error_of([&] { choose_format(asked); });
  EXPECT_NE(swapped.find("the other way around"), std::string::npos) << swapped;
}

TEST(FolderOfARecorder, OneTooHighNamesTheRecordingsInIt) {
  const RecordedFolder folder;
  folder.write("all/a/hmd_poses.csv", "\n");
  const std::string one = error_of([&] { find_recording(folder / "all", "", nullptr); });
  EXPECT_NE(one.find("all/a; name that folder"), std::string::npos) << one;
  folder.write("all/b/ARposes.txt", "\n");
  const std::string two = error_of([&] { find_recording(folder / "all", "", nullptr); });
  EXPECT_NE(two.find("holds several recordings"), std::string::npos) << two;
}

TEST(FolderOfARecorder, OfAMapOfTheUsersIsSearchedByItsLayouts) {
  const RecordedFolder folder;
  ColumnMap map;
  map.layouts.push_back({"*_head.csv", "", {}});
  folder.write("b/1_head.csv", "\n");
  folder.write("b/2_head.csv", "\n");
  EXPECT_NE(error_of([&] { find_recording(folder / "b", "", &map); }).find("several recordings"),
            std::string::npos);
}

}  // namespace
}  // namespace herr::test
