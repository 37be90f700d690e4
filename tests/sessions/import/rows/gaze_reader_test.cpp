// Gaze of rows: vectors, tangents, angles and points, in the head, the eye and the world.
#include "sessions/import/rows/gaze_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sessions/import/rows/gaze_direction.h"
#include "tests/sessions/import/rows/rotation_kinds.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

const std::array<glm::dvec3, 2> kHeadsOrigin{};

GazeColumns gaze_of(const std::vector<DirectionColumns>& rays, const Words& axes = kUnity,
                    GazeSpace space = GazeSpace::head) {
  GazeColumns columns;
  columns.time.kind = TimeColumns::Kind::rate;
  columns.rays = rays;
  columns.axes = *AxisDirections::from_words(axes);
  columns.space = space;
  return columns;
}

DirectionColumns vector_ray(const std::string& names) {
  DirectionColumns ray;
  ray.vector = group_of(names);
  return ray;
}

DirectionColumns angle_ray(AngleKind kind) {
  DirectionColumns ray;
  ray.angles = group_of("az el");
  ray.angle_kind = kind;
  ray.radians_per_unit = glm::radians(1.0);
  return ray;
}

DirectionColumns point_ray() {
  DirectionColumns ray;
  ray.point = group_of("x y z");
  ray.metres_per_unit = 0.001;
  return ray;
}

struct ReadGaze {
  GazeRow row;
  ReadingCounts counts;
};

ReadGaze read_gaze(const GazeColumns& columns, const std::string& names, const std::string& row,
                   const Pose* head = nullptr, const std::array<glm::dvec3, 2>& eyes = kHeadsOrigin) {
  FakeRows source(names, {row});
  const GazeReader reader(source, columns);
  ReadGaze result;
  result.row.valid = {true, true};
  if (source.next()) reader.read(source, head, eyes, result.row, result.counts);
  return result;
}

// Of combined gaze.
void expect_direction(const ReadGaze& got, const glm::dvec3& wanted, double within = 1e-15) {
  EXPECT_EQ(got.row.valid, (std::array<bool, 2>{true, true}));
  EXPECT_LT(glm::distance(got.row.head_direction[0], wanted), within);
  EXPECT_LT(glm::distance(got.row.head_direction[1], wanted), within);
}

TEST(GazeOfARow, IsAVectorInTheAxesOfTheMap) {
  const GazeColumns columns = gaze_of({vector_ray("x y z")});
  expect_direction(read_gaze(columns, "x y z", "0.6 0 0.8"), {0.6, 0, -0.8});
  const ReadGaze off = read_gaze(columns, "x y z", "0 0 1.05");
  expect_direction(off, {0, 0, -1});
  EXPECT_EQ(off.counts.normalised, 1);
  EXPECT_INPUT_ERROR(read_gaze(columns, "x y z", "0 0 500"), "the gaze direction has the length 500, not 1");
  EXPECT_INPUT_ERROR(read_gaze(columns, "x y z", "0 0 0"),
                     "where that means lost gaze, write \"placeholder\"");
}

TEST(GazeOfARow, HasARayForEachEye) {
  GazeColumns columns = gaze_of({vector_ray("lx ly lz"), vector_ray("rx ry rz")});
  columns.rays[1].valid.all.push_back({{"ok", 0}, RowCondition::Kind::is, {"1"}, 0, 0});
  const std::string names = "lx ly lz rx ry rz ok";
  const ReadGaze both = read_gaze(columns, names, "0.6 0 0.8 -0.6 0 0.8 1");
  EXPECT_EQ(both.row.valid, (std::array<bool, 2>{true, true}));
  EXPECT_EQ(both.row.head_direction[0], glm::dvec3(0.6, 0, -0.8));
  EXPECT_EQ(both.row.head_direction[1], glm::dvec3(-0.6, 0, -0.8));
  EXPECT_EQ(read_gaze(columns, names, "0.6 0 0.8 bad 0 0.8 0").row.valid, (std::array<bool, 2>{true, false}));
  EXPECT_EQ(read_gaze(columns, names, "0.6 - 0.8 0 0 1 1").row.valid, (std::array<bool, 2>{false, true}));
  EXPECT_EQ(read_gaze(columns, names, "nan nan nan 0 0 1 0").row.valid, (std::array<bool, 2>{false, false}));
}

