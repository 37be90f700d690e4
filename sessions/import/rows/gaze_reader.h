// One row as the gaze of both eyes in our axes of the head, by the columns of a map.
// Before: RowSource, GazeColumns; gaze in world space also asks for the head's pose. After: import_rows.
// No allocation per row.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "sessions/format/pose.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/rows/filter_reader.h"
#include "sessions/import/rows/places.h"
#include "sessions/import/rows/reading_counts.h"
#include "sessions/import/tables/row_source.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

class GazeReader {
 public:
  // `columns` must outlive the reader. Throws InputError.
  GazeReader(RowSource& rows, const GazeColumns& columns);
  bool combined() const { return rays_.size() == 1; }
  bool needs_head() const { return columns_.space == GazeSpace::world; }
  // Sets directions and flags of `row`; a ray is invalid where its filter says so or its numbers are absent.
  // `world_from_head`: at the row's stamp, in our axes; null where it is not needed or tracking was lost (the
  // gaze is then lost too). `eye`: centres of the eyes in the head, for points in head or world space without
  // an origin of their own: for combined gaze the head's origin. Throws InputError.
  void read(const RowSource& rows, const Pose* world_from_head, const std::array<glm::dvec3, 2>& eye,
            GazeRow& row, ReadingCounts& counts) const;
  // Of the current row: what the confidence columns hold, as text; nothing where the map names none.
  std::optional<std::string_view> confidence(const RowSource& rows, std::size_t ray) const;

 private:
  struct Ray {
    const DirectionColumns* columns = nullptr;
    FilterReader valid;
    Places direction;  // vector, tangents or angles
    Places point, origin;
    std::optional<std::size_t> confidence;
  };
  // In our axes of the head; none where the tracker had no direction.
  std::optional<glm::dvec3> direction(const RowSource& rows, const Ray& ray, const Pose* world_from_head,
                                      const glm::dvec3& eye, ReadingCounts& counts) const;
  std::optional<glm::dvec3> towards_point(const RowSource& rows, const Ray& ray, const Pose* world_from_head,
                                          const glm::dvec3& eye) const;

  const GazeColumns& columns_;
  std::vector<Ray> rays_;
  std::vector<FilterReader> pupils_;
};

std::vector<ColumnRef> columns_of(const GazeColumns& gaze);

}  // namespace herr
