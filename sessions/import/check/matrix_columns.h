// Columns side by side whose numbers are a rotation matrix in every row. Before: sniffed_table. After:
// rotation_roles.
#pragma once

#include <cstddef>
#include <vector>

#include "sessions/import/check/sniffed_table.h"
#include "sessions/import/map/column_map.h"

namespace herr {

struct MatrixColumns {
  RotationKind kind = RotationKind::matrix_4x4;
  bool column_major = false;
  std::size_t first = 0, numbers = 16;
};

// The first matrix of the table, the largest kind that fits: by rows and by columns where the numbers do not
// tell (a turned round 3x3 is a rotation too).
std::vector<MatrixColumns> find_matrices(const SniffedTable& table);

}  // namespace herr
