// Maps with a fault: the message names the field, quotes what it holds and says what is legal.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "sessions/import/map/column_map.h"
#include "tests/sessions/import/map/map_text.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
namespace {

std::string map_error(const std::string& json) {
  return error_of([&] { (void)parse_column_map(json, "lab.json"); });
}

using Faults = std::vector<std::pair<std::string, std::string>>;  // fields, part of the message

void expect_faults(const Faults& faults, const std::string& before, const std::string& after, bool head) {
  for (const auto& [fields, message] : faults) {
    const std::string all = before + fields + after;
    EXPECT_PRED2(holds, map_error(head ? head_map(all) : gaze_map(all)), message) << fields;
  }
}

const std::string kHeadRest = ", " + kHeadPlace + ", " + kHeadTurn + ", " + kHeadAxes;

TEST(MapFaults, OfTheWholeAreNamed) {
  EXPECT_EQ(map_error(head_map(kHeadTime + kHeadRest)), "no error");
  EXPECT_PRED2(holds, map_error(R"({"format_version": 1, "name": "n", "head": []})"),
               "neither head nor gaze");
  EXPECT_PRED2(holds, map_error(R"({"format_version": 2, "name": "n"})"), "format_version");
  EXPECT_PRED2(holds, map_error(map_of(R"("heads": [])")), "did you mean 'head'?");
}

TEST(MapFaults, OfTablesAreNamed) {
  expect_faults(
      {{R"(, "handednes": "left")", "did you mean 'handedness'?"},
       {R"(, "raged": true)", "did you mean 'ragged'?"},
       {R"(, "separator": "|")", "head[0].separator is '|'; write ',', ';', 'tab', 'spaces' or 'auto'"},
       {R"(, "decimal": ",")", "head[0].decimal is ',' as the separator is; write the file's separator"},
       {R"(, "decimal": "")", "head[0].decimal is ''; write '.', ',' or 'auto'"},
       {R"(, "header": false, "header_lines": 2)", "header_lines does not go with header false"},
       {R"(, "names_line": 2)", "names_line is 2, beyond the header's 1 line"},
       {R"(, "header_lines": 0)", "header_lines is 0, out of range"},
       {R"(, "xml": "")", "xml is empty"},
       {R"(, "xml": "Row", "separator": ";")", "separator does not go with xml"},
       {R"(, "handedness": "left")", "handedness is 'left', and the axes say otherwise"},
       {R"(, "handedness": "west")", "handedness is 'west'; write 'right' or 'left'"},
       {R"(, "gravity": ["gx", "gy"])", "gravity has 2 columns; name 3 columns"},
       {R"(, "part": 0)", "part is 0, which names no column"},
       {R"(, "body_from_head": {"position": [0, 0, 0], "orientation_xyzw": [0, 0, 0, 0.5]})",
        "not of unit length but 0.5; write a unit quaternion x, y, z, w"}},
      kHeadTime + kHeadRest, "", true);
}

TEST(MapFaults, OfTimesAreNamed) {
  expect_faults(
      {{R"({"column": "t", "unit": "hr"})", "time.unit is 'hr'; write s, ms, us, ns, dotnet-ticks"},
       {R"({"column": "t"})", "time names no unit; give one of unit or date"},
       {R"({"column": "t", "unit": "s", "date": ""})", "time has both unit and date"},
       {R"({"column": "t", "unit": "s", "zone": "Z"})", "zone does not go with unit"},
       {R"({"unit": "s"})", "time names no stamps; give one of column, seconds or rate_hz"},
       {R"({"column": "t", "rate_hz": 30, "unit": "s"})", "time has both column and rate_hz"},
       {R"({"rate_hz": 30, "unit": "s"})", "unit does not go with rate_hz"},
       {R"({"rate_hz": 0})", "rate_hz is 0, out of range"},
       {R"({"seconds": "s"})", "time.nanoseconds is missing"},
       {R"({"column": "t", "unit": "s", "nanoseconds": "n"})", "nanoseconds does not go with column"},
       {R"({"column": "t", "date": "%Y-%m-%d %K"})", "time.date is '%Y-%m-%d %K', which has %K; write %Y"},
       {R"({"column": "t", "date": "%m-%d %H:%M"})", "which names no whole day"},
       {R"({"column": "t", "date": "", "zone": "Europe/Berlin"})",
        "zone is 'Europe/Berlin'; write the distance"},
       {R"({"column": "t", "unit": "s", "scale": 0})", "time.scale is 0, out of range"},
       {R"({"column": "t", "unit": "s", "scale": -1})", "time.scale is -1, out of range"},
       {R"({"column": "t", "unit": "s", "offset_s": "noon"})", "time.offset_s is 'noon'; write seconds"},
       {R"({"column": "t", "unit": "s", "offset_s": 5e9})", "time.offset_s is 5000000000.0; write seconds"},
       {R"({"column": "t", "unit": "s", "offset_s": true})", "time.offset_s is true"},
       {R"({"column": "", "unit": "s"})", "time.column is \"\", which names no column"},
       {R"({"column": 0, "unit": "s"})", "time.column is 0, which names no column"}},
      R"("time": )", kHeadRest, true);
}

TEST(MapFaults, OfRotationsAreNamed) {
  const std::string before = kHeadTime + ", " + kHeadAxes + ", " + R"("orientation": )";
  expect_faults(
      {{R"({})", "orientation names no rotation; give one of quaternion_xyzw, quaternion_wxyz"},
       {R"({"quaternion_xyzw": "q", "fixed": true})", "orientation has both quaternion_xyzw and fixed"},
       {R"({"quaternion_xyzw": ["a", "b", "c"]})", "quaternion_xyzw has 3 columns; name 4 columns"},
       {R"({"quaternion_xyzw": ["a", "b", "c", "a"]})", "names column 'a' twice"},
       {R"({"quaternion_xyz": [2, 3, 3]})", "names column 3 twice"},
       {R"({"quaternion_xyzw": "q", "unit": "deg"})", "unit does not go with quaternion_xyzw"},
       {R"({"euler_xyz": "r", "order": "xyx"})", "order is 'xyx'; write the axes in the order"},
       {R"({"euler_xyz": "r"})", "orientation.order is missing"},
       {R"({"euler_xyz": "r", "order": "xyz", "unit": "grad"})", "unit is 'grad'; write 'deg' or 'rad'"},
       {R"({"euler_xyz": "r", "order": "xyz", "sense": [1, 0, 1]})", "neither 1 nor -1"},
       {R"({"rotation_vector": "r"})", "orientation.unit is missing"},
       {R"({"rotation_vector": "r", "unit": "rad", "sense": [1, 1, 1]})",
        "sense does not go with rotation_vector"},
       {R"({"matrix_3x3": "m"})", "orientation.major is missing"},
       {R"({"matrix_3x3": "m", "major": "rows"})", "major is 'rows'; write 'row' or 'column'"},
       {R"({"matrix_3x3": "m", "major": "row", "unit": "m"})", "unit does not go with matrix_3x3"},
       {R"({"quaternion_xyz": "m", "major": "row"})", "major does not go with quaternion_xyz"},
       {R"({"forward": "f"})", "orientation.up is missing"},
       {R"({"fixed": true, "up": "u"})", "up does not go with fixed"},
       {R"({"fixed": true, "inverse": true})", "inverse does not go with fixed"},
       {R"({"forward": "f", "up": "u", "inverse": true})", "inverse does not go with forward"},
       {R"({"fixed": false})", "fixed is false"},
       {R"({"quaternions": "q"})", "did you mean 'quaternion_"}},
      before, "", true);
  for (const char* matrix : {"matrix_3x4", "matrix_4x4"}) {
    const std::string turn = R"({")" + std::string(matrix) + R"(": "m", "major": "row"})";
    EXPECT_PRED2(holds, map_error(head_map(before + turn + ", " + kHeadPlace)),
                 "the matrix of orientation holds it too");
    EXPECT_EQ(map_error(head_map(before + turn)), "no error");
  }
}

TEST(MapFaults, OfAxesAreNamed) {
  const std::string before = kHeadTime + ", " + kHeadTurn + ", ";
  expect_faults(
      {{R"("world_axes": ["right", "up", "north"], "head_axes": ["right", "up", "back"])",
        "world_axes is [\"right\",\"up\",\"north\"], which does not say"},
       {R"("world_axes": ["right", "up", "left"], "head_axes": ["right", "up", "back"])", "world_axes is"},
       {R"("world_axes": "right", "head_axes": ["right", "up", "back"])", "world_axes is \"right\""},
       {R"("world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "forward"])",
        "not of the same handedness: left and right"}},
      before, "", true);
}

