// Poses of the head from rows: quaternions and their lengths, positions, inverse poses, bodies, lost rows.
#include "sessions/import/rows/head_reader.h"

#include <gtest/gtest.h>

#include <glm/mat4x4.hpp>

#include "tests/sessions/import/rows/rotation_kinds.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

const HeadColumns kXyzw = head_columns(RotationKind::quaternion_xyzw, "x y z w");

TEST(HeadOfARow, KeepsEveryDigitOfAQuaternionAndItsSign) {
  EXPECT_EQ(read_head(kXyzw, "x y z w", "0 0 0.6 0.8").pose->orientation, glm::dquat(0.8, 0, 0, 0.6));
  EXPECT_EQ(read_head(kXyzw, "x y z w", "0 0 -0.6 -0.8").pose->orientation, glm::dquat(-0.8, 0, 0, -0.6));
  const HeadColumns wxyz = head_columns(RotationKind::quaternion_wxyz, "w x y z");
  EXPECT_EQ(read_head(wxyz, "w x y z", "0.8 0 0.6 0").pose->orientation, glm::dquat(0.8, 0, 0.6, 0));
  EXPECT_EQ(read_head(kXyzw, "x y z w", "0.1 0 0 0.99498743").pose->orientation,
            glm::dquat(0.99498743, 0.1, 0, 0));
}

TEST(HeadOfARow, HasItsQuaternionNormalisedAndCountedByHowFarItIsOff) {
  // Off by 0.001 is rounding; by 0.05 is not and is counted; by 0.2 is another quantity.
  const ReadHead rounded = read_head(kXyzw, "x y z w", "0 0 0 1.001");
  EXPECT_EQ(rounded.pose->orientation, glm::dquat(1, 0, 0, 0));
  EXPECT_EQ(rounded.counts.normalised, 0);
  const ReadHead off = read_head(kXyzw, "x y z w", "0 0 0.63 0.84");
  EXPECT_NEAR(off.pose->orientation.z, 0.6, 1e-15);
  EXPECT_EQ(off.counts.normalised, 1);
  EXPECT_INPUT_ERROR(read_head(kXyzw, "x y z w", "0 0 0 1.2"),
                     "log.csv:2: the quaternion has the length 1.2, not 1; check the columns of the map");
  EXPECT_INPUT_ERROR(
      read_head(kXyzw, "x y z w", "0 0 0 0"),
      "the quaternion has the length 0, not 1; where that means lost tracking, leave such rows out");
  EXPECT_INPUT_ERROR(read_head(kXyzw, "x y z w", "1e300 0 0 0"), "has the length inf, not 1");
}

// Looking down by 8 degrees: half the angle's sine is 0.0697565 about -x; forward is (0, -sin 8, -cos 8).
TEST(HeadOfARow, HasTheFourthNumberOfAQuaternionFromItsLength) {
  const HeadColumns columns = head_columns(RotationKind::quaternion_xyz, "x y z");
  const Pose down = *read_head(columns, "x y z", "-0.06975647374412530 0 0").pose;
  EXPECT_LT(glm::distance(down.orientation * glm::dvec3(0, 0, -1), glm::dvec3(0, -0.139173101, -0.990268069)),
            1e-9);
  EXPECT_NEAR(read_head(columns, "x y z", "0.36 0.48 0").pose->orientation.w, 0.8, 1e-15);
  // A half turn, rounded up: there is nothing left for w.
  const Pose half = *read_head(columns, "x y z", "0.6 0.801 0").pose;
  EXPECT_EQ(half.orientation.w, 0);
  EXPECT_NEAR(glm::length(half.orientation), 1, 1e-15);
  EXPECT_INPUT_ERROR(read_head(columns, "x y z", "0.9 0.8 0"),
                     "x, y and z of the quaternion have the length 1.20416, more than 1, and leave no w");
}

TEST(HeadOfARow, HasItsPositionInMetresWithinReach) {
  HeadColumns columns = kXyzw;
  columns.world_axes = columns.head_axes = *AxisDirections::from_words(kUnity);
  columns.position = group_of("px py pz");
  columns.metres_per_unit = 0.001;
  const std::string names = "x y z w px py pz";
  EXPECT_EQ(read_head(columns, names, "0 0 0 1 1000 -500 250").pose->position, glm::dvec3(1, -0.5, -0.25));
  EXPECT_INPUT_ERROR(read_head(columns, names, "0 0 0 1 0 1e12 0"),
                     "the position is 1e9 m or more from the origin");
  EXPECT_INPUT_ERROR(read_head(columns, names, "0 0 0 1 0 1e300 0"),
                     "the position is 1e9 m or more from the origin");
  columns.position = ColumnGroup{{{"px", 0}}, 3};
  EXPECT_EQ(read_head(columns, names, "0 0 0 1 (1,_2,_3) - -").pose->position, glm::dvec3(1, 2, -3) * 0.001);
}

