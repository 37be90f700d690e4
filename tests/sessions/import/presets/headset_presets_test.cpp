// The built-in maps of headsets and phones on rows that each test makes by the convention's own formulas. The
// expected numbers are worked out in the comments, in our axes: x right, y up, -z forward.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "tests/sessions/import/presets/preset_import.h"

namespace herr::test {
namespace {

using HeadsetPresets = PresetFiles;

// The file's quaternion is ARKit's times a half turn about x. ARKit's camera turned to the left by a is
// (0, sin a/2, 0, cos a/2) as x y z w; times i it is (cos a/2, 0, -sin a/2, 0). It looks along
// (-sin a, 0, -cos a) and is upright.
TEST_F(HeadsetPresets, OfStrayScannerLookLevelAlongTheCamera) {
  std::string table =
      "timestamp, frame, x, y, z, qx, qy, qz, qw, fx, fy, cx, cy, distortion_center_x, distortion_center_y\n";
  for (int i = 0; i < 60; ++i) {
    const double half = glm::radians(0.25 * i);
    char frame[16];
    std::snprintf(frame, sizeof frame, "%06d", i);
    table += joined({86421.5 + i / 60.0}) + ", " + frame + ", " +
             joined({0.002 * i, 1.4, 0.2, std::cos(half), 0, -std::sin(half), 0}, ", ") +
             ", 1600.0, 1600.0, 959.5, 719.5, , \n";
  }
  folder_.write("odometry.csv", table);
  const PresetImport got = import("stray-scanner", "odometry.csv");
  ASSERT_EQ(got.poses.size(), 60u);
  expect_near(got.forward(0), {0, 0, -1}, 1e-6);
  for (const std::size_t i : {0u, 30u, 59u}) {
    const double a = glm::radians(0.5 * static_cast<double>(i));
    expect_near(got.forward(i), {-std::sin(a), 0, -std::cos(a)}, 1e-6);
    expect_near(got.up(i), {0, 1, 0}, 1e-6);
    expect_near(got.position(i), {0.002 * static_cast<double>(i), 1.4, 0.2}, 1e-9);
  }
}

// Row 1: the phone sideways, home button on the right, pitched up by 0.2: (0, sin 0.2, -cos 0.2). Row 2: held
// upright, so that the camera's x points down to the home button: a turn of -90 degrees about z, and the
// camera's up points to the right. The quaternion is w x y z.
TEST_F(HeadsetPresets, OfIosLoggerHaveTheRealPartFirst) {
  const double s = std::sqrt(0.5);
  folder_.write("ARposes.txt", "1600000000.250000,0.100000,0.200000,0.300000," +
                                   joined({std::cos(0.1), std::sin(0.1), 0, 0}) + "\r\n" +
                                   "1600000000.266667,0.100000,0.200000,0.300000," + joined({s, 0, 0, -s}) +
                                   "\r\n");
  const PresetImport got = import("ios-logger", "ARposes.txt");
  ASSERT_EQ(got.poses.size(), 2u);
  EXPECT_EQ(got.poses[0].stamp_ns, 1'600'000'000'250'000'000);
  expect_near(got.position(0), {0.1, 0.2, 0.3}, 1e-12);
  expect_near(got.forward(0), {0, std::sin(0.2), -std::cos(0.2)}, 1e-8);
  expect_near(got.up(0), {0, std::cos(0.2), std::sin(0.2)}, 1e-8);
  expect_near(got.forward(1), {0, 0, -1}, 1e-8);
  expect_near(got.up(1), {1, 0, 0}, 1e-8);
}

// Column 1 and 2 to 17 and 852 to 861 as StreamRecorder writes them, the hands' 834 zeros between.
std::string stream_recorder_row(const std::string& ticks, const glm::dmat3& head, const glm::dvec3& at,
                                const glm::dvec3& gaze_in_head, bool present) {
  std::string row = ticks;
  for (int r = 0; r < 3; ++r) row += "," + joined({head[0][r], head[1][r], head[2][r], at[r]});
  row += ",0,0,0,1";
  for (int i = 0; i < 2 * 417; ++i) row += ",0";
  if (!present) return row + ",0,0,0,0,0,0,0,0,0,0\n";
  return row + ",1," + joined({at.x, at.y, at.z}) + ",1," + unit(head * gaze_in_head) + ",0,1.25\n";
}

// 132812345678901234 is 16367609678901234 units of 100 ns after 1970, which is 116444736000000000 after 1601.
// The head of row i turns to the right by i degrees and looks 5 degrees down: along
// (sin i cos 5, -sin 5, -cos i cos 5). The gaze is the same in the head in every row.
TEST_F(HeadsetPresets, OfHoloLens2BringGazeFromTheWorldIntoTheHead) {
  const glm::dvec3 gaze(0.1, -0.2, -1);
  const double down = glm::radians(5.0);
  std::string table;
  for (int i = 0; i < 20; ++i) {
    const double a = glm::radians(1.0 * i);
    const glm::dvec3 back(-std::sin(a) * std::cos(down), std::sin(down), std::cos(a) * std::cos(down));
    const glm::dvec3 right(std::cos(a), 0, std::sin(a));
    table += stream_recorder_row(std::to_string(132812345678901234 + 333333 * i),
                                 glm::dmat3(right, glm::cross(back, right), back), {0.1, 0.02, -0.3}, gaze,
                                 i != 7);
  }
  folder_.write("log_head_hand_eye.csv", table);
  const PresetImport got = import("hololens2", "log_head_hand_eye.csv");
  ASSERT_EQ(got.poses.size(), 20u);
  ASSERT_EQ(got.gaze.size(), 20u);
  EXPECT_EQ(got.poses[0].stamp_ns, 1'636'760'967'890'123'400);
  expect_near(got.forward(0), {0, -0.0871557, -0.9961947}, 1e-6);
  expect_near(got.position(3), {0.1, 0.02, -0.3}, 1e-9);
  for (std::size_t i = 0; i < 20; ++i) {
    const double a = glm::radians(1.0 * static_cast<double>(i));
    expect_near(got.forward(i),
                {std::sin(a) * std::cos(down), -std::sin(down), -std::cos(a) * std::cos(down)}, 1e-6);
    EXPECT_EQ(got.gaze[i].valid[0], i != 7);
    if (i != 7) expect_near(got.gaze[i].head_direction[0], glm::normalize(gaze), 1e-6);
  }
}

// Varjo's z is forward: (x, y, z) there is (x, y, -z) here. Rows 37 to 45 are lost.
TEST_F(HeadsetPresets, OfVarjoBaseStandStillWhereNoHeadWasRecorded) {
  std::string table =
      "raw_timestamp,stability,status,gaze_forward_x,gaze_forward_y,gaze_forward_z,left_forward_x,left_"
      "forward_y,"
      "left_forward_z,left_status,right_forward_x,right_forward_y,right_forward_z,right_status\n";
  const std::string lost = "-nan(ind),-nan(ind),-nan(ind)";
  for (int i = 0; i < 120; ++i) {
    const std::string stamp = std::to_string(1000900000000000000 + 5000000LL * i);
    if (i >= 37 && i < 46)
      table += stamp + ",0.9,0," + lost + "," + lost + ",0," + lost + ",0\n";
    else
      table += stamp + ",0.9,2," + unit({0, -0.1, 1}) + "," + unit({0.03, -0.1, 1}) +
               (i % 2 ? ",2," : ",3,") + unit({-0.03, -0.1, 1}) + ",2\n";
  }
  folder_.write("varjo_gaze_output.csv", table);
  const PresetImport got = import("varjo-base", "varjo_gaze_output.csv");
  ASSERT_EQ(got.poses.size(), 120u);
  ASSERT_EQ(got.report.assumed.size(), 1u);
  EXPECT_PRED2(holds, got.report.assumed[0], "stands still at the origin");
  EXPECT_EQ(got.valid(0), 111);
  EXPECT_EQ(got.valid(1), 111);
  for (const std::size_t i : {0u, 119u}) {
    EXPECT_EQ(got.poses[i].stamp_ns, 1'000'900'000'000'000'000 + static_cast<TimeNs>(i) * 5'000'000);
    expect_near(got.position(i), {0, 0, 0}, 0);
    expect_near(got.forward(i), {0, 0, -1}, 0);
    expect_near(got.gaze[i].head_direction[0], glm::normalize(glm::dvec3(0.03, -0.1, -1)), 1e-8);
    expect_near(got.gaze[i].head_direction[1], glm::normalize(glm::dvec3(-0.03, -0.1, -1)), 1e-8);
  }
}

// Unity turns by 8 degrees about x: x, y, z of the quaternion are (sin 4, 0, 0) = (0.0697565, 0, 0), w = cos
// 4 is not written. In Unity's left-handed axes a positive turn about x looks down: (0, -sin 8, -cos 8).
TEST_F(HeadsetPresets, OfVarjoLoggersWithoutWTakeItFromTheNorm) {
  folder_.write("varjo_gaze_output.csv",
                "raw_timestamp,HMD_position_x,HMD_position_y,HMD_position_z,HMD_rotation_x,HMD_rotation_y,"
                "HMD_rotation_z,left_forward_x,left_forward_y,left_forward_z,left_status,right_forward_x,"
                "right_forward_y,right_forward_z,right_status\n"
                "1000900000000000000,0.1,1.5,0.2,0.0697565,0,0,0.03,0,0.99955,2,-0.03,0,0.99955,2\n"
                "1000900000011111111,0.1,1.5,0.2,0,0.0871557,0,0.03,0,0.99955,1,-0.03,0,0.99955,3\n");
  const PresetImport got = import("varjo-base", "varjo_gaze_output.csv");
  ASSERT_EQ(got.poses.size(), 2u);
  expect_near(got.forward(0), {0, -0.1391731, -0.9902681}, 1e-6);
  expect_near(got.position(0), {0.1, 1.5, -0.2}, 1e-12);
  // sin 5 about y turns by 10 degrees to the right. Row 2: the left eye is visible and not tracked (1).
  expect_near(got.forward(1), {0.1736482, 0, -0.9848078}, 1e-6);
  EXPECT_FALSE(got.gaze[1].valid[0]);
  EXPECT_TRUE(got.gaze[1].valid[1]);
}

// A logger that prints Varjo's states as words, and the whole quaternion: 10 degrees to the right.
TEST_F(HeadsetPresets, OfVarjoLoggersKnowStatesByName) {
  folder_.write(
      "ET_Data.csv",
      "raw_timestamp,status,left_forward_x,left_forward_y,left_forward_z,left_status,right_forward_x,"
      "right_forward_y,right_forward_z,right_status,hmd_position_x,hmd_position_y,hmd_position_z,"
      "hmd_rotation_x,hmd_rotation_y,hmd_rotation_z,hmd_rotation_w\n"
      "1000900000000000000,Valid,0.03,0,0.99955,Tracked,-0.03,0,0.99955,Compensated,0,1.6,0,"
      "0,0.0871557,0,0.9961947\n"
      "1000900000005000000,Adjust,0.03,0,0.99955,Tracked,-0.03,0,0.99955,Tracked,0,1.6,0,"
      "0,0.0871557,0,-0.9961947\n");
  const PresetImport got = import("varjo-base", "ET_Data.csv");
  ASSERT_EQ(got.poses.size(), 2u);
  expect_near(got.forward(0), {0.1736482, 0, -0.9848078}, 1e-6);
  expect_near(got.forward(1), {-0.1736482, 0, -0.9848078}, 1e-6);  // -w: the opposite turn
  EXPECT_TRUE(got.gaze[0].valid[0] && got.gaze[0].valid[1]);
  EXPECT_FALSE(got.gaze[1].valid[0] || got.gaze[1].valid[1]);  // being calibrated
}

}  // namespace
}  // namespace herr::test
