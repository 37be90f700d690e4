// Stamps and lenses from tables, as EuRoC, ARKit loggers and Stray Scanner write them.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "sessions/import/cameras/column_lens.h"
#include "sessions/import/cameras/picture_stamps.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using test::RecordedFolder;

constexpr TimeNs kMs = 1'000'000;
// Three within 66 ms, a second's pause, two more.
const std::vector<TimeNs> kFive{1750000000350 * kMs, 1750000000383 * kMs, 1750000000416 * kMs,
                                1750000001416 * kMs, 1750000001449 * kMs};

CameraPictures numbered(const RecordedFolder& folder, int count, const std::string& before = "") {
  for (int i = 1; i <= count; ++i) folder.write_image("cam/" + before + std::to_string(i) + ".png", 4, 3);
  return find_camera_pictures(folder / "cam");
}

CameraColumns milliseconds() {
  CameraColumns columns;
  columns.time.column = {"ms", 0};
  columns.time.unit = TimeUnit::ms;
  return columns;
}

CameraColumns milliseconds_and_file() {
  CameraColumns columns = milliseconds();
  columns.file = ColumnRef{"file", 0};
  return columns;
}

std::vector<TimeNs> stamps_in(const StampedPictures& stamped) {
  std::vector<TimeNs> stamps;
  for (const StampedPicture& picture : stamped.pictures) stamps.push_back(picture.stamp_ns);
  return stamps;
}

std::vector<std::string> stems_in(const StampedPictures& stamped) {
  std::vector<std::string> stems;
  for (const StampedPicture& picture : stamped.pictures) stems.push_back(picture.file.stem().string());
  return stems;
}

TEST(TableStamps, FiveRowsNameFivePicturesInAnyOrderAndForm) {
  const RecordedFolder folder;
  const CameraPictures pictures = numbered(folder, 5);
  folder.write("frames.csv",
               "ms,file\n1750000000383,rgb/2.png\n1750000000350,C:\\data\\1.jpg\n1750000000416,3\n"
               "1750000001416,000004\n1750000001449,5.png\n");
  const StampedPictures stamped = stamps_from_table(pictures, folder / "frames.csv", milliseconds_and_file());
  EXPECT_EQ(stamps_in(stamped), kFive);
  EXPECT_EQ(stems_in(stamped), (std::vector<std::string>{"1", "2", "3", "4", "5"}));
  EXPECT_EQ(stamped.source, "the table frames.csv");
  EXPECT_TRUE(stamped.remarks.empty());
}

TEST(TableStamps, RowsWithoutNamesBelongToPicturesInNaturalOrder) {
  const RecordedFolder folder;
  const CameraPictures pictures = numbered(folder, 5, "frame_");
  folder.write("t.csv", "ms\n1750000000350\n1750000000383\n1750000000416\n1750000001416\n1750000001449\n");
  const StampedPictures stamped = stamps_from_table(pictures, folder / "t.csv", milliseconds());
  EXPECT_EQ(stamps_in(stamped), kFive);
  EXPECT_EQ(stamped.assumed,
            std::vector<std::string>{"row by row, t.csv stamps the pictures in the order of their names"});
  folder.write("t.csv", "ms\n1750000000350\n1750000000383\n");
  EXPECT_INPUT_ERROR(stamps_from_table(pictures, folder / "t.csv", milliseconds()),
                     "t.csv: has 2 rows, and ");
  EXPECT_INPUT_ERROR(stamps_from_table(pictures, folder / "t.csv", milliseconds()), "holds 5 pictures");
}

// data.csv of EuRoC: a header line with #, nanoseconds, names of the stamps.
// 1750000000 s is 2025-06-15 15:06:40 UTC (date -u -d @1750000000).
TEST(TableStamps, DatesWithoutAZoneAreSaidToBeTakenAsUtc) {
  const RecordedFolder folder;
  const CameraPictures pictures = numbered(folder, 2);
  CameraColumns columns = milliseconds_and_file();
  columns.time.kind = TimeColumns::Kind::date;
  columns.time.column = {"when", 0};
  const auto read = [&](const std::string& zone) {
    folder.write("t.csv",
                 "when,file\n2025-06-15T15:06:40.350" + zone + ",1\n2025-06-15T15:06:40.383" + zone + ",2\n");
    return stamps_from_table(pictures, folder / "t.csv", columns);
  };
  const StampedPictures utc = read("");
  EXPECT_EQ(stamps_in(utc), (std::vector<TimeNs>{kFive[0], kFive[1]}));
  EXPECT_EQ(utc.assumed, std::vector<std::string>{"the dates in t.csv name no zone and are taken as UTC"});
  EXPECT_TRUE(read("Z").assumed.empty());
  columns.time.zone_minutes = 60;
  const StampedPictures east = read("");
  EXPECT_TRUE(east.assumed.empty());
  EXPECT_EQ(kFive[0] - stamps_in(east)[0], 3'600'000 * kMs);
}