TEST(MapFaults, OfFiltersAreNamed) {
  expect_faults({{R"({"column": "c"})", "valid.all[0] names no test; give one of is, is_not, one_of, above"},
                 {R"({"column": "c", "is": "1", "above": 0})", "valid.all[0] has both is and above"},
                 {R"({"column": "c", "is": 1})", "is is a number, and the whole field is compared as text"},
                 {R"({"column": "c", "one_of": []})", "one_of is no list of texts"},
                 {R"({"column": "c", "one_of": ["1", 2]})", "one_of is no list of texts"},
                 {R"({"column": "c", "has_bits": 0})", "has_bits is 0, out of range"},
                 {R"({"column": "c", "has_bits": 1.5})", "has_bits is 1.5"},
                 {R"({"column": "c", "finite": false})", "finite is false"},
                 {R"({"is": "1"})", "valid.all[0].column is missing"}},
                kHeadTime + kHeadRest + R"(, "valid": {"all": [)", "]}", true);
}

TEST(MapFaults, OfGazeAreNamed) {
  const std::string before = kHeadTime + ", " + kGazeAxes + ", ";
  expect_faults(
      {{R"("left": {"vector": "v"})", "gaze[0] names no rays for both eyes"},
       {R"("combined": {"vector": "v"}, "left": {"vector": "v"})", "left does not go with combined"},
       {R"("combined": {})",
        "combined names no direction; give one of vector, tangents, azimuth, yaw or point"},
       {R"("combined": {"vector": "v", "yaw": "y", "pitch": "p"})", "combined has both vector and yaw"},
       {R"("combined": {"vector": "v", "pitch": "p"})", "pitch does not go with vector"},
       {R"("combined": {"vector": "v", "unit": "m"})", "unit does not go with vector"},
       {R"("combined": {"vector": "v", "origin": "o"})", "origin does not go with vector"},
       {R"("combined": {"yaw": "y"})", "combined.pitch is missing"},
       {R"("combined": {"azimuth": "a", "elevation": "e"})", "combined.convention is missing"},
       {R"("combined": {"azimuth": "a", "elevation": "e", "convention": "fick"})",
        "convention is 'fick'; write 'tangents', 'spherical' or 'helmholtz'"},
       {R"("combined": {"tangents": ["a", "b", "c"]})", "tangents has 3 columns; name 2 columns"},
       {R"("combined": {"point": "p", "unit": "deg"})", "unit is 'deg'; write 'm', 'cm' or 'mm'"},
       {R"("combined": {"vector": "v", "valid_left": {}})", "has one of valid_left and valid_right"},
       {R"("combined": {"vector": "v"}, "space": "room")",
        "space is 'room'; write 'head', 'eye' or 'world'"}},
      before, "", false);
}

