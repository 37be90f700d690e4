// The beginning of a text table as it stands there: separator, decimal sign, names, fields. For a format that
// nobody has described yet. Before: a file. After: the roles of its columns (time_role.h and its neighbours).
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sessions/import/map/column_map.h"

namespace herr {

struct SniffedTable {
  TableFormat format;
  std::vector<std::string> names;  // empty: nothing names the columns; of a comment: refs go by number
  std::vector<std::vector<std::string>> fields;  // rows, then fields
  std::vector<std::vector<double>> values;       // columns, then rows; NaN: no number; empty: mostly none

  std::size_t columns() const { return values.size(); }
  // How messages and maps call a column.
  ColumnRef ref(std::size_t column) const;
  std::string called(std::size_t column) const;  // "'pos_x'", "column 3"
  // All fields of a column as numbers; null where most are no numbers. Those that are none count as NaN.
  const std::vector<double>* numbers(std::size_t column) const;
};

// At most the first 2000 rows. Throws InputError; none where it is no table of at least two columns.
std::optional<SniffedTable> sniff_table(const std::filesystem::path& file);

}  // namespace herr