TEST(TableStamps, ARateIsSaidToBeAssumed) {
  const RecordedFolder folder;
  const CameraPictures pictures = numbered(folder, 3);
  CameraColumns columns = milliseconds_and_file();
  columns.time = {};
  columns.time.kind = TimeColumns::Kind::rate;
  columns.time.rate_hz = 20;
  folder.write("t.csv", "file\n1\n2\n3\n");
  const StampedPictures stamped = stamps_from_table(pictures, folder / "t.csv", columns);
  EXPECT_EQ(stamps_in(stamped), (std::vector<TimeNs>{0, 50 * kMs, 100 * kMs}));
  EXPECT_EQ(
      stamped.assumed,
      std::vector<std::string>{"stamps of pictures, which were not recorded: 20 a second, as the map says"});
}

TEST(TableStamps, EurocsTableIsOne) {
  const RecordedFolder folder;
  folder.write_image("cam/1403636579763555584.png", 4, 3);
  folder.write_image("cam/1403636579813555456.png", 4, 3);
  folder.write("data.csv",
               "#timestamp [ns],filename\n1403636579763555584,1403636579763555584.png\n"
               "1403636579813555456,1403636579813555456.png\n");
  CameraColumns columns;
  columns.table.header = false;
  columns.table.comment = "#";
  columns.time.column = {"", 1};
  columns.time.unit = TimeUnit::ns;
  columns.file = ColumnRef{"", 2};
  const StampedPictures stamped =
      stamps_from_table(find_camera_pictures(folder / "cam"), folder / "data.csv", columns);
  EXPECT_EQ(stamps_in(stamped), (std::vector<TimeNs>{1403636579763555584, 1403636579813555456}));
}

