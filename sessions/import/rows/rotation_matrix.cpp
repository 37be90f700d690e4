#include "sessions/import/rows/rotation_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>

#include "sessions/import/rows/unit_length.h"

namespace herr {
namespace {

constexpr double kLastRowSlack = 1e-6;
// Columns are of one length where they differ by less: a scale, not a shear.
constexpr double kScaleSlack = 0.01;

bool ends_well(const RecordedMatrix& matrix) {
  const glm::dvec4 off = glm::abs(matrix.last_row - glm::dvec4(0, 0, 0, 1));
  return std::max(std::max(off.x, off.y), std::max(off.z, off.w)) <= kLastRowSlack;
}

bool is_rotation(const RecordedMatrix& matrix) {
  return ends_well(matrix) && off_orthonormal(matrix.rotation) <= kUnitSlack &&
         glm::determinant(matrix.rotation) > 0;
}

std::string lengths_of(const glm::dmat3& m) {
  return short_number(glm::length(m[0])) + ", " + short_number(glm::length(m[1])) + " and " +
         short_number(glm::length(m[2]));
}

bool is_scaled(const glm::dmat3& m) {
  const double length = glm::length(m[0]);
  return length > 0 && off_orthonormal(m / length) < kScaleSlack;
}

[[noreturn]] void refuse_rotation(const RowSource& rows, const RecordedMatrix& matrix) {
  const glm::dmat3& m = matrix.rotation;
  if (m == glm::dmat3(0.0))
    rows.fail("the rotation matrix is zero",
              "where that means lost tracking, leave such rows out by valid in the map");
  if (!ends_well(matrix))
    rows.fail("the last row of the matrix is " + short_number(matrix.last_row.x) + " " +
                  short_number(matrix.last_row.y) + " " + short_number(matrix.last_row.z) + " " +
                  short_number(matrix.last_row.w) + ", not 0 0 0 1",
              "check the columns of the map; its major says whether numbers go by rows or by columns");
  if (off_orthonormal(m) <= kUnitLimit)
    rows.fail("the rotation matrix mirrors (determinant -1)",
              "check handedness and axes: one row or column has the other sign than the map says");
  if (is_scaled(m))
    rows.fail("the rotation matrix scales by " + short_number(glm::length(m[0])),
              "export poses without scale, or divide the scale out");
  rows.fail("the matrix is no rotation: its columns have the lengths " + lengths_of(m) +
                " and are off a right angle by up to " + short_number(off_orthonormal(m)),
            "check the columns of the map, or remove the line");
}

// Numbers that are a rotation in the other order are named as that.
[[noreturn]] void refuse_matrix(const RowSource& rows, RotationKind kind, bool column_major,
                                std::span<const double> numbers) {
  if (is_rotation(recorded_matrix(kind, !column_major, numbers)))
    rows.fail(std::string("the numbers are no rotation matrix by ") + (column_major ? "columns" : "rows") +
                  ", and are one by " + (column_major ? "rows" : "columns"),
              std::string("write \"major\": \"") + (column_major ? "row" : "column") +
                  "\" into the orientation of the map");
  refuse_rotation(rows, recorded_matrix(kind, column_major, numbers));
}

}  // namespace

RecordedMatrix recorded_matrix(RotationKind kind, bool column_major, std::span<const double> numbers) {
  const std::size_t height = kind == RotationKind::matrix_4x4 ? 4 : 3;
  const std::size_t width = kind == RotationKind::matrix_3x3 ? 3 : 4;
  const std::size_t row_step = column_major ? 1 : width, column_step = column_major ? height : 1;
  RecordedMatrix matrix;
  for (std::size_t column = 0; column < width; ++column) {
    const double* top = &numbers[column * column_step];
    const glm::dvec3 three(top[0], top[row_step], top[2 * row_step]);
    const auto place = static_cast<glm::length_t>(column);
    (column < 3 ? matrix.rotation[place] : matrix.position) = three;
    if (height == 4) matrix.last_row[place] = top[3 * row_step];
  }
  return matrix;
}

double off_orthonormal(const glm::dmat3& m) {
  const auto length_off = [](const glm::dvec3& v) { return std::abs(glm::dot(v, v) - 1) / 2; };
  const double lengths = std::max(length_off(m[0]), std::max(length_off(m[1]), length_off(m[2])));
  const double angles = std::max(std::abs(glm::dot(m[0], m[1])),
                                 std::max(std::abs(glm::dot(m[1], m[2])), std::abs(glm::dot(m[2], m[0]))));
  return std::max(lengths, angles);
}

glm::dmat3 nearest_rotation(glm::dmat3 m) {
  // Newton-Schulz: the error is squared by each step.
  constexpr int kMostSteps = 8;
  constexpr double kExact = 1e-15;
  for (int step = 0; step < kMostSteps && off_orthonormal(m) > kExact; ++step)
    m = m * (glm::dmat3(3.0) - glm::transpose(m) * m) * 0.5;
  return m;
}

Pose matrix_pose(const RowSource& rows, RotationKind kind, bool column_major, std::span<const double> numbers,
                 ReadingCounts& counts) {
  RecordedMatrix matrix = recorded_matrix(kind, column_major, numbers);
  const double off = off_orthonormal(matrix.rotation);
  if (!(off <= kUnitLimit) || !ends_well(matrix) || !(glm::determinant(matrix.rotation) > 0))
    refuse_matrix(rows, kind, column_major, numbers);
  if (off > kUnitRounding) matrix.rotation = nearest_rotation(matrix.rotation);
  if (off > kUnitSlack) ++counts.normalised;
  return {matrix.position, glm::normalize(glm::quat_cast(matrix.rotation))};
}

}  // namespace herr
