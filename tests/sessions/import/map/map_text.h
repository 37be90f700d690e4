// Column maps for tests: a small one of which a test changes what it is about, and one that uses every key.
#pragma once

#include <string>

namespace herr::test {

// A head without its time, and a whole map.
inline const std::string kHeadPlace = R"("position": {"columns": ["x", "y", "z"], "unit": "mm"})";
inline const std::string kHeadTime = R"("time": {"column": "t", "unit": "ms"})";
inline const std::string kHeadTurn = R"("orientation": {"quaternion_xyzw": "q"})";
inline const std::string kHeadAxes =
    R"("world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"])";
inline const std::string kGazeAxes = R"("axes": ["right", "up", "forward"])";

inline std::string map_of(const std::string& fields) {
  return R"({"format_version": 1, "name": "lab", )" + fields + "}";
}
inline std::string head_map(const std::string& fields) {
  return map_of(R"("head": [{)" + fields + "}]");
}
inline std::string gaze_map(const std::string& fields) {
  return map_of(R"("gaze": [{)" + fields + "}]");
}

// Every key of the schema and every word of each.
inline const std::string kEveryKey = R"({
  "format_version": 1, "name": "every", "note": "uses \"all\" of it: ü",
  "head": [
    {"variant": "a", "separator": ";", "decimal": ",", "comment": "#", "header": true, "header_lines": 3, "names_line": 2,
     "ragged": true, "time": {"column": "t", "unit": "s", "scale": 1.5, "offset_s": 0.25},
     "position": {"columns": ["x", "y", "z"], "unit": "mm"},
     "orientation": {"euler_xyz": ["rx", "ry", "rz"], "unit": "rad", "order": "zxy", "sense": [1, -1, -1]},
     "world_axes": ["right", "up", "forward"], "head_axes": ["right", "up", "forward"], "handedness": "left",
     "body_from_head": {"position": [0.01, -0.2, 3], "orientation_xyzw": [0.1, 0.2, 0.3, 0.9273618495495703]},
     "gravity": ["gx", "gy", "gz"], "part": "graph",
     "valid": {"all": [{"column": "a", "is": "1"}, {"column": 2, "is_not": ""}, {"column": "c", "one_of": ["2", "3"]}],
               "any": [{"column": "d", "above": 0.1}, {"column": "e", "below": -1e-7},
                       {"column": "f", "has_bits": 9223372036854775807}, {"column": "g", "finite": true}]}},
    {"separator": "tab", "header": false, "time": {"column": 1, "unit": "ms", "offset_s": "-1700000000.123456789"},
     "position": {"columns": 2, "unit": "cm"}, "orientation": {"quaternion_xyzw": [3, 4, 5, 6], "inverse": true},
     "world_axes": ["right", "forward", "up"], "head_axes": ["left", "up", "forward"]},
    {"separator": "spaces", "time": {"column": "t", "unit": "us", "offset_s": -7}, "orientation": {"quaternion_wxyz": "q"},
     "world_axes": ["down", "right", "back"], "head_axes": ["right", "up", "back"]},
    {"separator": "auto", "decimal": "auto", "time": {"column": "t", "unit": "ns"},
     "orientation": {"quaternion_xyz": ["a", "b", "c"]},
     "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]},
    {"xml": "GazeData", "decimal": ",", "time": {"column": "@TimeStamp", "unit": "dotnet-ticks"},
     "orientation": {"matrix_3x3": "Pose@Rotation", "major": "column"},
     "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]},
    {"time": {"column": "t", "unit": "filetime"}, "orientation": {"matrix_3x4": "m", "major": "row", "unit": "cm"},
     "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]},
    {"time": {"seconds": "s", "nanoseconds": "n"}, "orientation": {"matrix_4x4": "m", "major": "row"},
     "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]},
    {"time": {"column": "t", "date": "%d.%m.%Y %H:%M:%S.%f", "zone": "-03:30"},
     "orientation": {"rotation_vector": ["a", "b", "c"], "unit": "deg"},
     "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]},
    {"time": {"column": "t", "date": "", "zone": "Z"}, "orientation": {"forward": "f", "up": ["a", "b", "c"]},
     "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]},
    {"time": {"rate_hz": 29.97}, "orientation": {"fixed": true},
     "world_axes": ["right", "up", "back"], "head_axes": ["right", "up", "back"]}
  ],
  "gaze": [
    {"variant": "a", "in_head_file": true, "separator": ";", "time": {"column": "t", "unit": "ms"}, "space": "head",
     "axes": ["right", "up", "forward"],
     "combined": {"vector": "g", "placeholder": [0, 0, 1], "confidence": "conf",
                  "valid": {"any": [{"column": "p", "above": 0}]},
                  "valid_left": {"all": [{"column": "l", "is": "1"}]}, "valid_right": {}}},
    {"time": {"column": "t", "unit": "ms"}, "space": "eye", "axes": ["left", "up", "forward"],
     "left": {"azimuth": "az", "elevation": "el", "unit": "deg", "convention": "spherical"},
     "right": {"azimuth": 3, "elevation": 4, "unit": "rad", "convention": "helmholtz"}},
    {"time": {"column": "t", "unit": "ms"}, "space": "world", "axes": ["right", "up", "forward"],
     "left": {"point": ["a", "b", "c"], "unit": "mm", "origin": "o"}, "right": {"point": "p", "confidence": 9}},
    {"time": {"column": "t", "unit": "ms"}, "axes": ["right", "up", "forward"],
     "left": {"yaw": "y", "pitch": "p"}, "right": {"azimuth": "y2", "elevation": "p", "convention": "tangents"}},
    {"time": {"column": "t", "unit": "ms"}, "axes": ["right", "up", "forward"], "combined": {"tangents": ["a", "b"]}}
  ],
  "camera": [{"comment": "#", "header": false, "time": {"column": 1, "unit": "ns"}, "file": 2},
             {"time": {"column": "t", "unit": "s"}}],
  "layouts": [
    {"head": "*/head_*.csv", "gaze": "gaze.csv",
     "cameras": [{"pictures": "cam0/data", "stamps": "cam0/data.csv", "calibration": "cam0/sensor.yaml"},
                 {"pictures": ".", "names": "frame_{ms}"}]},
    {"gaze": "g.txt"}],
  "vergence_m": 0.8
})";

}  // namespace herr::test