TEST(HeadOfARow, IsNoneWhereTrackingWasLost) {
  HeadColumns columns = kXyzw;
  columns.position = group_of("px py pz");
  columns.valid.all.push_back({{"ok", 0}, RowCondition::Kind::is, {"1"}, 0, 0});
  const std::string names = "x y z w px py pz ok";
  EXPECT_TRUE(read_head(columns, names, "0 0 0 1 0 0 0 1").pose);
  EXPECT_FALSE(read_head(columns, names, "0 0 0 1 0 0 0 0").pose);
  EXPECT_FALSE(read_head(columns, names, "bad 0 0 1 0 0 0 0").pose);
  EXPECT_FALSE(read_head(columns, names, "0 0 nan 1 0 0 0 1").pose);
  EXPECT_FALSE(read_head(columns, names, "0 0 0 1 0 - 0 1").pose);
  EXPECT_INPUT_ERROR(read_head(columns, names, "bad 0 0 1 0 0 0 1"), "column 'x' is 'bad'");
}

TEST(HeadOfARow, IsTheInverseWhereTheFileHoldsWorldToHead) {
  // World of z up, camera of y down: the file's matrix is [R t], the pose that is wanted W [R t]^-1 B'.
  const glm::dmat3 turn = turn_about(2, 140) * turn_about(1, 70) * turn_about(0, -100);
  glm::dmat4 head_from_world(turn);
  head_from_world[3] = glm::dvec4(0.5, -2, 3, 1);
  const glm::dmat4 world_from_head = glm::inverse(head_from_world);
  HeadColumns columns =
      head_columns(RotationKind::matrix_4x4, "a b c d e f g h i j k l m n o p", kZUp, kCameraDown);
  columns.head_from_world = columns.column_major = true;
  std::vector<double> numbers;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) numbers.push_back(head_from_world[column][row]);
  const Pose pose = *read_head(columns, "a b c d e f g h i j k l m n o p", row_of(numbers)).pose;
  EXPECT_LT(glm::distance(pose.position, ours_from(kZUp) * glm::dvec3(world_from_head[3])), 1e-13);
  const glm::dmat3 wanted =
      ours_from(kZUp) * glm::dmat3(world_from_head) * glm::transpose(ours_from(kCameraDown));
  EXPECT_LT(difference(matrix_of(pose), wanted), 1e-13);
}

TEST(HeadOfARow, SitsInTheRecordedBodyWhereTheMapSays) {
  // By matrices: world_from_head = W (R (r p + P)) with r and p of the map, in a left-handed file.
  HeadColumns columns = head_columns(RotationKind::matrix_3x3, "a b c d e f g h i", kUnity, kUnity);
  columns.position = group_of("px py pz");
  columns.body_from_head = {glm::dvec3(0.1, 0.2, -0.3), glm::angleAxis(0.7, glm::dvec3(0.6, 0, 0.8))};
  const glm::dmat3 turn = turn_about(1, 30) * turn_about(0, 50);
  std::vector<double> numbers;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) numbers.push_back(turn[column][row]);
  const Pose pose = *read_head(columns, "a b c d e f g h i px py pz", row_of(numbers) + " 1 2 3").pose;
  const glm::dmat3 mirror = ours_from(kUnity), fixed = glm::mat3_cast(columns.body_from_head.orientation);
  EXPECT_LT(glm::distance(pose.position, mirror * (turn * glm::dvec3(0.1, 0.2, -0.3) + glm::dvec3(1, 2, 3))),
            1e-14);
  EXPECT_LT(difference(matrix_of(pose), mirror * turn * fixed * mirror), 1e-14);
}

TEST(HeadOfARow, IsLevelAndLooksAheadWhereNoRotationWasRecorded) {
  HeadColumns columns = head_columns(RotationKind::fixed, "", kZUp, kOurs);
  columns.position = group_of("px py pz");
  const Pose pose = *read_head(columns, "px py pz", "1 2 3").pose;
  EXPECT_EQ(pose.orientation, glm::dquat(1, 0, 0, 0));
  EXPECT_EQ(pose.position, glm::dvec3(1, 3, -2));
}

TEST(HeadOfARow, BringsGravityInOurAxes) {
  HeadColumns columns = head_columns(RotationKind::fixed, "", kZUp, kZUp);
  columns.gravity = group_of("gx gy gz");
  columns.part = ColumnRef{"part", 0};
  FakeRows source("gx gy gz", {"0.1 0.2 -9.8", "0 0 0", "0 nan 0"});
  const HeadReader reader(source, columns);
  ASSERT_TRUE(source.next());
  EXPECT_EQ(*reader.gravity(source), glm::dvec3(0.1, -9.8, -0.2));
  ASSERT_TRUE(source.next());
  EXPECT_FALSE(reader.gravity(source));
  ASSERT_TRUE(source.next());
  EXPECT_FALSE(reader.gravity(source));
  const std::vector<ColumnRef> asked = columns_of(columns);
  ASSERT_EQ(asked.size(), 4u);
  EXPECT_EQ(asked.back().name, "part");
}

}  // namespace
}  // namespace herr::test
