// Made people as loggers of many conventions write them: what is proposed reads back as they were, or is
// asked for.
#include "sessions/import/check/proposal.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/map/column_map.h"
#include "tests/sessions/import/check/written_person.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using namespace test;

const std::string kQuaternions = "time,head_x,head_y,head_z,head_qx,head_qy,head_qz,head_qw";
const std::string kGazeNames = ",gaze_x,gaze_y,gaze_z";

std::string quaternion_line(const WrittenPose& row) {
  return text_of_numbers({row.seconds}) + "," + text_of(row.position) + "," + xyzw_text(row.rotation);
}
std::string gaze_line(const WrittenPose& row) {
  return quaternion_line(row) + "," + text_of(row.gaze);
}

struct Read {
  std::vector<PoseRow> poses;
  std::vector<GazeRow> gaze;
};

class ProposalOf : public ::testing::Test {
 protected:
  Proposal proposal(const std::string& text, const std::string& name = "log.csv") const {
    folder_.write(name, text);
    FormatRequest request;
    request.files.head = folder_ / name;
    return propose_format(request);
  }
  // By the proposed map.
  Read read(const Proposal& proposal, const std::string& name = "log.csv") const {
    Read read;
    FormatRequest request;
    request.files.head = folder_ / name;
    request.map = std::make_shared<const ColumnMap>(parse_column_map(proposal.map_json, "proposed.json"));
    const ChosenFormat chosen = choose_format(request);
    import_rows(import_request(request, chosen.format.columns),
                {[&](const PoseRow& row) { read.poses.push_back(row); },
                 [&](const GazeRow& row) { read.gaze.push_back(row); }});
    return read;
  }
  void expect_read_as(const MadeRecording& person, const Proposal& proposal) const {
    ASSERT_EQ(proposal.certainty, Proposal::Certainty::likely) << all(proposal);
    const Read got = read(proposal);
    ASSERT_EQ(got.poses.size(), person.poses.size());
    for (std::size_t i = 0; i < got.poses.size(); i += 50) {
      const Pose &is = got.poses[i].world_from_head, &was = person.poses[i].world_from_head;
      EXPECT_GT(std::abs(glm::dot(is.orientation, was.orientation)), 1 - 1e-9) << i << "\n" << all(proposal);
      EXPECT_LT(glm::length(is.position - was.position), 1e-6) << i;
    }
  }
  static std::string all(const Proposal& proposal) {
    std::string text;
    for (const std::string& reason : proposal.reasons) text += reason + "\n";
    for (const std::string& question : proposal.questions) text += "? " + question + "\n";
    return text + proposal.map_json;
  }
  static void expect_asked(const Proposal& proposal, const std::string& part) {
    EXPECT_EQ(proposal.certainty, Proposal::Certainty::cannot_tell) << all(proposal);
    std::string questions;
    for (const std::string& question : proposal.questions) questions += question + "\n";
    EXPECT_TRUE(holds(questions, part)) << questions;
  }
  RecordedFolder folder_;
};

TEST_F(ProposalOf, SomeoneWhoWalksTellsUnityFromOpenXr) {
  const MadeRecording person = walking_person(3, 30);
  for (const glm::dmat3& axes : {kRightUpForward, kRightUpBack})
    expect_read_as(person, proposal(written(person, kQuaternions, axes, axes, axes, quaternion_line)));
}

TEST_F(ProposalOf, WithoutWalkingAndGazeTheHandIsAskedFor) {
  const MadeRecording person = made_person(3, 30);
  const Proposal asked = proposal(
      written(person, kQuaternions, kRightUpForward, kRightUpForward, kRightUpForward, quaternion_line));
  expect_asked(asked, "Unity (left-handed, y up) and OpenXR (right-handed, y up)");
  // A draft for whoever answers: it converts nothing before the axes are filled in.
  EXPECT_TRUE(holds(asked.map_json, "quaternion_xyzw"));
  EXPECT_TRUE(holds(asked.map_json, "\"world_axes\": null")) << asked.map_json;
  EXPECT_TRUE(holds(asked.map_json, "\"head_axes\": null")) << asked.map_json;
  EXPECT_FALSE(holds(asked.map_json, "handedness")) << asked.map_json;
  try {
    parse_column_map(asked.map_json, "draft.json");
    FAIL() << "a draft was taken";
  } catch (const InputError& error) {
    EXPECT_TRUE(holds(error.what(), "world_axes is null")) << error.what();
    EXPECT_TRUE(holds(error.what(), "write three of right, left, up, down, forward, back")) << error.what();
  }
}