TEST(GazeOfARow, IsLostAtThePlaceholder) {
  GazeColumns columns = gaze_of({vector_ray("x y z")});
  columns.rays[0].placeholder = glm::dvec3(0, 0, 0);
  EXPECT_EQ(read_gaze(columns, "x y z", "0 0 -0").row.valid, (std::array<bool, 2>{false, false}));
  columns = gaze_of({angle_ray(AngleKind::tangents)});
  columns.rays[0].placeholder = glm::dvec3(-99, -99, 0);
  EXPECT_EQ(read_gaze(columns, "az el", "-99 -99").row.valid, (std::array<bool, 2>{false, false}));
  expect_direction(read_gaze(columns, "az el", "0 0"), {0, 0, -1});
}

TEST(GazeOfARow, IsSeenByTheEyesWhosePupilsAreThere) {
  GazeColumns columns = gaze_of({vector_ray("x y z")});
  for (const char* name : {"pl", "pr"})
    columns.pupils.push_back({{{{name, 0}, RowCondition::Kind::above, {}, 0, 0}}, {}});
  const std::string names = "x y z pl pr";
  EXPECT_EQ(read_gaze(columns, names, "0 0 1 3 3").row.valid, (std::array<bool, 2>{true, true}));
  EXPECT_EQ(read_gaze(columns, names, "0 0 1 3 -1").row.valid, (std::array<bool, 2>{true, false}));
  EXPECT_EQ(read_gaze(columns, names, "0 0 1 nan 3").row.valid, (std::array<bool, 2>{false, true}));
  // Where no pupil was seen, the ray is not even looked at.
  EXPECT_EQ(read_gaze(columns, names, "bad 0 1 -1 -1").row.valid, (std::array<bool, 2>{false, false}));
}

TEST(GazeOfARow, IsTwoTangents) {
  DirectionColumns ray;
  ray.tangents = group_of("x y");
  const GazeColumns columns = gaze_of({ray}, {"left", "up", "forward"});
  // (0.75, 0, 1) has the length 1.25; x points to the left.
  expect_direction(read_gaze(columns, "x y", "0.75 0"), {-0.6, 0, -0.8});
  EXPECT_INPUT_ERROR(read_gaze(columns, "x y", "50 0"), "the gaze (50, 0) is 89 degrees or more off axis");
}

TEST(GazeOfARow, IsTwoAnglesOfANamedKind) {
  const auto read = [](AngleKind kind, const std::string& row) {
    return read_gaze(gaze_of({angle_ray(kind)}), "az el", row);
  };
  // Spherical: at 20 degrees of elevation (0, sin 20, cos 20); at 30 of azimuth and -6.1 of elevation the
  // vertical part is sin -6.1 whatever the azimuth.
  expect_direction(read(AngleKind::spherical, "0 20"), {0, 0.342020143, -0.939692621}, 1e-9);
  expect_direction(read(AngleKind::spherical, "30 -6.1"), {0.497169, -0.106264, -0.861122}, 1e-6);
  // Helmholtz: the horizontal part is sin 30 whatever the elevation.
  expect_direction(read(AngleKind::helmholtz, "30 20"), {0.5, 0.296198133, -0.813797681}, 1e-9);
  // Tangents: x / z = tan 30, y / z = tan 20.
  const double x = std::tan(glm::radians(30.0)), y = std::tan(glm::radians(20.0));
  expect_direction(read(AngleKind::tangents, "30 20"), glm::normalize(glm::dvec3(x, y, -1)));
  expect_direction(read(AngleKind::spherical, "180 0"), {0, 0, 1});
  EXPECT_INPUT_ERROR(read(AngleKind::tangents, "0 89"), "the gaze (0, 89) is 89 degrees or more off axis");
  EXPECT_INPUT_ERROR(read(AngleKind::spherical, "500 0"), "the gaze angles (500, 0) are more than a turn");
  EXPECT_INPUT_ERROR(read(AngleKind::helmholtz, "0 200"), "the gaze angles (0, 200) are more than a turn");
}

// A head at (1, 2, 3), turned 90 degrees to the left about the vertical: ahead is the world's -x, right its
// -z.
const Pose kTurnedLeft{glm::dvec3(1, 2, 3), glm::angleAxis(glm::radians(90.0), glm::dvec3(0, 1, 0))};

