// Columns of a map, found in a file: several numbers of a row at once, without allocation.
// Before: RowSource, ColumnGroup. After: the readers of this folder.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "sessions/import/map/column_map.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

class Places {
 public:
  static constexpr std::size_t kMost = 16;

  Places() = default;
  // Throws InputError.
  Places(RowSource& rows, const ColumnGroup& group);
  Places(RowSource& rows, const std::optional<ColumnGroup>& group);
  bool empty() const { return numbers_ == 0; }
  std::size_t numbers() const { return numbers_; }
  // False when any of them is absent; `values` has numbers() elements. Throws InputError.
  bool read(const RowSource& rows, std::span<double> values) const;
  // The same of three numbers.
  bool read(const RowSource& rows, glm::dvec3& values) const;

 private:
  std::array<std::size_t, kMost> places_{};
  std::size_t columns_ = 0, numbers_ = 0;
};

// The columns that a group asks for.
void add_columns(const std::optional<ColumnGroup>& group, std::vector<ColumnRef>& columns);

}  // namespace herr