TEST_F(ProposalOf, FlagsOfUnknownValuesStayOpenInTheDraft) {
  const MadeRecording person = walking_person(3, 30);
  int row = 0;
  const Proposal asked = proposal(written(
      person, kQuaternions + ",head_status", kRightUpForward, kRightUpForward, kRightUpForward,
      [&](const WrittenPose& pose) { return quaternion_line(pose) + "," + std::to_string(row++ % 3); }));
  expect_asked(asked,
               "Which values of 'head_status' mean that the row is good (\"valid\" of the head in the map).");
  EXPECT_TRUE(holds(asked.map_json, "\"valid\": null")) << asked.map_json;
  try {
    parse_column_map(asked.map_json, "draft.json");
    FAIL() << "a draft was taken";
  } catch (const InputError& error) {
    EXPECT_TRUE(holds(error.what(), "head[0].valid is null")) << error.what();
  }
}

// A head that never turns: both spaces fit.
TEST_F(ProposalOf, SpaceOfTheGazeStaysOpenInTheDraft) {
  MadeRecording person = made_person(7, 60);
  for (PoseRow& pose : person.poses) pose.world_from_head.orientation = {1, 0, 0, 0};
  const Proposal asked = proposal(written(person, kQuaternions + kGazeNames, kRightUpForward, kRightUpForward,
                                          kRightUpForward, gaze_line));
  expect_asked(asked, "Whether the gaze is in the head's axes or in the world's");
  EXPECT_TRUE(holds(asked.map_json, "\"space\": null")) << asked.map_json;
}

TEST_F(ProposalOf, EyesThatCounterTheHeadTellTheAxesOfHeadAndGaze) {
  const MadeRecording person = made_person(5, 90);
  struct Axes {
    glm::dmat3 head, gaze;
  };
  for (const Axes& axes : {Axes{kRightUpForward, kRightUpForward}, Axes{kRightUpBack, kRightUpBack},
                           Axes{kRightUpBack, kRightUpForward}, Axes{kRightUpForward, kLeftUpForward}}) {
    const Proposal found =
        proposal(written(person, kQuaternions + kGazeNames, axes.head, axes.head, axes.gaze, gaze_line));
    expect_read_as(person, found);
    const Read got = read(found);
    ASSERT_FALSE(got.gaze.empty());
    // The gaze of the first row is that of the person.
    EXPECT_LT(glm::length(got.gaze[0].head_direction[0] - person.gaze[0].head_direction[0]), 1e-6)
        << all(found);
  }
}

TEST_F(ProposalOf, GazeInTheWorldIsToldFromGazeInTheHead) {
  const MadeRecording person = made_person(7, 60);
  const Proposal found = proposal(
      written(person, kQuaternions + kGazeNames, kRightUpForward, kRightUpForward, kRightUpForward,
              [](const WrittenPose& row) { return quaternion_line(row) + "," + text_of(row.world_gaze); }));
  EXPECT_TRUE(holds(all(found), "The gaze is in the world's axes")) << all(found);
}

TEST_F(ProposalOf, CameraAxesShowByThemselves) {
  const MadeRecording person = made_person(9, 30);
  expect_read_as(person, proposal(written(person, kQuaternions, kRightForwardUp, kRightDownForward,
                                          kRightDownForward, quaternion_line)));
}

TEST_F(ProposalOf, CentimetresAndARotatorAreUnreals) {
  const MadeRecording person = made_person(11, 20);
  // In Unreal's axes the rotation about z by yaw, then y by -pitch, then x by -roll: from the matrix,
  // sin pitch = m20, tan yaw = m10 / m00, tan roll = m21 / m22 with the signs of its left hand.
  const Proposal found =
      proposal(written(person, "Time,HeadX,HeadY,HeadZ,Roll,Pitch,Yaw", kForwardRightUp, kForwardRightUp,
                       kForwardRightUp, [](const WrittenPose& row) {
                         const glm::dmat3& m = row.rotation;
                         const double pitch = std::asin(m[0][2]), yaw = std::atan2(m[0][1], m[0][0]);
                         const double roll = -std::atan2(m[1][2], m[2][2]);
                         const glm::dvec3 cm = row.position * 100.0;
                         return text_of_numbers({row.seconds}) + "," + text_of(cm) + "," +
                                text_of_numbers({glm::degrees(roll), glm::degrees(pitch), glm::degrees(yaw)});
                       }));
  expect_read_as(person, found);
}

