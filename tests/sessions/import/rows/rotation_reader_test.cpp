// Rotations as files hold them: angles, matrices, rotation vectors, forward and up.
#include "sessions/import/rows/rotation_reader.h"

#include <gtest/gtest.h>

#include "tests/sessions/import/rows/rotation_kinds.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

const std::string kLetters = "a b c d e f g h i j k l m n o p";
constexpr std::size_t kSide[3][2] = {{3, 3}, {3, 4}, {4, 4}};  // height and width of the three matrices
constexpr RotationKind kMatrices[] = {RotationKind::matrix_3x3, RotationKind::matrix_3x4,
                                      RotationKind::matrix_4x4};

std::string letters(std::size_t count) {
  return kLetters.substr(0, 2 * count - 1);
}

// The numbers of a matrix of height x width.
std::vector<double> numbers_of(const glm::dmat3& turn, const glm::dvec3& position, std::size_t height,
                               std::size_t width, bool column_major) {
  glm::dmat4 whole(turn);
  whole[3] = glm::dvec4(position, 1);
  std::vector<double> numbers(height * width);
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t column = 0; column < width; ++column)
      numbers[column_major ? column * height + row : row * width + column] =
          whole[static_cast<int>(column)][static_cast<int>(row)];
  return numbers;
}

HeadColumns matrix_columns(RotationKind kind, bool column_major, const Words& world = kOurs,
                           const Words& head = kOurs) {
  const std::size_t count = kind == RotationKind::matrix_3x3 ? 9 : kind == RotationKind::matrix_3x4 ? 12 : 16;
  HeadColumns columns = head_columns(kind, letters(count), world, head);
  columns.column_major = column_major;
  return columns;
}

std::string error_of_rows(const HeadColumns& columns, const std::vector<double>& numbers) {
  return error_of([&] { read_head(columns, letters(columns.rotation.numbers), row_of(numbers)); });
}

ReadHead read_3x3(const glm::dmat3& m) {
  return read_head(matrix_columns(RotationKind::matrix_3x3, false), letters(9),
                   row_of(numbers_of(m, glm::dvec3(0), 3, 3, false)));
}

