// Logs of real programs, a row or two of each, from a map's JSON through the file to values in our axes.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <memory>
#include <string>

#include "sessions/import/map/column_map.h"
#include "sessions/import/rows/gaze_reader.h"
#include "sessions/import/rows/head_reader.h"
#include "sessions/import/rows/time_reader.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

class MappedLog : public ::testing::Test {
 protected:
  void open(const std::string& map, const std::string& rows) {
    map_ = parse_column_map(R"({"format_version": 1, "name": "lab", )" + map + "}", "lab.json");
    folder_.write("log.txt", rows);
    source_ = open_rows(folder_ / "log.txt", map_.head.at(0).table, columns_of(map_.head.at(0)));
    time_.emplace(*source_, map_.head.at(0).time);
    head_.emplace(*source_, map_.head.at(0));
    if (!map_.gaze.empty()) gaze_.emplace(*source_, map_.gaze.at(0));
  }
  // The next row.
  void read() {
    ASSERT_TRUE(source_->next());
    stamp_ns_ = time_->read(*source_);
    pose_ = head_->read(*source_, counts_);
    ASSERT_TRUE(pose_);
    if (gaze_) gaze_->read(*source_, &*pose_, {}, seen_, counts_);
  }
  glm::dvec3 forward() const { return pose_->orientation * glm::dvec3(0, 0, -1); }

  RecordedFolder folder_;
  ColumnMap map_;
  std::unique_ptr<RowSource> source_;
  std::optional<TimeReader> time_;
  std::optional<HeadReader> head_;
  std::optional<GazeReader> gaze_;
  TimeNs stamp_ns_ = 0;
  std::optional<Pose> pose_;
  GazeRow seen_;
  ReadingCounts counts_;
};

// Yaw 20 to the right and pitch 10 up: (cos 10 sin 20, sin 10, -cos 10 cos 20). Centimetres, x forward, z up.
TEST_F(MappedLog, OfUnrealHasTwoOfThreeAnglesTheOtherWay) {
  open(R"("head": [{"separator": "tab", "time": {"column": "Time", "unit": "s"},
      "position": {"columns": ["HeadX", "HeadY", "HeadZ"], "unit": "cm"},
      "orientation": {"euler_xyz": ["Roll", "Pitch", "Yaw"], "unit": "deg", "order": "xyz", "sense": [-1, -1, 1]},
      "world_axes": ["forward", "right", "up"], "head_axes": ["forward", "right", "up"], "handedness": "left"}])",
       "Time\tHeadX\tHeadY\tHeadZ\tRoll\tPitch\tYaw\n3.0000\t0.000\t10.0\t160.0\t5.000\t10.000\t20.000\n");
  read();
  EXPECT_EQ(stamp_ns_, 3'000'000'000);
  EXPECT_LT(glm::distance(pose_->position, glm::dvec3(0.1, 1.6, 0)), 1e-12);
  EXPECT_LT(glm::distance(forward(), glm::dvec3(0.336824, 0.173648, -0.925417)), 1e-6);
}

// The matrix looks down by 5 degrees: (0, -sin 5, -cos 5). The gaze is normalise(0.1, -0.2, -1) in the head,
// which by the matrix is (0.0975900, -0.2794926, -0.9551754) in the world. 132812345678901234 x 100 ns lie
// 1636760967890123400 ns after 1970 (11644473600 s after 1601).
TEST_F(MappedLog, OfHoloLensHasAMatrixByRowsAndGazeInTheWorld) {
  open(R"("head": [{"header": false, "time": {"column": 1, "unit": "filetime"},
      "orientation": {"matrix_4x4": [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17], "major": "row"},
      "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]}],
    "gaze": [{"in_head_file": true, "header": false, "time": {"column": 1, "unit": "filetime"}, "space": "world",
      "axes": ["right", "up", "back"],
      "combined": {"vector": [19, 20, 21], "valid": {"all": [{"column": 18, "is": "1"}]}}}])",
       "132812345678901234,1,0,0,0.1,0,0.9961947,0.087155743,0.02,0,-0.087155743,0.9961947,-0.3,0,0,0,1,"
       "1,0.0975900,-0.2794926,-0.9551754\n");
  read();
  EXPECT_EQ(stamp_ns_, 1'636'760'967'890'123'400);
  EXPECT_LT(glm::distance(forward(), glm::dvec3(0, -0.0871557, -0.9961947)), 1e-6);
  EXPECT_LT(glm::distance(pose_->position, glm::dvec3(0.1, 0.02, -0.3)), 1e-12);
  EXPECT_EQ(seen_.valid, (std::array<bool, 2>{true, true}));
  EXPECT_LT(glm::distance(seen_.head_direction[0], glm::normalize(glm::dvec3(0.1, -0.2, -1))), 1e-6);
  EXPECT_EQ(counts_.normalised, 0);
}

TEST_F(MappedLog, OfPlainMatricesHasItsTimeFromARate) {
  open(R"("head": [{"header": false, "separator": "spaces", "time": {"rate_hz": 30, "offset_s": 2},
      "orientation": {"matrix_4x4": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16], "major": "row"},
      "world_axes": ["right", "up", "back"], "head_axes": ["right", "down", "forward"]}])",
       "1 0 0 0.0  0 1 0 1.5  0 0 1 0  0 0 0 1\n1 0 0 0.01  0 1 0 1.5  0 0 1 0  0 0 0 1\n");
  read();
  read();
  EXPECT_EQ(stamp_ns_, 2'033'333'333);
  EXPECT_EQ(pose_->position, glm::dvec3(0.01, 1.5, 0));
  EXPECT_LT(glm::distance(forward(), glm::dvec3(0, 0, 1)), 1e-15);  // the camera's z
}

// (sin 4, 0, 0) turns by 8 degrees about x, y to z and z to -y: the frame's forward goes down.
TEST_F(MappedLog, OfUnityWithoutWHasDecimalCommasAndLooksDown) {
  open(R"("head": [{"separator": ";", "decimal": ",", "time": {"column": "t", "unit": "ns", "scale": 0.5},
      "orientation": {"quaternion_xyz": ["qx", "qy", "qz"]},
      "world_axes": ["right", "up", "forward"], "head_axes": ["right", "up", "forward"]}],
    "gaze": [{"in_head_file": true, "separator": ";", "decimal": ",", "time": {"column": "t", "unit": "ns"},
      "axes": ["right", "up", "forward"],
      "combined": {"azimuth": "az", "elevation": "el", "convention": "spherical"}}])",
       "t;qx;qy;qz;az;el\n1000900000000000002;0,0697565;0;0;0,0;20,0\n");
  read();
  EXPECT_EQ(stamp_ns_, 500'450'000'000'000'001);
  EXPECT_LT(glm::distance(forward(), glm::dvec3(0, -0.139173, -0.990268)), 1e-6);
  EXPECT_LT(glm::distance(seen_.head_direction[1], glm::dvec3(0, 0.342020, -0.939693)), 1e-6);
}

}  // namespace
}  // namespace herr::test