// Roll, pitch and yaw in metres are nobody's for certain, and no gaze.
TEST_F(ProposalOf, RollPitchAndYawInMetresAreAskedFor) {
  const MadeRecording person = walking_person(12, 20);
  const Proposal asked = proposal(written(
      person, "stamp,x,y,z,roll,pitch,yaw", kRightForwardUp, kRightForwardUp, kRightForwardUp,
      [](const WrittenPose& row) {
        const glm::dmat3& m = row.rotation;
        return text_of_numbers({row.seconds}) + "," + text_of(row.position) + "," +
               text_of_numbers({glm::degrees(std::atan2(m[1][2], m[2][2])), glm::degrees(-std::asin(m[0][2])),
                                glm::degrees(std::atan2(m[0][1], m[0][0]))});
      }));
  expect_asked(asked, "In which order and sense the angles turn");
  EXPECT_FALSE(holds(all(asked), "gaze")) << all(asked);
}

TEST_F(ProposalOf, TwoAnglesOfTheGazeAreAskedFor) {
  const MadeRecording person = walking_person(13, 20);
  expect_asked(proposal(written(person, kQuaternions + ",gaze_azimuth,gaze_elevation", kRightUpForward,
                                kRightUpForward, kRightUpForward,
                                [](const WrittenPose& row) {
                                  return quaternion_line(row) + "," +
                                         text_of_numbers({glm::degrees(std::atan2(row.gaze.x, row.gaze.z)),
                                                          glm::degrees(std::asin(row.gaze.y))});
                                })),
               "By which formula");
}

TEST_F(ProposalOf, AMatrixWithoutTimeAsksForTheRate) {
  const MadeRecording person = made_person(15, 5);
  expect_asked(proposal(written(person, "", kRightUpBack, kRightUpBack, kRightUpBack,
                                [](const WrittenPose& row) {
                                  const glm::dmat3 m = glm::transpose(row.rotation);
                                  const glm::dvec3& p = row.position;
                                  return text_of(m[0]) + "," + text_of_numbers({p.x}) + "," + text_of(m[1]) +
                                         "," + text_of_numbers({p.y}) + "," + text_of(m[2]) + "," +
                                         text_of_numbers({p.z}) + ",0,0,0,1";
                                })),
               "How many rows a second");
}

TEST_F(ProposalOf, ALogOfGazeAloneStandsStillAndAsksForItsAxes) {
  const MadeRecording person = made_person(17, 5);
  const Proposal asked = proposal(written(
      person, "time,gaze_x,gaze_y,gaze_z", kRightUpBack, kRightUpBack, kRightUpBack,
      [](const WrittenPose& row) { return text_of_numbers({row.seconds}) + "," + text_of(row.gaze); }));
  expect_asked(asked, "Where the axes of the gaze point");
  EXPECT_TRUE(asked.still.head);
}

// Eight columns of bare numbers with commas fit three presets; whether one of them is meant nobody knows.
TEST_F(ProposalOf, ATableThatFitsAPresetByAccidentIsNotTakenForIt) {
  const MadeRecording person = made_person(19, 30);
  const Proposal asked =
      proposal(written(person, "", kRightUpForward, kRightUpForward, kRightUpForward, quaternion_line));
  EXPECT_EQ(asked.preset, "") << all(asked);
  EXPECT_EQ(asked.certainty, Proposal::Certainty::cannot_tell) << all(asked);
}

TEST_F(ProposalOf, AClockThatStartsAgainIsSaid) {
  MadeRecording person = walking_person(21, 20);
  std::string text = written(person, kQuaternions, kRightUpBack, kRightUpBack, kRightUpBack, quaternion_line);
  const std::string again = text.substr(text.find('\n') + 1);
  const Proposal found = proposal(text + again);
  EXPECT_TRUE(holds(all(found), "the clock was reset")) << all(found);
}

TEST_F(ProposalOf, WhatIsNoTableIsAskedFor) {
  expect_asked(proposal("<Data><Row T=\"1\"/><Row T=\"2\"/></Data>\n", "log.xml"), "What the file is");
}

}  // namespace
}  // namespace herr
