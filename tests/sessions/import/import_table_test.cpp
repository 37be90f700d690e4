// Column maps and the rows that they read: repairs are counted, faults are named with their line.
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "sessions/import/import_rows.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/presets/choose_format.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

const std::string kHead = R"("time": {"column": "t", "unit": "ms"},
  "position": {"columns": ["x", "y", "z"], "unit": "mm"},
  "orientation": {"quaternion_xyzw": "q"},
  "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"])";

std::string map_json(const std::string& head, const std::string& rest = "") {
  return R"({"format_version": 1, "name": "lab", "head": [{)" + head + "}]" + rest + "}";
}

struct Imported {
  std::vector<PoseRow> poses;
  std::vector<GazeRow> gaze;
  ImportReport report;
};

Imported import(const std::shared_ptr<const ColumnMap>& map, const std::string& preset,
                const std::filesystem::path& head, bool keep_going = false) {
  const ChosenFormat format = choose_format({{head, {}}, preset, map, "", {}});
  ImportRequest request;
  request.head_file = head;
  request.columns = format.format.columns;
  request.keep_going = keep_going;
  Imported result;
  result.report = import_rows(request, {[&](const PoseRow& row) { result.poses.push_back(row); },
                                        [&](const GazeRow& row) { result.gaze.push_back(row); }});
  return result;
}

std::shared_ptr<const ColumnMap> lab() {
  return std::make_shared<ColumnMap>(parse_column_map(map_json(kHead), "lab.json"));
}

class ImportedTable : public ::testing::Test {
 protected:
  Imported import_lab(const std::string& rows, bool keep_going = false) {
    folder_.write("head.csv", "t,x,y,z,q,more\n" + rows);
    return import(lab(), "", folder_ / "head.csv", keep_going);
  }
  RecordedFolder folder_;
};

TEST_F(ImportedTable, IsReadByNamesUnitsAndFieldsOfSeveralNumbers) {
  const Imported got = import_lab("10,1000,-500,0,\"(0, 0, 0.6, 0.8)\",u\r\n20.5,0,0,1,\"(0 0 0 1)\",\r\n");
  ASSERT_EQ(got.poses.size(), 2u);
  EXPECT_EQ(got.poses[0].stamp_ns, 10'000'000);
  EXPECT_EQ(got.poses[1].stamp_ns, 20'500'000);
  EXPECT_EQ(got.poses[0].world_from_head.position, glm::dvec3(1, -0.5, 0));
  EXPECT_EQ(got.poses[0].world_from_head.orientation, glm::dquat(0.8, 0, 0, 0.6));
}

TEST_F(ImportedTable, IsRepairedAndSaysSo) {
  const std::string q = ",0,0,0,(0 0 0 1),\n";
  const Imported got = import_lab("10" + q + "20" + q + "20" + q + "15" + q + "\n30" + q + "40" + q + "90" +
                                  q + "100,0,0,0,(0 0 0 1)");
  EXPECT_EQ(got.poses.size(), 5u);
  const ImportedStream& stream = got.report.poses;
  EXPECT_EQ(stream.rows, 5);
  EXPECT_EQ(stream.fates[RowFate::repeated_stamp], 1);
  EXPECT_EQ(stream.fates[RowFate::backward_stamp], 1);
  EXPECT_EQ(stream.source.blank_lines, 1);
  EXPECT_EQ(stream.repeated_values, 4);
  EXPECT_EQ(stream.intervals.hitches(), 1);
  EXPECT_EQ(stream.intervals.widest_ns(), 50'000'000);
  EXPECT_EQ(stream.intervals.widest_line(), 9);
  EXPECT_DOUBLE_EQ(stream.rate_hz(), 100);  // intervals 10, 10, 10, 50 ms
  EXPECT_EQ(stream.fates.lines[static_cast<std::size_t>(RowFate::repeated_stamp)][0], 4);
  EXPECT_EQ(stream.fates.lines[static_cast<std::size_t>(RowFate::backward_stamp)][0], 5);
  ASSERT_EQ(got.report.warnings.size(), 1u);
  EXPECT_PRED2(holds, got.report.warnings[0], "head.csv:10: the file ends within this line");
}

