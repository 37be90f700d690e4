// The built-in maps of Project Aria's services and of HOT3D on rows that each test makes by the convention's
// own formulas. The expected numbers are worked out in the comments, in our axes: x right, y up, -z forward.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <string>

#include "tests/sessions/import/presets/preset_import.h"
#include "tests/sessions/import/presets/recorded_heads.h"

namespace herr::test {
namespace {

using AriaPresets = PresetFiles;

// Columns x, y, z of a frame in the central pupil frame, from the CAD's Y and Z.
glm::dmat3 cad(const glm::dvec3& y, const glm::dvec3& z) {
  return {glm::normalize(glm::cross(y, z)), glm::normalize(y), glm::normalize(z)};
}

struct Glasses {
  glm::dmat3 cpf_from_device;
  glm::dvec3 device_in_cpf;
};
// Lines slam-front-left of DVT_SS and camera-slam-left of DVT-S of projectaria_tools' CAD.
const Glasses kGen2{cad({-0.138127, -0.912873, -0.384166}, {0.308866, -0.408244, 0.859034}),
                    {0.067294194, 0.006033819, 0.011768852}};
const Glasses kGen1{cad({0.793353, 0, -0.608761}, {0.607927, -0.052336, 0.792266}),
                    {0.069051, 0.002372, 0.009254}};

// 1 kHz; the head of row i stands at (0.001 i, 1.6, 0) of ours. World z up: (x, y, z) there is (x, z, -y)
// here.
std::string aria_trajectory(const Glasses& glasses, bool with_graph, bool with_gravity) {
  std::string text = with_graph ? "graph_uid," : "";
  text +=
      "tracking_timestamp_us,utc_timestamp_ns,tx_world_device,ty_world_device,tz_world_device,qx_world_"
      "device,"
      "qy_world_device,qz_world_device,qw_world_device,";
  text +=
      with_gravity ? "gravity_x_world,gravity_y_world,gravity_z_world,quality_score\n" : "quality_score\n";
  for (int i = 0; i < 300; ++i) {
    const glm::dmat3 world_from_cpf = recorded(i, kZUp, kLeftUpForward);
    const glm::dvec3 at = glm::dvec3(0.001 * i, 0, 1.6) + world_from_cpf * glasses.device_in_cpf;
    text += (with_graph ? "abcd," : "") + std::to_string(1130889000 + 1000 * i) + ",-1," +
            joined({at.x, at.y, at.z}) + "," + xyzw(world_from_cpf * glasses.cpf_from_device) +
            (with_gravity ? ",0,0,-9.81,1\n" : ",1\n");
  }
  return text;
}

// Without gaze only the data tell the glasses: the head of one placed by the CAD of the other is rolled by
// about 90 degrees. The CAD's six digits leave 1e-6.
TEST_F(AriaPresets, OfAriaTellTheGlassesByTheHorizon) {
  for (const bool gen2 : {false, true})
    for (const bool graph : {false, true}) {
      SCOPED_TRACE(testing::Message() << "gen2 " << gen2 << ", graph and gravity " << graph);
      folder_.write("t.csv", aria_trajectory(gen2 ? kGen2 : kGen1, graph, graph));
      const PresetImport got = import("aria-mps", "t.csv");
      EXPECT_EQ(got.format.format.variant(), gen2 ? "gen2" : "gen1");
      ASSERT_EQ(got.poses.size(), 300u);
      EXPECT_EQ(got.poses[0].stamp_ns, 1130889000000);
      for (const std::size_t i : {0, 150, 299}) {
        expect_near(got.forward(i), forward_of(static_cast<int>(i)), 3e-6);
        expect_near(got.position(i), {0.001 * static_cast<double>(i), 1.6, 0}, 3e-7);
      }
      EXPECT_EQ(got.format.format.columns.head->part.has_value(), graph);
      EXPECT_EQ(got.format.format.columns.head->gravity.has_value(), graph);
    }
}

std::string gen2_gaze(const std::string& angles) {
  std::string text =
      "tracking_timestamp_us,yaw_rads_cpf,pitch_rads_cpf,left_yaw_rads_cpf,right_yaw_rads_cpf,"
      "left_pitch_rads_cpf,right_pitch_rads_cpf,tx_left_eye_cpf,ty_left_eye_cpf,tz_left_eye_cpf,"
      "tx_right_eye_cpf,ty_right_eye_cpf,tz_right_eye_cpf\n";
  for (int i = 0; i < 5; ++i)
    text += std::to_string(1130889351 + 11111 * i) + "," + angles + ",0.0325,0,0,-0.0325,0,0\n";
  return text;
}

// Each eye has a pitch of its own, and yaw is positive to the left: the left eye looks along
// (-tan 0.02, tan -0.25, -1), the right one along (-tan 0.14, tan -0.35, -1).
TEST_F(AriaPresets, OfAriaGen2ReadAPitchForEachEye) {
  folder_.write("t.csv", aria_trajectory(kGen2, true, false));
  folder_.write("g.csv", gen2_gaze("0.08,-0.30,0.02,0.14,-0.25,-0.35"));
  const PresetImport got = import("aria-mps", "t.csv", "g.csv");
  EXPECT_EQ(got.format.format.variant(), "gen2");
  ASSERT_EQ(got.gaze.size(), 5u);
  EXPECT_EQ(got.gaze[0].stamp_ns, 1130889351000);
  expect_near(got.gaze[0].head_direction[0], glm::normalize(glm::dvec3(-std::tan(0.02), std::tan(-0.25), -1)),
              1e-12);
  expect_near(got.gaze[0].head_direction[1], glm::normalize(glm::dvec3(-std::tan(0.14), std::tan(-0.35), -1)),
              1e-12);
}

// The first row of a real file, whose combined ray proves its angles to be spherical: with p = -0.36495319
// and y = 0.01876476 the left eye looks along (-sin y cos p, sin p, -cos y cos p).
TEST_F(AriaPresets, OfAriaGen2TakeSphericalAnglesWhereTheFileProvesThem) {
  folder_.write("t.csv", aria_trajectory(kGen2, true, false));
  folder_.write("g.csv",
                gen2_gaze("0.07778378224032466,-0.36552523325782504,0.01876476162672043,0.13680238223075866,"
                          "-0.3649531942118841,-0.36493456179992734"));
  const PresetImport got = import("aria-mps", "t.csv", "g.csv");
  ASSERT_EQ(got.gaze.size(), 5u);
  const double p = -0.3649531942118841, y = 0.01876476162672043;
  expect_near(got.gaze[0].head_direction[0],
              {-std::sin(y) * std::cos(p), std::sin(p), -std::cos(y) * std::cos(p)}, 1e-12);
}

// Of Gen 1 the eyes share a pitch, or there is one ray.
TEST_F(AriaPresets, OfAriaGen1ReadBothKindsOfGaze) {
  folder_.write("t.csv", aria_trajectory(kGen1, true, true));
  folder_.write("eyes.csv",
                "tracking_timestamp_us,left_yaw_rads_cpf,right_yaw_rads_cpf,pitch_rads_cpf,depth_m\n"
                "1130889000,0.02,0.14,-0.3,0.5\n1130989000,0.02,0.14,-0.3,\n");
  folder_.write("one.csv",
                "tracking_timestamp_us,yaw_rads_cpf,pitch_rads_cpf,depth_m\n"
                "1130889000,0.1,-0.3,\n1130989000,0.1,-0.3,\n");
  const PresetImport eyes = import("aria-mps", "t.csv", "eyes.csv");
  EXPECT_EQ(eyes.format.format.variant(), "gen1");
  ASSERT_EQ(eyes.gaze.size(), 2u);
  expect_near(eyes.gaze[0].head_direction[1], glm::normalize(glm::dvec3(-std::tan(0.14), std::tan(-0.3), -1)),
              1e-12);
  const PresetImport one = import("aria-mps", "t.csv", "one.csv");
  ASSERT_EQ(one.gaze.size(), 2u);
  expect_near(one.gaze[0].head_direction[0], glm::normalize(glm::dvec3(-std::tan(0.1), std::tan(-0.3), -1)),
              1e-12);
}

// Pairs of stamps 91 us apart with one pose, 33 ms between pairs, as both camera groups of Aria write them.
std::string hot3d_table(const glm::dmat3& world, const glm::dmat3& body, const glm::dmat3& body_from_head,
                        bool in_pairs) {
  std::string text = "object_uid,timestamp[ns],t_wo_x[m],t_wo_y[m],t_wo_z[m],q_wo_w,q_wo_x,q_wo_y,q_wo_z\n";
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k < (in_pairs ? 2 : 1); ++k)
      text += "77," + std::to_string(60000000000000 + 33333333LL * i + 91000 * k) + "," +
              joined({0.01 * i, 1.2, 0.1}) + "," + wxyz(recorded(i, world, body) * body_from_head) + "\n";
  return text;
}

TEST_F(AriaPresets, OfHot3dTellTheHeadsetsByTheHorizon) {
  folder_.write("headset_trajectory.csv", hot3d_table(kYUp, kForwardUpRight, glm::dmat3(1.0), false));
  const PresetImport quest = import("hot3d", "headset_trajectory.csv");
  EXPECT_EQ(quest.format.format.variant(), "quest3");
  expect_heads(quest, 40);
  expect_near(quest.position(30), {0.3, 1.2, 0.1}, 1e-9);
  EXPECT_EQ(quest.poses[0].stamp_ns, 60000000000000);

  folder_.write("headset_trajectory.csv", hot3d_table(kZUp, kLeftUpForward, kGen1.cpf_from_device, false));
  const PresetImport aria = import("hot3d", "headset_trajectory.csv");
  EXPECT_EQ(aria.format.format.variant(), "aria");
  ASSERT_EQ(aria.poses.size(), 40u);
  expect_near(aria.forward(20), forward_of(20), 3e-6);
}

TEST_F(AriaPresets, OfHot3dReadPairsOfStamps) {
  folder_.write("headset_trajectory.csv", hot3d_table(kYUp, kForwardUpRight, glm::dmat3(1.0), true));
  const PresetImport got = import("hot3d", "headset_trajectory.csv");
  EXPECT_TRUE(got.poses.size() == 40 || got.poses.size() == 80) << got.poses.size();
  expect_near(got.forward(0), forward_of(0), 1e-7);
}

}  // namespace
}  // namespace herr::test
