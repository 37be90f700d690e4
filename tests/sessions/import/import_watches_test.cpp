// What is watched over all rows of an import: gravity, ids, confidence, and gaze in the world that needs the
// head.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "tests/sessions/import/plain_import.h"

namespace herr::test {
namespace {

using WatchedImport = PlainImport;
using WorldGaze = PlainImport;

TEST_F(WatchedImport, NamesAnIdThatChanges) {
  use_map(R"(, "part": "id")");
  std::string head = "id,t,x,y,z,qx,qy,qz,qw\n";
  for (int i = 0; i < 30; ++i) head += std::string(i < 12 ? "a" : "b") + "," + pose(1 + i * 0.01);
  const Imported got = import(head);
  EXPECT_EQ(got.poses.size(), 30u);
  EXPECT_EQ(all(got.report.remarks), "the id in column 'id' changes at line 14 from 'a' to 'b': another recording begins");
}

// The map's y points up. Gravity along -y agrees; along -z, up is z; within 20 degrees it may be tilted.
TEST_F(WatchedImport, LetsGravitySayWhatIsUp) {
  use_map(R"(, "gravity": ["ax", "ay", "az"])");
  const auto with = [&](const std::string& gravity) {
    std::string head = "ax,ay,az,t,x,y,z,qx,qy,qz,qw\n";
    for (int i = 0; i < 10; ++i) head += gravity + "," + pose(1 + i * 0.01);
    return import(head).poses.size();
  };
  EXPECT_EQ(with("0,-9.81,0"), 10u);
  EXPECT_EQ(with("1,-9.7,1"), 10u) << "8 degrees";
  EXPECT_EQ(with("0,0,0"), 10u);
  EXPECT_EQ(with("nan,nan,nan"), 10u);
  EXPECT_INPUT_ERROR(with("0,0,-9.81"), "gravity says that the file's z points up, the map says y");
  EXPECT_INPUT_ERROR(with("9.81,0,0"), "gravity says that the file's -x points up, the map says y");
  EXPECT_INPUT_ERROR(with("5,-8.5,0"), "up is 30 degrees from the file's y");
}

TEST_F(WatchedImport, NamesConfidenceThatNeverChanges) {
  use_map("", R"(, "confidence": "c")");
  const auto remarks = [&](int rows, int other) {
    std::string text = "c,t,gx,gy,gz\n";
    for (int i = 0; i < rows; ++i) text += (i == other ? "0.5," : "1.0,") + gaze(1 + i * 0.01);
    return all(import(kHead + poses(90), text).report.remarks);
  };
  EXPECT_EQ(remarks(100, -1), "the gaze's confidence is '1.0' in all 100 valid rows: it was not measured");
  EXPECT_EQ(remarks(100, 99), "");
  EXPECT_EQ(remarks(99, -1), "") << "too few rows to say so";
}

// The head turns about y by 20 degrees from 1.00 to 1.02 s. Gaze straight along the world's -z at 1.01 s,
// half way, is in the head 10 degrees to the right of ahead: the head has turned to the left.
TEST_F(WorldGaze, TurnsGazeInTheWorldIntoTheHead) {
  use_map("", "", R"(, "space": "world")");
  const auto turned = [](double t, double deg) {
    const double half = glm::radians(deg / 2);
    return fixed_text(t, 6) + ",0,1.6,0,0," + fixed_text(std::sin(half), 15) + ",0," +
           fixed_text(std::cos(half), 15) + "\n";
  };
  const std::string head = kHead + turned(1, 0) + turned(1.02, 20) + turned(1.04, 20) + turned(1.06, 20);
  const Imported got = import(head, kGaze + gaze(0.99) + gaze(1.0) + gaze(1.01) + gaze(1.04) + gaze(1.07));
  ASSERT_EQ(got.gaze.size(), 5u);
  EXPECT_FALSE(got.gaze[0].valid[0]) << "before the first pose";
  EXPECT_FALSE(got.gaze[4].valid[0]) << "behind the last";
  EXPECT_EQ(fates(got.report.gaze), "lost_tracking 2@2");
  const double right_deg[] = {0, 10, 20};
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = glm::radians(right_deg[i]);
    ASSERT_TRUE(got.gaze[i + 1].valid[0]);
    EXPECT_LT(glm::distance(got.gaze[i + 1].head_direction[0], glm::dvec3(std::sin(a), 0, -std::cos(a))),
              1e-9)
        << i;
  }
}

// Poses half a second apart and more are no span to interpolate over.
TEST_F(WorldGaze, DoesNotGuessTheHeadOverAGap) {
  use_map("", "", R"(, "space": "world")");
  const Imported got = import(kHead + poses(20, 1) + poses(20, 3), kGaze + gaze(1.1) + gaze(2) + gaze(3.1));
  ASSERT_EQ(got.gaze.size(), 3u);
  EXPECT_TRUE(got.gaze[0].valid[0]);
  EXPECT_FALSE(got.gaze[1].valid[0]);
  EXPECT_TRUE(got.gaze[2].valid[0]);
}

TEST_F(WorldGaze, FindsTheHeadForGazeThatComesLate) {
  use_map("", "", R"(, "space": "world")");
  const Imported got = import(kHead + poses(60), kGaze + gaze(1.1) + gaze(1.3) + gaze(1.2) + gaze(1.4),
                              [](ImportRequest& request) { request.sort_rows = 2; });
  ASSERT_EQ(got.gaze.size(), 4u);
  for (const GazeRow& row : got.gaze) EXPECT_TRUE(row.valid[0]) << row.stamp_ns;
}

// Pose and gaze in one row: the row's own pose counts, also where its neighbours would say something else.
TEST_F(WorldGaze, TakesTheHeadOfTheVeryRow) {
  use_map("", "", R"(, "space": "world", "in_head_file": true)");
  std::string table = "t,x,y,z,qx,qy,qz,qw,gx,gy,gz\n";
  for (int i = 0; i < 20; ++i)
    table += fixed_text(1 + i * 0.01, 2) + (i % 2 == 0 ? ",0,0,0,0,0,0,1" : ",0,0,0,0,1,0,0") + ",0,0,-1\n";
  table += "1.20,nan,nan,nan,nan,nan,nan,nan,0,0,-1\n";
  const Imported got =
      import(table, "", [&](ImportRequest& request) { request.columns.gaze = &map_.gaze.front(); });
  ASSERT_EQ(got.gaze.size(), 21u);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(got.gaze[i].head_direction[0].z, i % 2 == 0 ? -1 : 1) << i;
  EXPECT_FALSE(got.gaze[20].valid[0]) << "the head was lost";
}

}  // namespace
}  // namespace herr::test
