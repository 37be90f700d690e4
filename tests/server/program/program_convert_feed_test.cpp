// Five pictures, stamped in every way that there is: each is shown at its own stamp, a pause is a pause.
#include <gtest/gtest.h>

#include "tests/server/program/convert_feed_program.h"
#include "tests/sessions/import/cameras/exif_bytes.h"

namespace herr {
namespace {

constexpr const char* kWalk = "convert walk.txt s --preset tum --camera-hfov 90 ";

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(ConvertFeedProgram, UnixMillisecondsInTheNamesAreTheStamps) {
  std::string poses = "unix_time,ovr_timestamp,pos_x,pos_y,pos_z,rot_x,rot_y,rot_z,rot_w\n";
  for (int ms = 0; ms <= kLengthMs; ms += 10)
    poses += start_plus(ms) + ",512.25," + std::to_string(kMetresPerSecond * 0.001 * ms) + ",1.6,0,0,0,0,1\n";
  folder_.write("quest/hmd_poses.csv", poses);
  std::vector<std::string> names;
  for (const int ms : kFiveMs) names.push_back(start_plus(ms) + ".png");
  write_pictures("quest/left_camera_rgb", names);
  const Outcome got = herr("convert quest s --camera-hfov 90");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  EXPECT_TRUE(holds(got.out, "cam0: 5 frames from 5 pictures; stamps: the names of the files")) << got.out;
  EXPECT_TRUE(holds(got.out, "assumed: cam0: the camera sits at the head's origin")) << got.out;
  expect_five("s");
  expect_shown_at(replayed("s"), kFiveMs);
  // The same without a preset's folder.
  ASSERT_EQ(herr("convert quest/hmd_poses.csv t --camera quest/left_camera_rgb --camera-hfov 90").exit_code,
            0);
  expect_five("t");
  // The median of 33, 33, 1000 and 33 ms.
  EXPECT_NEAR(session_json("t")["cameras"][0]["nominal_hz"], 1000.0 / 33, 1e-9);
}

TEST_F(ConvertFeedProgram, ATableBesideThePicturesGivesTheStamps) {
  std::string nanoseconds = "#timestamp [ns],filename\n", own = "timestamp_ns,filename\n";
  for (int k = 0; k < 5; ++k) {
    const std::string row = start_plus(kFiveMs[static_cast<std::size_t>(k)]) + "000000," +
                            std::string(1, static_cast<char>('a' + k)) + ".png\n";
    nanoseconds += row;
    own.insert(22, row);  // the last first: their order does not matter
  }
  write_nameless_pictures("euroc/data");
  folder_.write("euroc/data.csv", nanoseconds);
  write_nameless_pictures("within");
  folder_.write("within/frames.csv", own);
  for (const char* folder : {"euroc/data", "euroc/data/", "within"}) {
    ASSERT_EQ(herr(std::string(kWalk) + "--overwrite --camera " + folder).exit_code, 0) << folder;
    expect_five("s");
  }
  expect_shown_at(replayed("s"), kFiveMs);
  ASSERT_EQ(herr(std::string(kWalk) + "--overwrite --camera within --camera-stamps euroc/data.csv").exit_code,
            0);
  expect_five("s");
}

TEST_F(ConvertFeedProgram, AMapSaysWhatTheColumnsOfATableAre) {
  std::string table = "camera;taken;picture\n";
  for (int k = 0; k < 5; ++k) {
    std::string taken = seconds(kStartMs + kFiveMs[static_cast<std::size_t>(k)]);
    std::replace(taken.begin(), taken.end(), '.', ',');
    table += "right;1,5;none\nleft;" + taken + ";" + std::string(1, static_cast<char>('a' + k)) + ".raw\n";
  }
  write_nameless_pictures("pictures");
  folder_.write("taken.csv", table);
  folder_.write("map.json", R"({"format_version": 1, "name": "lab",
    "head": [{"separator": "spaces", "header": false, "time": {"column": 1, "unit": "s"},
              "position": {"columns": [2, 3, 4], "unit": "m"}, "orientation": {"quaternion_xyzw": [5, 6, 7, 8]},
              "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]}],
    "camera": [{"separator": ";", "decimal": ",", "time": {"column": "taken", "unit": "s"}, "file": "picture",
                "valid": {"all": [{"column": "camera", "is": "left"}]}}]})");
  const Outcome got = herr(
      "convert walk.txt s --map map.json --camera pictures --camera-stamps taken.csv "
      "--camera-hfov 90 --json");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  const auto cameras = nlohmann::json::parse(got.out)["cameras"];
  EXPECT_EQ(cameras[0]["stamps"], "the table taken.csv");
  EXPECT_EQ(cameras[0]["left_out"], 0);
  expect_five("s");
  expect_shown_at(replayed("s"), kFiveMs);
}

// The walk begins at 15:06:40 UTC, which is 17:06:40 two hours east of Greenwich.
TEST_F(ConvertFeedProgram, ExifGivesTheStampsWhereItHasAZoneOrAnOptionGivesOne) {
  for (int k = 0; k < 5; ++k) {
    const int ms = kFiveMs[static_cast<std::size_t>(k)];
    const std::string date = "2025:06:15 17:06:4" + std::to_string(ms / 1000);
    const std::string fraction = std::to_string(1000 + ms % 1000).substr(1);
    const std::string name = std::string(1, static_cast<char>('a' + k)) + ".png";
    folder_.write(
        "zoned/" + name,
        test::with_exif(picture(k), test::exif_of({{0x9003, date}, {0x9011, "+02:00"}, {0x9291, fraction}})));
    folder_.write("local/" + name,
                  test::with_exif(picture(k), test::exif_of({{0x9003, date}, {0x9291, fraction}})));
  }
  ASSERT_EQ(herr(std::string(kWalk) + "--camera zoned").exit_code, 0);
  EXPECT_EQ(content_of(root() / "s/cam0/data.csv"), rows_at(kFiveMs));
  expect_shown_at(replayed("s"), kFiveMs);
  ASSERT_EQ(herr(std::string(kWalk) + "--overwrite --camera local --camera-zone +02:00").exit_code, 0);
  EXPECT_EQ(content_of(root() / "s/cam0/data.csv"), rows_at(kFiveMs));
  const Outcome unknown = herr(std::string(kWalk) + "--overwrite --camera local");
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_TRUE(holds(unknown.err, "without a zone") && holds(unknown.err, "--camera-zone")) << unknown.err;
  // In the wrong zone they are an hour early: no picture of this walk.
  const Outcome wrong = herr(std::string(kWalk) + "--overwrite --camera local --camera-zone +03:00");
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_TRUE(holds(wrong.err,
                    "local: has no picture of the time in which the head was recorded: the last was "
                    "taken 3598.551 s before the first pose (stamps of EXIF)"))
      << wrong.err;
}

TEST_F(ConvertFeedProgram, TwoCamerasHaveTheirOwnFoldersAndStamps) {
  std::vector<std::string> left, right;
  std::vector<int> right_ms;
  for (const int ms : kFiveMs) {
    left.push_back(start_plus(ms) + ".png");
    right.push_back(start_plus(ms + 7) + ".png");
    right_ms.push_back(ms + 7);
  }
  write_pictures("left", left);
  write_pictures("right", right);
  ASSERT_EQ(herr(std::string(kWalk) + "--camera left --camera right").exit_code, 0);
  expect_five("s", 0);
  EXPECT_EQ(content_of(root() / "s/cam1/data.csv"), rows_at(right_ms));
  EXPECT_EQ(session_json("s")["cameras"].size(), 2u);
}

TEST_F(ConvertFeedProgram, PatternsTellTheCamerasOfOneFolderApart) {
  std::vector<int> right_ms;
  for (int k = 0; k < 5; ++k) {
    const int ms = kFiveMs[static_cast<std::size_t>(k)];
    folder_.write("both/left_" + seconds(kStartMs + ms) + ".png", picture(k));
    folder_.write("both/right_" + seconds(kStartMs + ms + 7) + ".png", picture(k, 16, 12));
    right_ms.push_back(ms + 7);
  }
  ASSERT_EQ(herr(std::string(kWalk) +
                 "--camera both --camera-names left_{s} --camera both --camera-names right_{s}")
                .exit_code,
            0);
  expect_five("s", 0);
  EXPECT_EQ(content_of(root() / "s/cam1/data.csv"), rows_at(right_ms));
  EXPECT_EQ(content_of(root() / "s/cam1/data/000004.png"), picture(4, 16, 12));
  const Outcome mixed = herr(std::string(kWalk) + "--overwrite --camera both");
  EXPECT_EQ(mixed.exit_code, 3);
  EXPECT_TRUE(holds(mixed.err, "keep pictures of one size in a folder")) << mixed.err;
}

TEST_F(ConvertFeedProgram, AssumedStampsAreSaidEverywhere) {
  write_nameless_pictures("pictures");
  const std::string sentence =
      "stamps of pictures, which were not recorded: 20 pictures a second from the first pose on";
  const Outcome text = herr(std::string(kWalk) + "--camera pictures --camera-hz 20");
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_TRUE(holds(text.out, "assumed: cam0: " + sentence)) << text.out;
  EXPECT_EQ(content_of(root() / "s/cam0/data.csv"), rows_at({0, 50, 100, 150, 200}));
  const auto report = nlohmann::json::parse(
      herr(std::string(kWalk) + "--overwrite --camera pictures --camera-hz 20 --json").out);
  EXPECT_EQ(report["assumed"][0], "cam0: " + sentence);
  EXPECT_EQ(session_json("s")["conversion"]["assumed"][0], "cam0: " + sentence);
  EXPECT_TRUE(holds(herr("inspect s").out, "cam0: " + sentence));
  EXPECT_EQ(nlohmann::json::parse(herr("inspect s --json").out)["session"]["conversion"]["assumed"][0],
            "cam0: " + sentence);
}

TEST_F(ConvertFeedProgram, ARateSetsAsideWhatTheNamesSayAndSaysSo) {
  std::vector<std::string> names;
  for (const int ms : kFiveMs) names.push_back(start_plus(ms) + ".png");
  write_pictures("pictures", names);
  const Outcome got = herr(std::string(kWalk) + "--camera pictures --camera-hz 2");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  EXPECT_TRUE(holds(got.out, "--camera-hz sets aside the stamps of the names of the pictures")) << got.out;
  // Half a second apart, the fifth would be 0.4 s after the end.
  EXPECT_EQ(content_of(root() / "s/cam0/data.csv"), rows_at({0, 500, 1000, 1500}));
  EXPECT_TRUE(holds(got.out, "the last 1 of 5 pictures are not used: the poses end before them")) << got.out;
}

TEST_F(ConvertFeedProgram, PicturesThatSayNoTimeAreRefusedWithAllThatCouldSayIt) {
  write_nameless_pictures("pictures");
  const Outcome got = herr(std::string(kWalk) + "--camera pictures");
  EXPECT_EQ(got.exit_code, 3);
  for (const char* part : {"pictures: says nowhere when its pictures were taken", "--camera-stamps",
                           "--camera-names", "--camera-hz"})
    EXPECT_TRUE(holds(got.err, part)) << part << "\n" << got.err;
  // A table that names other pictures is passed over, and named.
  folder_.write("pictures/data.csv", "#timestamp [ns],filename\n1750000000350000000,x.png\n");
  const Outcome other = herr(std::string(kWalk) + "--camera pictures");
  EXPECT_TRUE(holds(other.err, "data.csv beside them names 'x.png'")) << other.err;
  EXPECT_FALSE(fs::exists(root() / "s"));
}

TEST_F(ConvertFeedProgram, ALoopNeedsARateAndAnOffsetMovesEveryStamp) {
  std::vector<std::string> names;
  std::vector<int> early;
  for (const int ms : kFiveMs) {
    names.push_back(start_plus(ms) + ".png");
    early.push_back(ms - 40);
  }
  write_pictures("pictures", names);
  const Outcome loop = herr(std::string(kWalk) + "--camera pictures --camera-loop");
  EXPECT_EQ(loop.exit_code, 2);
  EXPECT_TRUE(holds(loop.err, "--camera-loop: pictures with stamps of their own cannot be looped"))
      << loop.err;
  ASSERT_EQ(herr(std::string(kWalk) + "--camera pictures --camera-offset-ms -40").exit_code, 0);
  EXPECT_EQ(content_of(root() / "s/cam0/data.csv"), rows_at(early));
  ASSERT_EQ(herr(std::string(kWalk) +
                 "--overwrite --camera pictures --camera-hz 4 --camera-loop --camera-offset-ms 100")
                .exit_code,
            0);
  const std::string looped = content_of(root() / "s/cam0/data.csv");
  EXPECT_EQ(lines_in(looped), 1 + 7);  // 100, 350, ... 1600
  EXPECT_TRUE(holds(looped, start_plus(1350) + "000000,000000.png")) << looped;
  const Outcome beyond =
      herr(std::string(kWalk) + "--overwrite --camera pictures --camera-hz 4 --camera-offset-ms 9000");
  EXPECT_EQ(beyond.exit_code, 3);
  EXPECT_TRUE(holds(beyond.err, "check --camera-offset-ms")) << beyond.err;
}

// A clock that starts 2.35 s before zero: every stream moves by the same 3 s.
TEST_F(ConvertFeedProgram, NegativeStampsMoveThePicturesWithThePoses) {
  write_walk("early.txt", -2350);
  write_nameless_pictures("pictures");
  std::string table = "#timestamp [ns],filename\n";
  for (int k = 0; k < 5; ++k)
    table += std::to_string((-2350 + kFiveMs[static_cast<std::size_t>(k)]) * 1'000'000LL) + "," +
             std::string(1, static_cast<char>('a' + k)) + ".png\n";
  folder_.write("pictures/data.csv", table);
  const Outcome got = herr("convert early.txt s --preset tum --camera pictures --camera-hfov 90 --json");
  ASSERT_EQ(got.exit_code, 0) << got.err;
  const std::int64_t shift_ns = nlohmann::json::parse(got.out)["shift_ns"];
  EXPECT_EQ(shift_ns, 3'000'000'000);
  EXPECT_EQ(content_of(root() / "s/cam0/data.csv"), rows_at(kFiveMs, 650));
  EXPECT_TRUE(content_of(root() / "s/pose/data.csv").find("\n650000000,") != std::string::npos);
}

TEST_F(ConvertFeedProgram, PicturesOfAnotherTimeAreRefusedOrSaid) {
  write_nameless_pictures("pictures");
  // Seconds since the camera was switched on.
  std::string other = "#timestamp [ns],filename\n", partly = other;
  for (int k = 0; k < 5; ++k) {
    const std::string name = "," + std::string(1, static_cast<char>('a' + k)) + ".png\n";
    other += std::to_string(kFiveMs[static_cast<std::size_t>(k)] * 1'000'000LL) + name;
    partly += start_plus(1200 + 200 * k) + "000000" + name;  // 1.2, 1.4, 1.6; 1.8, 2.0
  }
  folder_.write("pictures/data.csv", other);
  const Outcome refused = herr(std::string(kWalk) + "--camera pictures");
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_TRUE(holds(refused.err, "pictures: has no picture of the time in which the head was recorded"))
      << refused.err;
  EXPECT_TRUE(holds(refused.err, "--camera-offset-ms")) << refused.err;
  EXPECT_FALSE(fs::exists(root() / "s"));
  folder_.write("pictures/data.csv", partly);
  const Outcome said = herr(std::string(kWalk) + "--camera pictures");
  ASSERT_EQ(said.exit_code, 0) << said.err;
  EXPECT_TRUE(holds(said.out,
                    "2 of 5 pictures were taken before the first pose or after the last one: from "
                    "1.200 s to 2.000 s after the first pose, the last of which is at 1.600 s"))
      << said.out;
}

TEST_F(ConvertFeedProgram, MoreThanATwentiethWithoutAStampIsAPartialResult) {
  write_nameless_pictures("pictures");
  std::string table = "#timestamp [ns],filename\n";
  for (int k = 0; k < 4; ++k)
    table += start_plus(kFiveMs[static_cast<std::size_t>(k)]) + "000000," +
             std::string(1, static_cast<char>('a' + k)) + ".png\n";
  folder_.write("pictures/data.csv", table);
  const Outcome got = herr(std::string(kWalk) + "--camera pictures");
  EXPECT_EQ(got.exit_code, 5);
  EXPECT_EQ(got.err, "herr: pictures: 1 of 5 pictures are not in the session: 1 without a stamp\n");
  EXPECT_TRUE(
      holds(got.out, "1 of 5 pictures have no stamp in data.csv and are left out (the first is 'e.png')"))
      << got.out;
  const auto left_out = session_json("s")["conversion"]["left_out"][0];
  EXPECT_EQ(left_out["stream"], "cam0");
  EXPECT_EQ(left_out["rows"], 1);
  EXPECT_EQ(left_out["of"], 5);
  // 1 of 25 is less than a twentieth.
  table = "#timestamp [ns],filename\n";
  for (int k = 0; k < 25; ++k) {
    const std::string name = "p" + std::to_string(k) + ".png";
    folder_.write("many/" + name, picture(0));
    if (k > 0) table += start_plus(40 * k) + "000000," + name + "\n";
  }
  folder_.write("many/data.csv", table);
  const Outcome most = herr(std::string(kWalk) + "--overwrite --camera many");
  EXPECT_EQ(most.exit_code, 0);
  EXPECT_EQ(most.err, "");
}

TEST_F(ConvertFeedProgram, TheDistanceOfTheFeedIsKeptAndShown) {
  std::vector<std::string> names;
  for (const int ms : kFiveMs) names.push_back(start_plus(ms) + ".png");
  write_pictures("pictures", names);
  ASSERT_EQ(herr(std::string(kWalk) + "--camera pictures --feed-distance 0.75").exit_code, 0);
  EXPECT_EQ(session_json("s")["feed_distance_m"], 0.75);
  expect_shown_at(replayed("s"), kFiveMs, 0.75);
  expect_shown_at(replayed("s", "--feed-distance 3"), kFiveMs, 3);
  EXPECT_TRUE(holds(herr("inspect s").out, "seen 0.75 m from the displayed eye"));
  EXPECT_EQ(nlohmann::json::parse(herr("inspect s --json").out)["session"]["feed_distance_m"], 0.75);
}

}  // namespace
}  // namespace herr
