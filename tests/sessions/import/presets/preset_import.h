// Imports files that a test wrote through a built-in map, as `herr convert --preset` does; text of their
// numbers. Before: RecordedFolder. After: the tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/import_rows.h"
#include "sessions/import/presets/choose_format.h"
#include "tests/sessions/recorded_folder.h"

namespace herr::test {

struct PresetImport {
  ChosenFormat format;
  ImportReport report;
  std::vector<PoseRow> poses;
  std::vector<GazeRow> gaze;

  glm::dvec3 forward(std::size_t row) const { return turned(row, {0, 0, -1}); }
  glm::dvec3 up(std::size_t row) const { return turned(row, {0, 1, 0}); }
  glm::dvec3 position(std::size_t row) const { return poses.at(row).world_from_head.position; }
  glm::dvec3 turned(std::size_t row, const glm::dvec3& v) const {
    return poses.at(row).world_from_head.orientation * v;
  }
  int valid(std::size_t eye) const {
    int count = 0;
    for (const GazeRow& row : gaze) count += row.valid[eye];
    return count;
  }
};

inline void expect_near(const glm::dvec3& got, const glm::dvec3& expected, double tolerance) {
  EXPECT_LE(glm::length(got - expected), tolerance)
      << "got " << got.x << ", " << got.y << ", " << got.z << "; expected " << expected.x << ", "
      << expected.y << ", " << expected.z;
}

class PresetFiles : public ::testing::Test {
 protected:
  PresetImport import(const std::string& preset, const std::string& head,
                      const std::optional<std::string>& gaze = {},
                      const std::shared_ptr<const ColumnMap>& map = nullptr) const {
    PresetImport got;
    RecordingFiles files{folder_ / head, {}};
    if (gaze) files.gaze = folder_ / *gaze;
    const FormatRequest request{files, preset, map, "", {}};
    got.format = choose_format(request);
    got.report = import_rows(import_request(request, got.format.format.columns),
                             {[&](const PoseRow& row) { got.poses.push_back(row); },
                              [&](const GazeRow& row) { got.gaze.push_back(row); }});
    return got;
  }
  RecordedFolder folder_;
};

inline std::string joined(std::initializer_list<double> numbers, const std::string& separator = ",") {
  std::string text;
  for (const double number : numbers) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.9f", number);
    text += (text.empty() ? "" : separator) + buffer;
  }
  return text;
}

// A direction as `separator`-joined numbers, of length 1.
inline std::string unit(const glm::dvec3& v, const std::string& separator = ",") {
  const glm::dvec3 n = glm::normalize(v);
  return joined({n.x, n.y, n.z}, separator);
}

}  // namespace herr::test