TEST_F(ImportedTable, WithAFaultIsRefusedWithItsLine) {
  const std::string good = "10,0,0,0,(0 0 0 1),\n";
  const std::vector<std::pair<std::string, std::string>> faults{
      {"20,O,0,0,(0 0 0 1),\n", "head.csv:3: column 'x' is 'O', not a finite number"},
      {"20,0,0,1e999,(0 0 0 1),\n", "column 'z' is '1e999'"},
      {"20,0,0,0,(0 0 1),\n", "column 'q' is '(0 0 1)', not 4 numbers"},
      {"20,0,0,0,(0 0 0 0),\n", "the quaternion has the length 0, not 1"},
      {"20,0,0,0,(0 0 0 1.2),\n", "the quaternion has the length 1.2"},
      {"20,0,0,0\n", "head.csv:3: the line has 4 fields where the header line names 6"},
      {"soon,0,0,0,(0 0 0 1),\n", "column 't' is 'soon'"},
      {"20,1e13,0,0,(0 0 0 1),\n", "1e9 m or more"},
      {std::string("20,0\0,0,0,(0 0 0 1),\n", 21), "holds NUL bytes"}};
  for (const auto& [row, message] : faults) {
    EXPECT_INPUT_ERROR(import_lab(good + row), message);
    const Imported kept = import_lab(good + row + "30,0,0,0,(0 0 0 1),\n", true);
    EXPECT_EQ(kept.poses.size(), 2u) << row;
    EXPECT_EQ(kept.report.poses.fates[RowFate::bad], 1) << row;
  }
  EXPECT_INPUT_ERROR(import_lab(""), "holds a header line and no rows");
}

TEST_F(ImportedTable, WithoutAColumnOfTheMapNamesIt) {
  folder_.write("head.csv", "t,x,y,w,q\n1,0,0,0,(0 0 0 1)\n");
  EXPECT_INPUT_ERROR(import(lab(), "", folder_ / "head.csv"), "head.csv:1: has no column 'z'");
}

TEST(ColumnMaps, ThatComeWithTheProgramAreSound) {
  ASSERT_GE(built_in_maps().size(), 7u);
  for (const BuiltInMap& map : built_in_maps())
    EXPECT_EQ(parse_column_map(map.json, std::string(map.name)).name, map.name);
}

// The log of Varjo's Unity example: vectors in one field, empty where the eye was not seen.
TEST_F(ImportedTable, OfVarjoHoldsHeadAndGaze) {
  folder_.write(
      "varjo.csv",
      "Frame;CaptureTime;LogTime;HMDPosition;HMDRotation;GazeStatus;LeftEyeStatus;LeftEyeForward;"
      "RightEyeStatus;RightEyeForward\n"
      "1;5000000000;1;(0.100, 1.600, 0.200);(0.000, 0.707, 0.000, 0.707);VALID;VALID;"
      "(0.100, 0.000, 0.995);VALID;(0.000, 0.000, 1.000)\n"
      "2;5005000000;1;(0.100, 1.600, 0.200);(0.000, 0.707, 0.000, 0.707);INVALID;INVALID;;VALID;"
      "(0.000, 0.000, 1.000)\n"
      "3;5010000000;1;(0.100, 1.600, 0.200);(0.000, 0.707, 0.000, 0.707);INVALID;INVALID;;INVALID;\n");
  const Imported got = import(nullptr, "varjo", folder_ / "varjo.csv");
  ASSERT_EQ(got.poses.size(), 3u);
  EXPECT_EQ(got.poses[0].world_from_head.position, glm::dvec3(0.1, 1.6, -0.2));
  // Unity turns clockwise seen from above: 90 degrees about +y look to the right, +x. 1e-12: only the
  // normalised 0.707 enters, twice the same.
  const glm::dvec3 forward = got.poses[0].world_from_head.orientation * glm::dvec3(0, 0, -1);
  EXPECT_NEAR(forward.x, 1, 1e-12);
  ASSERT_EQ(got.gaze.size(), 3u);
  EXPECT_FALSE(got.report.gaze_combined);
  EXPECT_GT(got.gaze[0].head_direction[0].x, 0) << "to the right";
  EXPECT_LT(got.gaze[0].head_direction[0].z, -0.99) << "ahead is -z";
  EXPECT_TRUE(got.gaze[0].valid[0]);
  EXPECT_FALSE(got.gaze[1].valid[0]);
  EXPECT_TRUE(got.gaze[1].valid[1]);
  EXPECT_EQ(got.report.gaze.one_eye_rows, 1);
  EXPECT_EQ(got.report.gaze.fates[RowFate::lost_tracking], 1);
}

}  // namespace
}  // namespace herr::test
