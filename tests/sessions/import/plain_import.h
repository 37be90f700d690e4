// Imports small tables that a test wrote through a plain map: seconds, metres, quaternions, our axes.
// Before: RecordedFolder. After: the tests of import_rows.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sessions/import/import_rows.h"
#include "sessions/text/fixed_text.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {
// Seconds, metres, quaternion, all in our axes; gaze as vectors in a file of its own.
inline constexpr const char* kMap = R"({
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

inline const std::string kHead = "t,x,y,z,qx,qy,qz,qw\n";
inline const std::string kGaze = "t,gx,gy,gz\n";

inline std::string pose(double t, double x = 0) {
  return fixed_text(t, 6) + "," + fixed_text(x, 6) + ",1.6,0,0,0,0,1\n";
}
inline std::string gaze(double t, const std::string& direction = "0,0,-1") {
  return fixed_text(t, 6) + "," + direction + "\n";
}
inline std::string poses(int count, double first = 1, double step = 1.0 / 90) {
  std::string text;
  for (int i = 0; i < count; ++i) text += pose(first + i * step, 0.001 * i);
  return text;
}

class PlainImport : public ::testing::Test {
 protected:
  // The map with further fields of the head, of the ray and of the gaze.
  void use_map(const std::string& head, const std::string& ray = "", const std::string& more = "") {
    std::string json = kMap;
    for (const auto& [word, text] :
         {std::pair<std::string, std::string>{"HEAD", head}, {"GAZE", ray}, {"MORE", more}})
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
inline std::string fates(const ImportedStream& stream) {
  std::string text;
  for (std::size_t i = 0; i < kRowFates; ++i)
    if (stream.fates.rows[i] > 0)
      text += (text.empty() ? "" : ", ") + std::string(row_fate_texts()[i].key) + " " +
              std::to_string(stream.fates.rows[i]) + "@" + std::to_string(stream.fates.lines[i][0]);
  return text;
}

inline std::string all(const std::vector<std::string>& texts) {
  std::string together;
  for (const std::string& text : texts) together += (together.empty() ? "" : "\n") + text;
  return together;
}

}  // namespace herr::test
