#include "sessions/import/check/matrix_columns.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "sessions/import/rows/rotation_matrix.h"

namespace herr {
namespace {

constexpr double kOrthonormal = 0.02;
constexpr std::size_t kTriedRows = 200;

bool is_rotation(const std::vector<double>& numbers, RotationKind kind, bool column_major) {
  const RecordedMatrix matrix = recorded_matrix(kind, column_major, numbers);
  return off_orthonormal(matrix.rotation) < kOrthonormal && glm::determinant(matrix.rotation) > 0 &&
         glm::length(matrix.last_row - glm::dvec4(0, 0, 0, 1)) < 1e-6;
}

bool fits(const SniffedTable& table, const MatrixColumns& columns) {
  for (std::size_t i = 0; i < columns.numbers; ++i)
    if (!table.numbers(columns.first + i)) return false;
  std::vector<double> numbers(columns.numbers);
  std::size_t good = 0, counted = 0;
  const std::size_t every = std::max<std::size_t>(1, table.fields.size() / kTriedRows);
  for (std::size_t row = 0; row < table.fields.size(); row += every) {
    for (std::size_t i = 0; i < columns.numbers; ++i) numbers[i] = table.values[columns.first + i][row];
    if (std::any_of(numbers.begin(), numbers.end(), [](double v) { return !std::isfinite(v); })) continue;
    ++counted;
    good += is_rotation(numbers, columns.kind, columns.column_major) ? 1 : 0;
    if (counted == 3 && good == 0) return false;
  }
  return counted > 1 && good * 10 >= counted * 9;
}

}  // namespace

std::vector<MatrixColumns> find_matrices(const SniffedTable& table) {
  struct Size {
    RotationKind kind;
    std::size_t numbers;
  };
  for (const Size& size : {Size{RotationKind::matrix_4x4, 16}, Size{RotationKind::matrix_3x4, 12},
                           Size{RotationKind::matrix_3x3, 9}})
    for (std::size_t first = 0; first + size.numbers <= table.columns(); ++first) {
      std::vector<MatrixColumns> found;
      for (const bool column_major : {false, true}) {
        const MatrixColumns columns{size.kind, column_major, first, size.numbers};
        if (fits(table, columns)) found.push_back(columns);
      }
      if (!found.empty()) return found;
    }
  return {};
}

}  // namespace herr
