#include "sessions/import/check/roles/rotation_roles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <string>

#include "sessions/import/check/roles/position_role.h"
#include "tests/sessions/import/check/written_person.h"
#include "tests/sessions/recorded_folder.h"

namespace herr {
namespace {

using namespace test;

struct Found {
  SniffedTable table;
  TimeRole time;
  RotationRoles rotations;
};
Found found_in(const std::string& text) {
  const RecordedFolder folder;
  folder.write("a.csv", text);
  Found found;
  found.table = *sniff_table(folder / "a.csv");
  found.time = find_time(found.table);
  found.rotations = find_rotations(found.table, found.time);
  return found;
}

// Sixty rows at 100 Hz: time, then three numbers, the second of which grows by `step` a row.
std::string three_numbers(const std::string& names, double step) {
  std::string text = "t," + names + "\n";
  for (int i = 0; i < 60; ++i) text += text_of_numbers({0.01 * i, 0.1, step * i, 0.05}) + "\n";
  return text;
}

// 0.1 a row are 10 a second: as radians 573 degrees a second would pass, 0.5 a row (2865) would not.
TEST(RotationRoles, TakesNumbersForDegreesThatWouldBeTooFastInRadians) {
  const Found fast = found_in(three_numbers("rot_x,rot_y,rot_z", 0.11 * 0.9));
  EXPECT_EQ(fast.rotations.questions.size(), 1u);
  const Found faster =
      found_in(three_numbers("rot_x,rot_y,rot_z", 0.1166));  // up to 6.9, at 668 degrees a second
  EXPECT_EQ(faster.rotations.questions.size(), 1u);
  std::string text = "t,rot_x,rot_y,rot_z\n";
  for (int i = 0; i < 60; ++i)
    text += text_of_numbers({0.01 * i, 0.1, std::abs(0.5 * (i % 12) - 3), 0.05}) + "\n";
  const Found degrees = found_in(text);
  ASSERT_EQ(degrees.rotations.roles.size(), 1u);
  EXPECT_TRUE(degrees.rotations.questions.empty());
  EXPECT_EQ(degrees.rotations.roles[0].radians_per_unit, glm::radians(1.0));
}

TEST(RotationRoles, AsksWhatSmallNumbersAre) {
  const Found found = found_in(three_numbers("rot_x,rot_y,rot_z", 0.001));
  ASSERT_EQ(found.rotations.questions.size(), 1u);
  EXPECT_TRUE(holds(found.rotations.questions[0], "a quaternion without w")) << found.rotations.questions[0];
}

TEST(RotationRoles, BelievesAUnitInTheName) {
  const Found found = found_in(three_numbers("rot_x [rad],rot_y [rad],rot_z [rad]", 0.001));
  ASSERT_EQ(found.rotations.roles.size(), 1u);
  EXPECT_TRUE(found.rotations.questions.empty());
  EXPECT_EQ(found.rotations.roles[0].radians_per_unit, 1);
}

TEST(RotationRoles, SeesWhetherAMatrixGoesByColumns) {
  const MadeRecording person = made_person(1, 1);
  const auto by = [&](bool columns) {
    return written(person, "", kRightUpBack, kRightUpBack, kRightUpBack, [&](const WrittenPose& row) {
      const glm::dmat3 m = columns ? row.rotation : glm::transpose(row.rotation);
      const glm::dvec3& p = row.position;
      const std::string time = text_of_numbers({row.seconds}) + ",";
      if (columns)
        return time + text_of(m[0]) + ",0," + text_of(m[1]) + ",0," + text_of(m[2]) + ",0," + text_of(p) +
               ",1";
      return time + text_of(m[0]) + "," + text_of_numbers({p.x}) + "," + text_of(m[1]) + "," +
             text_of_numbers({p.y}) + "," + text_of(m[2]) + "," + text_of_numbers({p.z}) + ",0,0,0,1";
    });
  };
  for (const bool columns : {false, true}) {
    const Found found = found_in(by(columns));
    ASSERT_EQ(found.rotations.roles.size(), 1u) << columns;
    EXPECT_EQ(found.rotations.roles[0].kind, RotationKind::matrix_4x4);
    EXPECT_EQ(found.rotations.roles[0].column_major, columns);
  }
}

// Three by three turned round is a rotation too: names with row and column tell, else nothing does.
TEST(RotationRoles, AsksForTheOrderOfABareMatrixOfNine) {
  const MadeRecording person = made_person(1, 1);
  const auto with = [&](const std::string& header) {
    return found_in(
        written(person, header, kRightUpBack, kRightUpBack, kRightUpBack, [&](const WrittenPose& row) {
          const glm::dmat3 m = glm::transpose(row.rotation);
          return text_of_numbers({row.seconds}) + "," + text_of(m[0]) + "," + text_of(m[1]) + "," +
                 text_of(m[2]);
        }));
  };
  EXPECT_EQ(with("").rotations.questions.size(), 1u);
  const Found named = with("t,r11,r12,r13,r21,r22,r23,r31,r32,r33");
  EXPECT_TRUE(named.rotations.questions.empty());
  EXPECT_FALSE(named.rotations.roles.at(0).column_major);
}

// Columns 4 to 7 are a quaternion, w first, exactly of length 1; with the z of the place, at most 0.05, in
// place of its last number, at most 0.03, the four before are one to 0.2 %.
TEST(RotationRoles, TakesTheFourNumbersThatAreNearestToAUnitQuaternion) {
  std::string text = "t,x,y,z,a,b,c,d\n";
  for (int i = 0; i < 60; ++i) {
    const double half = 0.3 * std::sin(0.1 * i), last = 0.03 * std::cos(0.2 * i);
    const double rest = std::sqrt(1 - last * last);
    text += text_of_numbers({0.01 * i, 0.01 * i, 1.6, 0.05 * std::sin(0.07 * i), rest * std::cos(half), 0,
                             rest * std::sin(half), last}) +
            "\n";
  }
  const Found found = found_in(text);
  ASSERT_EQ(found.rotations.roles.size(), 2u);
  for (const RotationRole& role : found.rotations.roles)
    EXPECT_EQ(role.columns, (std::vector<std::size_t>{4, 5, 6, 7}));
  // cos(0.3) = 0.96 at least in the first column, 0.03 at most in the last: w first is tried first.
  EXPECT_EQ(found.rotations.roles[0].kind, RotationKind::quaternion_wxyz);
  EXPECT_EQ(found.rotations.roles[1].kind, RotationKind::quaternion_xyzw);
}

TEST(RotationRoles, FindsForwardAndUp) {
  std::string text = "t,head_forward_x,head_forward_y,head_forward_z,head_up_x,head_up_y,head_up_z\n";
  for (int i = 0; i < 30; ++i)
    text += text_of_numbers({0.01 * i, std::sin(0.1 * i), 0, std::cos(0.1 * i), 0, 1, 0}) + "\n";
  const Found found = found_in(text);
  ASSERT_EQ(found.rotations.roles.size(), 1u);
  EXPECT_EQ(found.rotations.roles[0].kind, RotationKind::forward_up);
  EXPECT_EQ(found.rotations.roles[0].up, (std::vector<std::size_t>{4, 5, 6}));
}

// 160 and more are centimetres; from a start at 0, 90 a second are no metres either.
TEST(PositionRole, TellsTheUnitBySizeAndSpeed) {
  const auto unit = [](double start, double step) {
    std::string text = "t,pos_x,pos_y,pos_z,qx,qy,qz,qw\n";
    for (int i = 0; i < 60; ++i) text += text_of_numbers({0.01 * i, step * i, start, 0, 0, 0, 0, 1}) + "\n";
    const Found found = found_in(text);
    return find_position(found.table, found.rotations.roles.at(0), found.time).metres_per_unit;
  };
  EXPECT_EQ(unit(1.6, 0.01), 1);
  EXPECT_EQ(unit(160, 1), 0.01);
  EXPECT_EQ(unit(1600, 10), 0.001);
  EXPECT_EQ(unit(0, 0.4), 0.01);
}

}  // namespace
}  // namespace herr