TEST(GazeOfARow, InTheWorldIsTurnedIntoTheHead) {
  const GazeColumns columns = gaze_of({vector_ray("x y z")}, kUnreal, GazeSpace::world);
  // Left in the world, 36.87 degrees up, is ahead and up for the head.
  expect_direction(read_gaze(columns, "x y z", "0 -0.8 0.6", &kTurnedLeft), {0, 0.6, -0.8});
  // Ahead in the world is to the head's right.
  expect_direction(read_gaze(columns, "x y z", "1 0 0", &kTurnedLeft), {1, 0, 0});
  EXPECT_EQ(read_gaze(columns, "x y z", "1 0 0", nullptr).row.valid, (std::array<bool, 2>{false, false}));
  FakeRows source("x y z", {});
  EXPECT_TRUE(GazeReader(source, columns).needs_head());
}

TEST(GazeOfARow, AtAPointInTheWorldStartsInTheEye) {
  GazeColumns columns = gaze_of({point_ray(), point_ray()}, kOurs, GazeSpace::world);
  const std::array<glm::dvec3, 2> eyes{glm::dvec3(-0.03, 0, 0), glm::dvec3(0.03, 0, 0)};
  // 1 m ahead of the head: (0, 2, 3) in the world. Each eye looks 30 mm inwards over 1 m.
  const ReadGaze got = read_gaze(columns, "x y z", "0 2000 3000", &kTurnedLeft, eyes);
  EXPECT_LT(glm::distance(got.row.head_direction[0], glm::normalize(glm::dvec3(0.03, 0, -1))), 1e-15);
  EXPECT_LT(glm::distance(got.row.head_direction[1], glm::normalize(glm::dvec3(-0.03, 0, -1))), 1e-15);
  EXPECT_EQ(got.counts.normalised, 0);
  // With an origin of its own the head's place plays no part.
  columns.rays[0].origin = columns.rays[1].origin = group_of("ox oy oz");
  const ReadGaze from = read_gaze(columns, "x y z ox oy oz", "500 0 0 2000 0 0", &kTurnedLeft, eyes);
  EXPECT_LT(glm::distance(from.row.head_direction[0], glm::dvec3(0, 0, -1)), 1e-15);
  EXPECT_EQ(from.row.head_direction[0], from.row.head_direction[1]);
}

TEST(GazeOfARow, AtAPointInTheHeadOrFromTheEye) {
  const std::array<glm::dvec3, 2> eyes{glm::dvec3(0.3, 0, 0), glm::dvec3(-0.3, 0, 0)};
  const std::string row = "300 0 400";
  // From the head's axes' point of view (0.3, 0, -0.4): straight ahead of the left eye, which is at 0.3 here.
  const ReadGaze head = read_gaze(gaze_of({point_ray(), point_ray()}), "x y z", row, nullptr, eyes);
  EXPECT_LT(glm::distance(head.row.head_direction[0], glm::dvec3(0, 0, -1)), 1e-15);
  EXPECT_LT(glm::distance(head.row.head_direction[1], glm::normalize(glm::dvec3(0.6, 0, -0.4))), 1e-15);
  const GazeColumns from_eye = gaze_of({point_ray()}, kUnity, GazeSpace::eye);
  expect_direction(read_gaze(from_eye, "x y z", row, nullptr, eyes), {0.6, 0, -0.8});
  EXPECT_INPUT_ERROR(read_gaze(from_eye, "x y z", "0 0 0"), "the point looked at is 0 m from the eye");
  EXPECT_EQ(read_gaze(from_eye, "x y z", "0 nan 0").row.valid, (std::array<bool, 2>{false, false}));
}

TEST(GazeOfARow, BringsItsConfidenceAsText) {
  GazeColumns columns = gaze_of({vector_ray("x y z")});
  FakeRows plain("x y z", {"0 0 1"});
  const GazeReader without(plain, columns);
  ASSERT_TRUE(plain.next());
  EXPECT_FALSE(without.confidence(plain, 0));
  columns.rays[0].confidence = ColumnRef{"c", 0};
  FakeRows source("x y z c", {"0 0 1 0.95"});
  const GazeReader reader(source, columns);
  ASSERT_TRUE(source.next());
  EXPECT_EQ(*reader.confidence(source, 0), "0.95");
  EXPECT_TRUE(reader.combined());
  const std::vector<ColumnRef> asked = columns_of(columns);
  ASSERT_EQ(asked.size(), 4u);
  EXPECT_EQ(asked[3].name, "c");
}

}  // namespace
}  // namespace herr::test
