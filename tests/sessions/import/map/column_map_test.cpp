// What column maps say: every kind of time, rotation, gaze and filter; old maps keep their meaning.
#include "sessions/import/map/column_map.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/sessions/import/map/map_text.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

ColumnMap every_key() {
  return parse_column_map(kEveryKey, "every.json");
}

TEST(ColumnMaps, SayHowRowsAreCut) {
  const ColumnMap map = every_key();
  const TableFormat& table = map.head[0].table;
  EXPECT_EQ(table.separator, ';');
  EXPECT_EQ(table.decimal, ',');
  EXPECT_EQ(table.comment, "#");
  EXPECT_TRUE(table.header);
  EXPECT_EQ(table.header_lines, 3u);
  EXPECT_EQ(table.names_line, 2u);
  EXPECT_TRUE(table.ragged);
  EXPECT_EQ(map.head[1].table.separator, '\t');
  EXPECT_FALSE(map.head[1].table.header);
  EXPECT_EQ(map.head[2].table.separator, ' ');
  EXPECT_EQ(map.head[3].table.separator, '\0');
  EXPECT_EQ(map.head[3].table.decimal, '\0');
  EXPECT_EQ(map.head[4].table.xml_row, "GazeData");
  EXPECT_EQ(map.head[5].table, TableFormat{}) << "what is not said has its default";
}

TEST(ColumnMaps, SayWhatStampsAre) {
  const ColumnMap map = every_key();
  const auto& head = map.head;
  EXPECT_EQ(head[0].time.scale, 1.5);
  EXPECT_EQ(head[0].time.offset_ns, 250'000'000);
  EXPECT_EQ(head[1].time.column.number, 1u);
  EXPECT_EQ(head[1].time.unit, TimeUnit::ms);
  EXPECT_EQ(head[1].time.offset_ns, -1'700'000'000'123'456'789) << "text keeps what a double cannot";
  EXPECT_EQ(head[4].time.unit, TimeUnit::dotnet_ticks);
  EXPECT_EQ(head[5].time.unit, TimeUnit::filetime);
  EXPECT_EQ(head[6].time.kind, TimeColumns::Kind::seconds_nanoseconds);
  EXPECT_EQ(head[6].time.nanoseconds.name, "n");
  EXPECT_EQ(head[7].time.kind, TimeColumns::Kind::date);
  EXPECT_EQ(head[7].time.zone_minutes, -210);
  EXPECT_EQ(head[8].time.date_format, "");
  EXPECT_EQ(head[8].time.zone_minutes, 0);
  EXPECT_EQ(head[9].time.kind, TimeColumns::Kind::rate);
  EXPECT_EQ(head[9].time.rate_hz, 29.97);
}

TEST(ColumnMaps, SayHowTheHeadIsTurned) {
  const ColumnMap map = every_key();
  const auto& head = map.head;
  EXPECT_EQ(head[0].rotation_kind, RotationKind::euler_xyz);
  EXPECT_EQ(head[0].euler_order, "zxy");
  EXPECT_EQ(head[0].euler_sense, (std::array<int, 3>{1, -1, -1}));
  EXPECT_EQ(head[0].radians_per_unit, 1);
  EXPECT_EQ(head[1].rotation_kind, RotationKind::quaternion_xyzw);
  EXPECT_TRUE(head[1].head_from_world);
  EXPECT_EQ(head[2].rotation_kind, RotationKind::quaternion_wxyz);
  EXPECT_EQ(head[2].rotation.numbers, 4u) << "all in one field";
  EXPECT_EQ(head[3].rotation_kind, RotationKind::quaternion_xyz);
  EXPECT_EQ(head[4].rotation_kind, RotationKind::matrix_3x3);
  EXPECT_TRUE(head[4].column_major);
  EXPECT_EQ(head[5].rotation_kind, RotationKind::matrix_3x4);
  EXPECT_EQ(head[5].metres_per_unit, 0.01);
  EXPECT_EQ(head[6].rotation_kind, RotationKind::matrix_4x4);
  EXPECT_EQ(head[6].rotation.numbers, 16u);
  EXPECT_EQ(head[7].rotation_kind, RotationKind::rotation_vector);
  EXPECT_NEAR(head[7].radians_per_unit, 3.14159265358979 / 180, 1e-16);
  EXPECT_EQ(head[8].rotation_kind, RotationKind::forward_up);
  EXPECT_EQ(head[8].up.columns[2].name, "c");
  EXPECT_EQ(head[9].rotation_kind, RotationKind::fixed);
  EXPECT_FALSE(head[9].position);
}

