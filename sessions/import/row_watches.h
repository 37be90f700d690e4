// What is watched over all rows of an import and told once at the end: gravity, ids, confidence.
// Before: import_rows shows each row that counts. After: remarks of the report, or an error.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sessions/import/map/axis_directions.h"
#include "sessions/import/rows/gaze_reader.h"
#include "sessions/import/rows/head_reader.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

// Averages gravity in our axes.
class GravityWatch {
 public:
  void see(const std::optional<glm::dvec3>& gravity) {
    if (gravity) sum_ += *gravity;
  }
  // Throws InputError where it points elsewhere than down.
  void finish(const std::filesystem::path& file, const AxisDirections& world_axes) const;

 private:
  glm::dvec3 sum_{0};
};

// The id of the recording that a row belongs to.
class IdWatch {
 public:
  // Throws InputError when the column is missing.
  IdWatch(RowSource& rows, const std::optional<ColumnRef>& column);
  void see(const RowSource& rows);
  void finish(std::vector<std::string>& remarks) const;

 private:
  std::optional<std::size_t> place_;
  std::string column_, id_, from_, to_;  // from_, to_: of the first change
  bool first_ = true;
  std::int64_t changes_ = 0, line_ = 0;
};

// Confidence that never changes was not measured.
class ConfidenceWatch {
 public:
  void see(const GazeReader& reader, const RowSource& rows, const GazeRow& row);
  void finish(std::vector<std::string>& remarks) const;

 private:
  struct Ray {
    std::int64_t rows = 0;
    bool changes = false;
    std::string first;
  };
  std::array<Ray, 2> rays_;
};

}  // namespace herr
