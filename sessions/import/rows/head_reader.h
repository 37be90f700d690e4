// One row as a pose of the head in our axes, by the columns of a map. Before: RowSource, HeadColumns.
// After: import_rows. No allocation per row.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/rows/filter_reader.h"
#include "sessions/import/rows/places.h"
#include "sessions/import/rows/reading_counts.h"
#include "sessions/import/rows/rotation_reader.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

class HeadReader {
 public:
  // Looks the places up; `columns` must outlive the reader. Throws InputError.
  HeadReader(RowSource& rows, const HeadColumns& columns);
  // In our axes; none where tracking was lost: the row's filter says so, or its numbers are absent.
  // Throws InputError that names line and column.
  std::optional<Pose> read(const RowSource& rows, ReadingCounts& counts) const;
  // Of a row without a pose, the first column that holds no number: "px is 'nan'". Empty: all hold one.
  std::string absent_column(const RowSource& rows) const;
  // Gravity of the row in our axes, where the map names it; none where it is absent or zero.
  std::optional<glm::dvec3> gravity(const RowSource& rows) const;

 private:
  Pose to_ours(const Pose& recorded) const;

  const HeadColumns& columns_;
  FilterReader valid_;
  RotationReader rotation_;
  Places position_, gravity_;
  std::vector<ColumnRef> told_;  // of position and rotation, with their places
  std::vector<std::size_t> told_places_;
  std::optional<Pose> head_in_body_;  // body_from_head in our axes, where the body is not the head itself
};

std::vector<ColumnRef> columns_of(const HeadColumns& head);

}  // namespace herr