TEST(RotationsOfRows, AreAnglesInAnyOrderWithASenseEach) {
  for (const std::string order : {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"})
    for (int signs = 0; signs < 8; ++signs) {
      HeadColumns columns = head_columns(RotationKind::euler_xyz, "rx ry rz");
      columns.radians_per_unit = glm::radians(1.0);
      columns.euler_order = order;
      const double angles[] = {20, -35, 130};
      glm::dmat3 wanted(1.0);
      for (int axis = 0; axis < 3; ++axis)
        columns.euler_sense[static_cast<std::size_t>(axis)] = signs >> axis & 1 ? -1 : 1;
      for (const char letter : order)
        wanted = turn_about(letter - 'x', angles[letter - 'x'] *
                                              columns.euler_sense[static_cast<std::size_t>(letter - 'x')]) *
                 wanted;
      const Pose pose = *read_head(columns, "rx ry rz", "20 -35 130").pose;
      EXPECT_LT(difference(matrix_of(pose), wanted), 1e-14) << order << ' ' << signs;
    }
}

// An Unreal rotator in a left-handed frame (x forward, y right, z up): roll about x, then pitch about y, then
// yaw about z. Turning x to y is to the right, as positive yaw; turning z to x is down and y to z leans left,
// against positive pitch and roll. Yaw 20 and pitch 10 look along (cos 10 cos 20, cos 10 sin 20, sin 10) =
// (forward 0.925, right 0.337, up 0.174).
TEST(RotationsOfRows, AreUnrealsRollPitchYaw) {
  HeadColumns columns = head_columns(RotationKind::euler_xyz, "Roll Pitch Yaw", kUnreal, kUnreal);
  columns.radians_per_unit = glm::radians(1.0);
  columns.euler_order = "xyz";
  columns.euler_sense = {-1, -1, 1};
  const Pose pose = *read_head(columns, "Roll Pitch Yaw", "5 10 20").pose;
  EXPECT_LT(
      glm::distance(pose.orientation * glm::dvec3(0, 0, -1), glm::dvec3(0.33682409, 0.17364818, -0.92541658)),
      1e-8);
  // Leaning right by 5 degrees tips the top of a level head to the right.
  const Pose leans = *read_head(columns, "Roll Pitch Yaw", "5 0 0").pose;
  EXPECT_LT(glm::distance(leans.orientation * glm::dvec3(0, 1, 0), glm::dvec3(0.08715574, 0.99619470, 0)),
            1e-8);
  const Pose right = *read_head(columns, "Roll Pitch Yaw", "0 0 90").pose;
  EXPECT_LT(glm::distance(right.orientation * glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0)), 1e-15);
}

TEST(RotationsOfRows, AreMatricesOfEverySizeByRowsAndColumnsInEveryFrame) {
  const std::pair<Words, Words> frames[] = {
      {kOurs, kOurs}, {kUnity, kUnity}, {kUnreal, kUnity}, {kZUp, kCameraDown}};
  for (const auto& [world, head] : frames)
    for (int size = 0; size < 3; ++size)
      for (const bool by_columns : {false, true})
        for (const glm::dmat3& turn : some_rotations()) {
          HeadColumns columns = matrix_columns(kMatrices[size], by_columns, world, head);
          columns.metres_per_unit = 0.01;
          const auto numbers = numbers_of(turn, {100, -200, 300}, kSide[size][0], kSide[size][1], by_columns);
          const ReadHead got = read_head(columns, letters(numbers.size()), row_of(numbers));
          const glm::dmat3 wanted = ours_from(world) * turn * glm::transpose(ours_from(head));
          EXPECT_LT(difference(matrix_of(*got.pose), wanted), 1e-13);
          const glm::dvec3 place = size == 0 ? glm::dvec3(0) : ours_from(world) * glm::dvec3(1, -2, 3);
          EXPECT_LT(glm::distance(got.pose->position, place), 1e-15);
          EXPECT_EQ(got.counts.normalised, 0);
        }
}

TEST(RotationsOfRows, AreTheNearestToAMatrixThatIsOff) {
  // R S with S symmetric and near 1: R is the nearest rotation, whatever S is (polar decomposition).
  const glm::dmat3 turn = turn_about(1, 20) * turn_about(0, -35) * turn_about(2, 170);
  const glm::dmat3 strain(glm::dvec3(1.02, 0.015, -0.01), glm::dvec3(0.015, 0.97, 0.02),
                          glm::dvec3(-0.01, 0.02, 1.01));
  const ReadHead off = read_3x3(turn * strain);
  EXPECT_LT(difference(matrix_of(*off.pose), turn), 1e-13);
  EXPECT_EQ(off.counts.normalised, 1);
  // Three decimals are rounding.
  glm::dmat3 rounded = turn;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) rounded[i][k] = std::round(rounded[i][k] * 1000) / 1000;
  const ReadHead close = read_3x3(rounded);
  EXPECT_EQ(close.counts.normalised, 0);
  EXPECT_LT(difference(matrix_of(*close.pose), turn), 1e-3);
  EXPECT_NEAR(glm::length(close.pose->orientation), 1, 1e-15);
}

TEST(RotationsOfRows, AreRefusedWhereAMatrixIsNone) {
  const glm::dmat3 turn = turn_about(1, 20) * turn_about(0, -35);
  const auto error = [](const glm::dmat3& m) { return error_of([&] { read_3x3(m); }); };
  EXPECT_PRED2(holds, error(turn * 1.5),
               "log.csv:2: the rotation matrix scales by 1.5; export poses without scale");
  EXPECT_PRED2(holds, error(turn * glm::dmat3(-1.0)),
               "the rotation matrix mirrors (determinant -1); check handedness");
  EXPECT_PRED2(holds, error(glm::dmat3(0.0)), "the rotation matrix is zero; where that means lost tracking");
  EXPECT_PRED2(holds, error(glm::dmat3(turn[0], turn[1], turn[1])), "the matrix is no rotation: its columns");
  EXPECT_PRED2(holds, error(turn * 1e200), "log.csv:2: the");
}

