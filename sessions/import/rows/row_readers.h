// One row of a foreign table as a pose or a gaze ray, by the columns of a map. The places of the columns are
// looked up once. Before: ForeignTable, ColumnMap. After: import_rows orders and counts the rows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/map/column_map.h"
#include "sessions/import/tables/foreign_table.h"
#include "sessions/import/import_report.h"

namespace herr {

// Columns of a map, found in a table.
class Places {
 public:
  Places() = default;
  Places(const ForeignTable& table, const ColumnGroup& group);
  std::vector<double> read(const ForeignTable& table) const;

 private:
  std::vector<std::size_t> places_;
  std::size_t numbers_ = 0;
};

class FilterReader {
 public:
  FilterReader(const ForeignTable& table, const RowFilter& filter);
  bool passes(const ForeignTable& table) const;

 private:
  struct Test {
    RowCondition condition;
    std::size_t place = 0;
    bool passes(const ForeignTable& table) const;
  };
  std::vector<Test> all_, any_;
};

// Every reader throws InputError that names line and column, and must not outlive the columns.
class HeadReader {
 public:
  HeadReader(const ForeignTable& table, const HeadColumns& columns);
  // In our axes; none where tracking was lost.
  std::optional<Pose> read(const ForeignTable& table, ImportedStream& stream) const;

 private:
  glm::dquat orientation(const ForeignTable& table, ImportedStream& stream) const;

  const HeadColumns& columns_;
  FilterReader valid_;
  Places position_, rotation_;
};

class RayReader {
 public:
  RayReader(const ForeignTable& table, const DirectionColumns& columns);
  // In the file's axes; none where the tracker had no direction.
  std::optional<glm::dvec3> read(const ForeignTable& table, ImportedStream& stream) const;

 private:
  glm::dvec3 from_angles(const ForeignTable& table) const;

  const DirectionColumns& columns_;
  FilterReader valid_;
  Places vector_, angles_;
};

// All columns that a map asks for.
std::vector<ColumnRef> columns_of(const HeadColumns& head);
std::vector<ColumnRef> columns_of(const GazeColumns& gaze);

}  // namespace herr
