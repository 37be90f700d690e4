// Small recordings of every kind of disorder, each through a plain map, against what its rows say.
#include "sessions/import/import_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "sessions/text/fixed_text.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

// Seconds, metres, quaternion, all in our axes; gaze as vectors in a file of its own.
constexpr const char* kMap = R"({
  "format_version": 1, "name": "plain", "note": "",
  "head": [{
    "time": {"column": "t", "unit": "s"},
    "position": {"columns": ["x", "y", "z"], "unit": "m"},
    "orientation": {"quaternion_xyzw": ["qx", "qy", "qz", "qw"]},
    "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]HEAD
  }],
  "gaze": [{
    "time": {"column": "t", "unit": "s"}, "axes": ["right", "up", "back"],
    "combined": {"vector": ["gx", "gy", "gz"]GAZE}MORE
  }]
})";

struct Imported {
  std::vector<PoseRow> poses;
  std::vector<GazeRow> gaze;
  ImportReport report;
};

const std::string kHead = "t,x,y,z,qx,qy,qz,qw\n";
const std::string kGaze = "t,gx,gy,gz\n";

std::string pose(double t, double x = 0) {
  return fixed_text(t, 6) + "," + fixed_text(x, 6) + ",1.6,0,0,0,0,1\n";
}
std::string gaze(double t, const std::string& direction = "0,0,-1") {
  return fixed_text(t, 6) + "," + direction + "\n";
}
std::string poses(int count, double first = 1, double step = 1.0 / 90) {
  std::string text;
  for (int i = 0; i < count; ++i) text += pose(first + i * step, 0.001 * i);
  return text;
}

class ImportRows : public ::testing::Test {
 protected:
  // The map with further fields of the head, of the ray and of the gaze.
  void use_map(const std::string& head, const std::string& ray = "", const std::string& more = "") {
    std::string json = kMap;
    for (const auto& [word, text] : {std::pair<std::string, std::string>{"HEAD", head}, {"GAZE", ray}, {"MORE", more}})
      json.replace(json.find(word), word.size(), text);
    map_ = parse_column_map(json, "plain.json");
  }
  void SetUp() override { use_map(""); }

  Imported import(const std::string& head, const std::string& gaze = "",
                  const std::function<void(ImportRequest&)>& change = {}) {
    ImportRequest request;
    request.columns.head = &map_.head.front();
    if (!head.empty()) {
      folder_.write("head.csv", head);
      request.head_file = folder_ / "head.csv";
    }
    if (!gaze.empty()) {
      folder_.write("gaze.csv", gaze);
      request.gaze_file = folder_ / "gaze.csv";
      request.columns.gaze = &map_.gaze.front();
    }
    if (change) change(request);
    Imported got;
    got.report = import_rows(request, {[&](const PoseRow& row) { got.poses.push_back(row); },
                                       [&](const GazeRow& row) { got.gaze.push_back(row); }});
    return got;
  }

  RecordedFolder folder_;
  ColumnMap map_;
};

// "KEY ROWS@FIRST LINE" of each fate that rows had.
std::string fates(const ImportedStream& stream) {
  std::string text;
  for (std::size_t i = 0; i < kRowFates; ++i)
    if (stream.fates.rows[i] > 0)
      text += (text.empty() ? "" : ", ") + std::string(row_fate_texts()[i].key) + " " +
              std::to_string(stream.fates.rows[i]) + "@" + std::to_string(stream.fates.first_line[i]);
  return text;
}

std::string all(const std::vector<std::string>& texts) {
  std::string together;
  for (const std::string& text : texts) together += (together.empty() ? "" : "\n") + text;
  return together;
}

TEST_F(ImportRows, CarriesGoodRowsOver) {
  const Imported got = import(kHead + poses(90), kGaze + gaze(1) + gaze(1.01, "0.6,0,-0.8"));
  ASSERT_EQ(got.poses.size(), 90u);
  EXPECT_EQ(got.poses[1].stamp_ns, 1'011'111'000) << "1 + 1 / 90 s with six decimals";
  EXPECT_EQ(got.poses[1].world_from_head.position, glm::dvec3(0.001, 1.6, 0));
  ASSERT_EQ(got.gaze.size(), 2u);
  EXPECT_EQ(got.gaze[1].head_direction[0], glm::dvec3(0.6, 0, -0.8));
  EXPECT_TRUE(got.gaze[1].valid[0] && got.gaze[1].valid[1]);
  EXPECT_TRUE(got.report.has_gaze && got.report.gaze_combined);
  EXPECT_EQ(got.report.poses.rows_read, 90);
  EXPECT_EQ(got.report.poses.rows, 90);
  EXPECT_EQ(got.report.poses.first_ns, 1'000'000'000);
  EXPECT_EQ(got.report.poses.last_ns, got.poses.back().stamp_ns);
  EXPECT_NEAR(got.report.poses.rate_hz(), 90, 0.9) << "intervals are known within 1 %";
  EXPECT_EQ(fates(got.report.poses) + all(got.report.remarks) + all(got.report.warnings) + all(got.report.assumed), "");
  EXPECT_EQ(got.report.poses.lost_share(), 0);
}

TEST_F(ImportRows, TellsOfAClockThatWasReset) {
  const Imported got = import(kHead + poses(60, 0.5) + poses(60, 0.5));
  EXPECT_EQ(got.poses.size(), 60u);
  EXPECT_EQ(fates(got.report.poses), "other_clock 60@62");
  EXPECT_EQ(all(got.report.remarks),
            "60 of 120 rows lie before the newest stamp: the clock was reset at line 62");
  EXPECT_EQ(all(got.report.warnings), "") << "one remark, not 60 warnings";
  EXPECT_EQ(got.report.poses.lost_share(), 0.5);
  EXPECT_EQ(got.poses.back().world_from_head.position.x, 0.059) << "the first recording";
}

// The eleventh of 90 rows, in line 12, lies 2147483 s ahead.
TEST_F(ImportRows, LeaveOneWildStampOut) {
  const Imported got = import(kHead + poses(10) + pose(2147483.647) + poses(79, 1.122222));
  EXPECT_EQ(got.poses.size(), 89u);
  EXPECT_EQ(fates(got.report.poses), "wild_stamp 1@12");
  ASSERT_EQ(got.report.warnings.size(), 1u);
  EXPECT_TRUE(holds(got.report.warnings[0], "head.csv:12: the time stamp is far from its neighbours"));
  EXPECT_EQ(got.report.poses.widest_line_is_small(), true);
}

}  // namespace
}  // namespace herr::test