TEST(TableStamps, WhatHasNoPartnerIsLeftOutAndSaid) {
  const RecordedFolder folder;
  const CameraPictures pictures = numbered(folder, 4);
  folder.write("t.csv", "ms,file\n10,1.png\n20,7.png\n30,2.png\n30,3.png\n40,1.png\n,4.png\n");
  const StampedPictures stamped = stamps_from_table(pictures, folder / "t.csv", milliseconds_and_file());
  EXPECT_EQ(stems_in(stamped), (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(stamped.without_stamp, 1);
  EXPECT_EQ(stamped.repeated_stamps, 1);
  EXPECT_EQ(stamped.rows_without_picture, 2);
  EXPECT_EQ(
      stamped.remarks,
      (std::vector<std::string>{
          "1 of 5 rows of t.csv name no picture of the folder and are left out (the first is '7.png', line "
          "3)",
          "1 of 5 rows of t.csv name a picture that an earlier row names and are left out",
          "1 of 4 pictures have no stamp in t.csv and are left out (the first is '4.png')",
          "1 of 4 pictures repeat the stamp of another and are left out ('3.png' has that of '2.png')"}));
}

TEST(TableStamps, ATableOfAnotherCameraIsRefused) {
  const RecordedFolder folder;
  const CameraPictures pictures = numbered(folder, 2, "left_");
  folder.write("t.csv", "ms,file\n10,right_1.png\n20,right_2.png\n");
  EXPECT_INPUT_ERROR(stamps_from_table(pictures, folder / "t.csv", milliseconds_and_file()),
                     "t.csv:2: names 'right_1.png', and no row of the table names a picture of ");
  folder.write("t.csv", "ms,file\n10,1\n");
  folder.write_image("cam/right_1.png", 4, 3);
  folder.write_image("cam/right_2.png", 4, 3);
  EXPECT_INPUT_ERROR(
      stamps_from_table(find_camera_pictures(folder / "cam"), folder / "t.csv", milliseconds_and_file()),
      "t.csv:2: names picture 1, and both 'left_1.png' and 'right_1.png' hold that number");
}

// frames.csv of several cameras: the rows of one.
TEST(TableStamps, RowsOfOtherCamerasAreOfNoConcern) {
  const RecordedFolder folder;
  const CameraPictures pictures = numbered(folder, 2);
  folder.write("t.csv", "camera,ms,file\nrgb,10,1.png\nslam,11,a.png\nrgb,20,2.png\nslam,21,b.png\n");
  CameraColumns columns = milliseconds_and_file();
  columns.valid.all = {{{"camera", 0}, RowCondition::Kind::is, {"rgb"}, 0, 0}};
  const StampedPictures stamped = stamps_from_table(pictures, folder / "t.csv", columns);
  EXPECT_EQ(stamps_in(stamped), (std::vector<TimeNs>{10 * kMs, 20 * kMs}));
  EXPECT_EQ(stamped.rows_without_picture, 0);
}

// The colour pictures of Aria glasses: names and table tell the same times, the names to a microsecond.
TEST(TableStamps, NamesAndTableOfARealRecordingAgree) {
  if (test::real_data().empty()) GTEST_SKIP() << "no real recordings";
  const std::filesystem::path from = test::real_data() / "frames" / "aria_aea";
  const RecordedFolder folder;
  std::filesystem::create_directories(folder / "cam");
  for (const auto& entry : std::filesystem::directory_iterator(from))
    if (entry.path().filename().string().starts_with("214-1_"))
      std::filesystem::copy_file(entry.path(), folder / "cam" / entry.path().filename());
  const CameraPictures pictures = find_camera_pictures(folder / "cam");
  CameraColumns columns;
  columns.time.column = {"vrs_timestamp_s", 0};
  columns.time.unit = TimeUnit::s;
  columns.file = ColumnRef{"file", 0};
  columns.valid.all = {{{"stream_id", 0}, RowCondition::Kind::is, {"214-1"}, 0, 0}};
  const std::vector<TimeNs> table = stamps_in(stamps_from_table(pictures, from / "frames.csv", columns));
  const std::vector<TimeNs> names = stamps_in(stamps_from_names(pictures, "214-1_{s}"));
  ASSERT_EQ(table.size(), 8u);
  EXPECT_EQ(table[0], 86385246037);  // the first row of the table
  ASSERT_EQ(names.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_LE(std::abs(table[i] - names[i]), 500) << i;
}

CameraColumns lens_columns() {
  CameraColumns columns;
  columns.lens = {{"fx", 0}, {"fy", 0}, {"cx", 0}, {"cy", 0}};
  return columns;
}

TEST(ColumnLens, TheMedianStandsForAllPicturesAndAChangeIsSaid) {
  const RecordedFolder folder;
  folder.write("odometry.csv",
               "frame, fx, fy, cx, cy\n0, 1600, 1602, 959.5, 719.5\n1, 1604, 1602, 959.5, 719.5\n"
               "2, 1608, 1602, 959.5, 719.5\n3, , , , \n");
  const ColumnLens steady = lens_from_columns(folder / "odometry.csv", lens_columns(), {1920, 1440});
  EXPECT_EQ(steady.model.kind, CameraModelKind::pinhole);
  EXPECT_EQ(steady.model.fx, 1604);
  EXPECT_EQ(steady.model.fy, 1602);
  EXPECT_EQ(steady.model.cx, 959.5);
  EXPECT_EQ(steady.model.width_px, 1920);
  EXPECT_GT(steady.model.max_angle_rad, 0.5);
  EXPECT_TRUE(steady.remarks.empty());  // 8 of 1604 pixels are 0.5 %
  folder.write("odometry.csv", "frame,fx,fy,cx,cy\n0,1600,1600,959.5,719.5\n1,1648,1600,959.5,719.5\n");
  const ColumnLens focusing = lens_from_columns(folder / "odometry.csv", lens_columns(), {1920, 1440});
  ASSERT_EQ(focusing.remarks.size(), 1u);
  EXPECT_PRED2(test::holds, focusing.remarks[0], "fx by 3 %");  // 48 of 1648 or 1600
}

TEST(ColumnLens, NumbersForPicturesOfAnotherSizeAreRefused) {
  const RecordedFolder folder;
  folder.write("odometry.csv", "fx,fy,cx,cy\n1600,1600,959.5,719.5\n");
  EXPECT_INPUT_ERROR(lens_from_columns(folder / "odometry.csv", lens_columns(), {960, 720}),
                     "has a lens whose middle is at (960, 720), and the pictures are 960x720");
  folder.write("odometry.csv", "fx,fy,cx,cy\n,,,\n");
  EXPECT_INPUT_ERROR(lens_from_columns(folder / "odometry.csv", lens_columns(), {1920, 1440}),
                     "has no row with a lens");
}

}  // namespace
}  // namespace herr