TEST(RotationsOfRows, OfTheOtherMajorAreNamedAsSuch) {
  const glm::dmat3 turn = turn_about(1, 20) * turn_about(0, -35);
  const glm::dvec3 place(0.1, 1.6, -0.3);
  EXPECT_PRED2(
      holds,
      error_of_rows(matrix_columns(RotationKind::matrix_4x4, false), numbers_of(turn, place, 4, 4, true)),
      "the numbers are no rotation matrix by rows, and are one by columns; write \"major\": \"column\"");
  EXPECT_PRED2(
      holds,
      error_of_rows(matrix_columns(RotationKind::matrix_3x4, true), numbers_of(turn, place, 3, 4, false)),
      "the numbers are no rotation matrix by columns, and are one by rows; write \"major\": \"row\"");
  std::vector<double> projective = numbers_of(turn, place, 4, 4, false);
  projective[12] = 0.25;
  projective[15] = 2;
  EXPECT_PRED2(holds, error_of_rows(matrix_columns(RotationKind::matrix_4x4, false), projective),
               "the last row of the matrix is 0.25 0 0 2, not 0 0 0 1");
}

TEST(RotationsOfRows, AreAxisTimesAngle) {
  HeadColumns columns = head_columns(RotationKind::rotation_vector, "x y z");
  const auto turned = [&](const std::string& row) {
    return matrix_of(*read_head(columns, "x y z", row).pose);
  };
  EXPECT_EQ(turned("0 0 0"), glm::dmat3(1.0));
  EXPECT_LT(difference(turned("0 0 -1.5707963267948966"), turn_about(2, -90)), 1e-15);
  EXPECT_LT(difference(turned("3.1415926535897931 0 0"), turn_about(0, 180)), 1e-15);
  EXPECT_LT(difference(turned("0 2e-5 0"), turn_about(1, glm::degrees(2e-5))), 1e-16);
  EXPECT_LT(difference(turned("0 2e-4 0"), turn_about(1, glm::degrees(2e-4))), 1e-16);
  EXPECT_INPUT_ERROR(turned("0 180 0"),
                     "the rotation vector turns by 28.6479 turns; check its unit in the map");
  columns.radians_per_unit = glm::radians(1.0);
  // 180 degrees about (0.6, 0.8, 0): 2 a a' - 1.
  const glm::dvec3 a(0.6, 0.8, 0);
  EXPECT_LT(difference(turned("108 144 0"), 2.0 * glm::outerProduct(a, a) - glm::dmat3(1.0)), 1e-15);
}

TEST(RotationsOfRows, AreForwardAndUpInTheFilesWorld) {
  // In Unity's world z is forward: looking right and 30 degrees up, not leaning.
  HeadColumns columns = head_columns(RotationKind::forward_up, "fx fy fz", kUnity, kUnity);
  columns.up = group_of("ux uy uz");
  const std::string names = "fx fy fz ux uy uz";
  const double c = std::cos(glm::radians(30.0)), s = 0.5;
  const ReadHead got = read_head(columns, names, row_of({c, s, 0, -s, c, 0}));
  const glm::dmat3 wanted(glm::dvec3(0, 0, 1), glm::dvec3(-s, c, 0), glm::dvec3(-c, -s, 0));
  EXPECT_LT(difference(matrix_of(*got.pose), wanted), 1e-15);
  EXPECT_EQ(got.counts.normalised, 0);
  // An up that is not at a right angle only says in which plane up lies, and is counted.
  const ReadHead world_up = read_head(columns, names, row_of({c, s, 0, 0, 1, 0}));
  EXPECT_LT(difference(matrix_of(*world_up.pose), wanted), 1e-15);
  EXPECT_EQ(world_up.counts.normalised, 1);
  EXPECT_FALSE(read_head(columns, names, "1 0 0 0 nan 0").pose);
  EXPECT_INPUT_ERROR(read_head(columns, names, "0 1 0 0 1 0"), "forward and up of the head lie on one line");
  EXPECT_INPUT_ERROR(read_head(columns, names, "0 0 0 0 1 0"),
                     "the forward direction has the length 0, not 1");
  EXPECT_INPUT_ERROR(read_head(columns, names, "0 0 1 0 5 0"), "the up direction has the length 5, not 1");
}

TEST(RotationsOfRows, HaveAsManyNumbersAsTheirKind) {
  EXPECT_INPUT_ERROR(read_head(head_columns(RotationKind::quaternion_xyzw, "x y z"), "x y z", "0 0 1"),
                     "the map has 3 numbers for a rotation of 4");
}

}  // namespace
}  // namespace herr::test
