// The built-in maps of trajectories and head traces on rows that each test makes by the convention's own
// formulas. The expected numbers are worked out in the comments, in our axes: x right, y up, -z forward.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "tests/sessions/import/presets/preset_import.h"
#include "tests/sessions/import/presets/recorded_heads.h"

namespace herr::test {
namespace {

using TrajectoryPresets = PresetFiles;

std::string euroc_table(const glm::dmat3& world, const glm::dmat3& body, const std::string& rest,
                        const std::string& line_end = "\n") {
  std::string text =
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []" +
      line_end;
  for (int i = 0; i < 200; ++i)
    text += std::to_string(1520530308199447626 + 8333333LL * i) + "," + joined({0.005 * i, 0.2, 1.4}) + "," +
            wxyz(recorded(i, world, body)) + rest + line_end;
  return text;
}

TEST_F(TrajectoryPresets, OfEurocTellTheBodiesByTheHorizon) {
  struct Log {
    const char* variant;
    std::string text;
    glm::dvec3 position;  // of row 100, (0.5, 0.2, 1.4) in the file
  };
  const std::string velocity_and_biases = ",0,0,0,-0.002,0.02,0.08,-0.01,0.13,0.06";
  const Log logs[] = {{"euroc", euroc_table(kZUp, kUpRightForward, velocity_and_biases), {0.5, 1.4, -0.2}},
                      {"tumvi", euroc_table(kZUp, kLeftBackUp, ""), {0.5, 1.4, -0.2}},
                      {"y-up", euroc_table(kYUp, kYUp, "", "\r\n"), {0.5, 0.2, 1.4}}};
  for (const Log& log : logs) {
    SCOPED_TRACE(log.variant);
    folder_.write("data.csv", log.text);
    const PresetImport got = import("euroc", "data.csv");
    EXPECT_EQ(got.format.format.variant(), log.variant);
    expect_heads(got, 200);
    EXPECT_EQ(got.poses[0].stamp_ns, 1520530308199447626);
    expect_near(got.position(100), log.position, 1e-9);
  }
}

// TUM-VI's body lies level with y back: without any turn the head looks against the world's y, which is our
// forward, so along (0, 0, 1). It turns by half a degree a row about the vertical, to the left.
TEST_F(TrajectoryPresets, OfTumviLookAgainstTheBodysY) {
  std::string text =
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []\n";
  for (int i = 0; i < 60; ++i) {
    const double half = glm::radians(0.25 * i);
    text += std::to_string(1520530308199447626 + 8333333LL * i) + "," + joined({0.005 * i, 0.2, 1.4}) + "," +
            joined({std::cos(half), 0, 0, std::sin(half)}) + "\n";
  }
  folder_.write("data.csv", text);
  const PresetImport got = import("euroc", "data.csv");
  EXPECT_EQ(got.format.format.variant(), "tumvi");
  ASSERT_EQ(got.poses.size(), 60u);
  expect_near(got.forward(0), {0, 0, 1}, 1e-9);
  expect_near(got.up(0), {0, 1, 0}, 1e-9);
  // 20 degrees to the left of back is towards +x.
  expect_near(got.forward(40), {std::sin(glm::radians(20.0)), 0, std::cos(glm::radians(20.0))}, 1e-8);
}

TEST_F(TrajectoryPresets, OfTumFindTheSeparator) {
  for (const std::string separator : {" ", "  ", "\t", ","}) {
    SCOPED_TRACE(separator);
    std::string text = "# timestamp tx ty tz qx qy qz qw\n";
    for (int i = 0; i < 60; ++i)
      text += std::to_string(1305031102 + i) + ".175" + separator + joined({0.01 * i, 1.5, 0.2}, separator) +
              separator + xyzw(recorded(i, kYUp, kYUp), separator) + "\n";
    folder_.write("t.txt", text);
    const PresetImport got = import("tum", "t.txt");
    expect_heads(got, 60);
    EXPECT_EQ(got.poses[1].stamp_ns, 1305031103175000000);
    expect_near(got.position(50), {0.5, 1.5, 0.2}, 1e-9);
  }
}

std::string matrix_table(const glm::dmat3& world, const glm::dmat3& body, bool turns) {
  std::string text;
  for (int i = 0; i < 60; ++i) {
    const glm::dmat3 r = turns ? recorded(i, world, body) : glm::dmat3(1.0);
    text += joined({r[0][0], r[1][0], r[2][0], 0.01 * i, r[0][1], r[1][1], r[2][1], 1.5, r[0][2], r[1][2],
                    r[2][2], 0, 0, 0, 0, 1},
                   " ") +
            "\n";
  }
  return text;
}

// Row i stands for i / 30 s.
TEST_F(TrajectoryPresets, OfReplicaReadMatricesAtARate) {
  folder_.write("traj.txt", matrix_table(kZUp, kCamera, true));
  const PresetImport replica = import("replica", "traj.txt");
  EXPECT_EQ(replica.format.format.variant(), "replica");
  expect_heads(replica, 60);
  EXPECT_EQ(replica.poses[30].stamp_ns, 1000000000);
  expect_near(replica.position(30), {0.3, 0, -1.5}, 1e-9);

  folder_.write("traj.txt", matrix_table(kYUp, kYUp, false));
  const PresetImport y_up = import("replica", "traj.txt");
  EXPECT_EQ(y_up.format.format.variant(), "y-up");
  ASSERT_EQ(y_up.poses.size(), 60u);
  expect_near(y_up.position(30), {0.3, 1.5, 0}, 1e-9);
  expect_near(y_up.forward(0), {0, 0, -1}, 1e-12);
}

// REP 103, world and body: x forward, y left, z up. Row i stands at (0.01 i, 0, 0.2): forward by 0.01 i, 0.2
// high.
TEST_F(TrajectoryPresets, OfRosReadTopicsOfEveryKind) {
  struct Topic {
    const char* name;
    std::string header;
    bool nanoseconds;  // in one column, after two others
    std::string after_stamp, after_pose;
  };
  const std::string xyz =
      "position.x,P.position.y,P.position.z,P.orientation.x,P.orientation.y,P.orientation.z,P.orientation.w";
  const auto names = [&](const std::string& pose) {
    std::string text = "P." + xyz;
    for (std::size_t at = text.find('P'); at != std::string::npos; at = text.find('P', at + pose.size()))
      text.replace(at, 1, pose);
    return text;
  };
  const std::string transform =
      "T.translation.x,T.translation.y,T.translation.z,T.rotation.x,T.rotation.y,T.rotation.z,T.rotation.w";
  const auto transform_names = [&](const std::string& prefix) {
    std::string text = transform;
    for (std::size_t at = text.find("T."); at != std::string::npos; at = text.find("T.", at + prefix.size()))
      text.replace(at, 1, prefix);
    return text;
  };
  std::string zeros;
  for (int i = 0; i < 36; ++i) zeros += ",0.0";
  const std::string twist = ",0,0,0,0,0,0" + zeros;
  const std::string ros1 = "%time,field.header.seq,field.header.stamp,field.header.frame_id,";
  const std::string bag = "header.stamp.secs,header.stamp.nsecs,header.frame_id,";
  const Topic topics[] = {
      {"ROS 1 PoseStamped", ros1 + names("field.pose") + "\n", true, "map,", ""},
      {"ROS 1 Odometry", ros1 + names("field.pose.pose") + "\n", true, "odom,", ""},
      {"ROS 1 TransformStamped", ros1 + transform_names("field.transform") + "\n", true, "map,", ""},
      {"ROS 2 PoseStamped", "", false, "map,", ""},
      {"ROS 2 PoseWithCovarianceStamped", "", false, "map,", zeros},
      {"ROS 2 Odometry", "", false, "odom,base_link,", zeros + twist},
      {"ROS 2 TransformStamped", "", false, "map,head,", ""},
      {"named columns", bag + names("pose") + "\n", false, "map,", ""},
      {"named columns of Odometry", bag + names("pose.pose") + "\n", false, "map,", ""}};
  for (const Topic& topic : topics) {
    SCOPED_TRACE(topic.name);
    std::string text = topic.header;
    for (int i = 0; i < 60; ++i) {
      const int nanoseconds = 20000000 * i;  // 50 Hz; with 0.95 s the second is full after three rows
      const std::int64_t stamp = 1700000000950000000 + nanoseconds;
      text += topic.nanoseconds
                  ? std::to_string(stamp + 900) + "," + std::to_string(i) + "," + std::to_string(stamp)
                  : std::to_string(stamp / 1000000000) + "," + std::to_string(stamp % 1000000000);
      text += "," + topic.after_stamp + joined({0.01 * i, 0, 0.2}) + "," +
              xyzw(recorded(i, kForwardLeftUp, kForwardLeftUp)) + topic.after_pose + "\n";
    }
    folder_.write("pose.csv", text);
    const PresetImport got = import("ros", "pose.csv");
    expect_heads(got, 60);
    EXPECT_EQ(got.poses[0].stamp_ns, 1700000000950000000);
    EXPECT_EQ(got.poses[3].stamp_ns, 1700000001010000000);
    expect_near(got.position(50), {0, 0.2, -0.5}, 1e-9);
  }
}

// Unity is left-handed: a turn by +a about y goes to the right. Row i has a = 2 i degrees, so it looks along
// (sin a, 0, -cos a); z forward, so -0.02 there is 0.02 here. 21:21:13 in Beijing is 13:21:13 UTC:
// 1481635273 s since 1970.
TEST_F(TrajectoryPresets, OfVideo360ReadDateText) {
  std::string text =
      "Timestamp,PlaybackTime,UnitQuaternion.x,UnitQuaternion.y,UnitQuaternion.z,UnitQuaternion.w,"
      "HmdPosition.x,HmdPosition.y,HmdPosition.z\n";
  for (int i = 0; i < 60; ++i) {
    char stamp[40];
    std::snprintf(stamp, sizeof stamp, "2016-12-13 21:21:13.%03d,0.%03d,", 11 * i, 11 * i);
    const double half = glm::radians(1.0 * i);
    text += stamp + joined({0, std::sin(half), 0, std::cos(half), 0.01, 1.2, -0.02}) + "\n";
  }
  folder_.write("v.csv", text);
  const PresetImport got = import("video360", "v.csv");
  ASSERT_EQ(got.poses.size(), 60u);
  EXPECT_EQ(got.poses[0].stamp_ns, 1481635273000000000);
  EXPECT_EQ(got.poses[1].stamp_ns, 1481635273011000000);
  EXPECT_EQ(got.poses[59].stamp_ns, 1481635273649000000);
  expect_near(got.forward(15), {0.5, 0, -std::sqrt(0.75)}, 1e-8);
  expect_near(got.position(0), {0.01, 1.2, 0.02}, 1e-9);
}

TEST_F(TrajectoryPresets, KnowRealRecordings) {
  if (real_data().empty()) GTEST_SKIP() << "no real recordings";
  const auto variant = [](const std::string& preset, const std::string& name) {
    return choose_format({{real_data() / "sessions" / name, {}}, preset, nullptr, "", {}}).format.variant();
  };
  EXPECT_EQ(variant("euroc", "euroc_gt/V1_01_easy.csv"), "euroc");
  EXPECT_EQ(variant("aria-mps", "aria_mps_gen1/trajectory/closed_loop_trajectory.csv"), "gen1");
}

}  // namespace
}  // namespace herr::test
