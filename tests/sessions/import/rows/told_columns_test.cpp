// What names of columns say, and where they contradict the map that counts columns.
#include "sessions/import/rows/told_columns.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sessions/import/rows/head_reader.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

using Kind = ToldColumn::Kind;

struct Name {
  std::string text;
  Kind kind = Kind::unknown;
  char letter = 0;
  std::string unit;
};

TEST(NamesOfColumns, SayQuantityAxisAndUnit) {
  for (const Name& name : std::vector<Name>{{"#timestamp [ns]", Kind::time, 0, "ns"},
                                            {"time(s)", Kind::time, 0, "s"},
                                            {"ts", Kind::unknown, 0, ""},
                                            {"p_RS_R_x [m]", Kind::position, 'x', "m"},
                                            {"q_RS_w []", Kind::rotation, 'w', ""},
                                            {"tz", Kind::position, 'z', ""},
                                            {"qw", Kind::rotation, 'w', ""},
                                            {"RotationY", Kind::rotation, 'y', ""},
                                            {"PosX", Kind::position, 'x', ""},
                                            {"pose.orientation.z", Kind::rotation, 'z', ""},
                                            {"transform.rotation.w", Kind::rotation, 'w', ""},
                                            {"head_pose_6", Kind::unknown, 0, ""},
                                            {"x_mm", Kind::unknown, 'x', "mm"},
                                            {"vy", Kind::velocity, 'y', ""},
                                            {"Pitch", Kind::angle, 0, ""},
                                            {"index", Kind::unknown, 0, ""}}) {
    const ToldColumn told = told_column(name.text);
    EXPECT_EQ(told.kind, name.kind) << name.text;
    EXPECT_EQ(told.letter, name.letter) << name.text;
    EXPECT_EQ(told.unit, name.unit) << name.text;
  }
}

class NumberedColumns : public ::testing::Test {
 protected:
  // Time, position in metres, quaternion, in columns 1 to 8.
  std::string contradiction(const std::string& header, const std::string& order = "wxyz",
                            const std::string& unit = "s") {
    folder_.write("log.csv", header + "\n1,0,1.6,0,1,0,0,0\n");
    const ColumnMap map = parse_column_map(
        R"({"format_version": 1, "name": "n", "note": "", "head": [{"comment": "#", "header": false,
        "time": {"column": 1, "unit": ")" +
            unit + R"("}, "position": {"columns": [2, 3, 4], "unit": "m"},
        "orientation": {"quaternion_)" +
            order + R"(": [5, 6, 7, 8]}, "world_axes": ["right", "up", "back"],
        "head_axes": ["right", "up", "back"]}]})",
        "n.json");
    const std::vector<ColumnRef> wanted = columns_of(map.head.front());
    const auto rows = open_rows(folder_ / "log.csv", map.head.front().table, wanted);
    const auto found = contradicted(*rows, map.head.front());
    return found ? found->what() : "none";
  }
  RecordedFolder folder_;
};

TEST_F(NumberedColumns, GoWithHeaderLinesOfRealFormats) {
  for (const char* header :
       {"#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],q_RS_z []",
        "#time(ns),px,py,pz,qw,qx,qy,qz", "timestamp,x,y,z,w,x,y,z", "# ts tx ty tz"})
    EXPECT_EQ(contradiction(header, "wxyz", "ns"), "none") << header;
  for (const char* header : {"#timestamp,tx,ty,tz,qx,qy,qz,qw", "# timestamp tx ty tz qx qy qz qw",
                             "time,PosX,PosY,PosZ,RotX,RotY,RotZ,RotW"})
    EXPECT_EQ(contradiction(header, "xyzw"), "none") << header;
}

TEST_F(NumberedColumns, AreContradictedByNamesOfOtherOrders) {
  EXPECT_PRED2(
      holds, contradiction("timestamp,px,py,pz,qx,qy,qz,qw"),
      "log.csv:1: calls column 5 'qx', and the format takes it for w of the rotation; give a preset");
  EXPECT_PRED2(holds, contradiction("# timestamp px py pz qx qy qz qw"), "calls column 5 'qx'");
  EXPECT_PRED2(holds, contradiction("#timestamp,tx,ty,tz,qw,qx,qy,qz", "xyzw"), "calls column 5 'qw'");
  EXPECT_PRED2(holds, contradiction("t,qx,qy,qz,qw,tx,ty,tz"),
               "calls column 2 'qx', and the format takes it for x of the position");
  EXPECT_PRED2(holds, contradiction("t,px,pz,py,qw,qx,qy,qz"),
               "column 3 'pz', and the format takes it for y");
  EXPECT_PRED2(holds, contradiction("x,y,z,qw,qx,qy,qz,t"),
               "column 1 'x', and the format takes it for the time");
  EXPECT_PRED2(holds, contradiction("t,x,y,z,roll,pitch,yaw,valid"), "column 5 'roll'");
}

TEST_F(NumberedColumns, AreContradictedByOtherUnits) {
  EXPECT_PRED2(holds, contradiction("time_ms,px,py,pz,qw,qx,qy,qz"),
               "column 1 'time_ms', and the format takes it for the time in s");
  EXPECT_PRED2(holds, contradiction("t,x [mm],y [mm],z [mm],qw,qx,qy,qz"),
               "column 2 'x [mm]', and the format takes it for x of the position in m");
}

}  // namespace
}  // namespace herr::test