TEST(ColumnMaps, SayWhatElseTheHeadHas) {
  const HeadColumns head = every_key().head[0];
  EXPECT_EQ(head.variant, "a");
  EXPECT_EQ(head.metres_per_unit, 0.001);
  EXPECT_EQ(head.gravity->columns[1].name, "gy");
  EXPECT_EQ(head.part->name, "graph");
  EXPECT_EQ(head.body_from_head.position, glm::dvec3(0.01, -0.2, 3));
  EXPECT_TRUE(head.world_axes.left_handed());
}

TEST(ColumnMaps, SayWhichRowsCount) {
  const RowFilter valid = every_key().head[0].valid;
  using Kind = RowCondition::Kind;
  ASSERT_EQ(valid.all.size(), 3u);
  ASSERT_EQ(valid.any.size(), 4u);
  EXPECT_EQ(valid.all[0].kind, Kind::is);
  EXPECT_EQ(valid.all[0].texts, std::vector<std::string>{"1"});
  EXPECT_EQ(valid.all[1].kind, Kind::is_not);
  EXPECT_EQ(valid.all[1].column.number, 2u);
  EXPECT_EQ(valid.all[2].kind, Kind::one_of);
  EXPECT_EQ(valid.all[2].texts, (std::vector<std::string>{"2", "3"}));
  EXPECT_EQ(valid.any[0].kind, Kind::above);
  EXPECT_EQ(valid.any[0].limit, 0.1);
  EXPECT_EQ(valid.any[1].kind, Kind::below);
  EXPECT_EQ(valid.any[2].kind, Kind::has_bits);
  EXPECT_EQ(valid.any[2].bits, 0x7fffffffffffffffu);
  EXPECT_EQ(valid.any[3].kind, Kind::finite);
}

TEST(ColumnMaps, SayWhereTheEyesLook) {
  const ColumnMap map = every_key();
  const auto& gaze = map.gaze;
  EXPECT_TRUE(gaze[0].in_head_file);
  EXPECT_EQ(gaze[0].rays.size(), 1u);
  EXPECT_EQ(gaze[0].pupils.size(), 2u);
  EXPECT_EQ(gaze[0].rays[0].placeholder, glm::dvec3(0, 0, 1));
  EXPECT_EQ(gaze[0].rays[0].confidence->name, "conf");
  EXPECT_EQ(gaze[1].space, GazeSpace::eye);
  ASSERT_EQ(gaze[1].rays.size(), 2u);
  EXPECT_EQ(gaze[1].rays[0].angle_kind, AngleKind::spherical);
  EXPECT_EQ(gaze[1].rays[1].angle_kind, AngleKind::helmholtz);
  EXPECT_EQ(gaze[1].rays[1].angles->columns[1].number, 4u);
  EXPECT_EQ(gaze[2].space, GazeSpace::world);
  EXPECT_EQ(gaze[2].rays[0].metres_per_unit, 0.001);
  EXPECT_TRUE(gaze[2].rays[0].origin);
  EXPECT_FALSE(gaze[2].rays[1].origin);
  // yaw and pitch, of older maps, are degrees and tangents.
  EXPECT_EQ(gaze[3].rays[0].angle_kind, AngleKind::tangents);
  EXPECT_NEAR(gaze[3].rays[0].radians_per_unit, 3.14159265358979 / 180, 1e-16);
  EXPECT_EQ(gaze[3].rays[1].angle_kind, AngleKind::tangents);
  EXPECT_EQ(gaze[4].rays[0].tangents->numbers, 2u);
}

TEST(ColumnMaps, SayWherePicturesAndFilesAre) {
  const ColumnMap map = every_key();
  ASSERT_EQ(map.camera.size(), 2u);
  EXPECT_EQ(map.camera[0].file->number, 2u);
  EXPECT_EQ(map.camera[0].time.unit, TimeUnit::ns);
  EXPECT_FALSE(map.camera[1].file);
  ASSERT_EQ(map.layouts.size(), 2u);
  EXPECT_EQ(map.layouts[0].head, "*/head_*.csv");
  ASSERT_EQ(map.layouts[0].cameras.size(), 2u);
  EXPECT_EQ(map.layouts[0].cameras[0].calibration, "cam0/sensor.yaml");
  EXPECT_EQ(map.layouts[0].cameras[1].names, "frame_{ms}");
  EXPECT_EQ(map.vergence_m, 0.8);
}

TEST(ColumnMaps, MayBeForGazeAlone) {
  const std::string gaze = kHeadTime + ", " + kGazeAxes + R"(, "combined": {"vector": "g"})";
  EXPECT_TRUE(parse_column_map(gaze_map(gaze), "lab.json").head.empty());
  EXPECT_TRUE(parse_column_map(map_of(R"("head": [], "gaze": [{)" + gaze + "}]"), "lab.json").head.empty());
  EXPECT_INPUT_ERROR(parse_column_map(map_of(R"("head": [], "gaze": [])"), "lab.json"),
                     "neither head nor gaze");
}

}  // namespace
}  // namespace herr::test