TEST(MapFaults, OfLayoutsAreNamed) {
  const auto layout_error = [](const std::string& layout) {
    return map_error(map_of(R"("head": [{)" + kHeadTime + kHeadRest + R"(}], "layouts": [)" + layout + "]"));
  };
  EXPECT_EQ(layout_error(R"({"head": "*/mav0/*.csv"})"), "no error");
  EXPECT_PRED2(holds, layout_error("{}"), "layouts[0] names neither head nor gaze");
  for (const char* place : {"/head.csv", "../head.csv", "a//b", "a/", "", "a\\\\b", "**/b", "a/./b"}) {
    const std::string error = layout_error(R"({"head": ")" + std::string(place) + R"("})");
    EXPECT_PRED2(holds, error, "layouts[0].head is '") << place;
  }
  EXPECT_PRED2(holds, layout_error(R"({"head": "h", "cameras": [{"stamps": "s"}]})"),
               "cameras[0].pictures is missing");
  EXPECT_EQ(layout_error(R"({"head": "h", "cameras": [{"pictures": "p", "stamps": "s", "names": "{ms}"}]})"),
            "no error");
  EXPECT_PRED2(
      holds,
      layout_error(R"({"head": "h", "cameras": [{"pictures": "a"}, {"pictures": "b"}, {"pictures": "c"}]})"),
      "cameras has 3 cameras");
}

}  // namespace
}  // namespace herr::test
