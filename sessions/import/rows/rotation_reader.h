// How the recorded body stands in one row, whatever a map says rotations are written as. Before: RowSource,
// HeadColumns. After: head_reader, which turns it into our axes.
#pragma once

#include "sessions/format/pose.h"
#include "sessions/import/map/column_map.h"
#include "sessions/import/rows/places.h"
#include "sessions/import/rows/reading_counts.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

class RotationReader {
 public:
  // `columns` must outlive the reader. Throws InputError.
  RotationReader(RowSource& rows, const HeadColumns& columns);
  // Rotations of the kinds forward_up and fixed are in our axes already, the others in those of the file.
  bool in_our_axes() const;
  // Sets the orientation, and from a matrix also the position, in the file's unit. False where the numbers
  // are absent. Throws InputError.
  bool read(const RowSource& rows, Pose& body, ReadingCounts& counts) const;

 private:
  bool read_forward_up(const RowSource& rows, glm::dquat& orientation, ReadingCounts& counts) const;

  const HeadColumns& columns_;
  Places rotation_, up_;
};

}  // namespace herr
