// Rotation matrices as files hold them, 3x3, 3x4 and 4x4 by rows or by columns, checked and as quaternions.
// Before: the numbers of a row. After: rotation_reader.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "sessions/import/map/column_map.h"
#include "sessions/import/rows/reading_counts.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

struct RecordedMatrix {
  glm::dmat3 rotation{1.0};
  glm::dvec3 position{0.0};         // of 3x4 and 4x4, in the file's unit
  glm::dvec4 last_row{0, 0, 0, 1};  // of 4x4
};

// `numbers` has 9, 12 or 16 of them, as `kind` (one of the three matrices) says.
RecordedMatrix recorded_matrix(RotationKind kind, bool column_major, std::span<const double> numbers);

// How far `m` is from orthonormal: the most by which a column's length or the product of two columns is off.
double off_orthonormal(const glm::dmat3& m);

// The rotation that differs least from `m` (the orthogonal factor of its polar decomposition), for matrices
// that are off by kUnitLimit at most and do not mirror.
glm::dmat3 nearest_rotation(glm::dmat3 m);

// The pose that the numbers stand for. Counts a matrix that is off by more than rounding; throws InputError
// where it is none of a rotation, and says what it is instead: by columns, scaled, mirrored.
Pose matrix_pose(const RowSource& rows, RotationKind kind, bool column_major, std::span<const double> numbers,
                 ReadingCounts& counts);

}  // namespace herr
