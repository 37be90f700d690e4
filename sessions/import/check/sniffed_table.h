// The beginning of a text table as it stands there: separator, decimal sign, names, fields. For a format that
// nobody has described yet. Before: a file. After: column_roles.
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
  std::vector<std::string> names;                // empty: no header line
  std::vector<std::vector<std::string>> fields;  // rows, then fields; rows of the usual width only

  std::size_t columns() const { return fields.empty() ? 0 : fields.front().size(); }
  // How messages and maps call a column.
  ColumnRef ref(std::size_t column) const;
  // All fields of a column as numbers; none where most are no numbers. Those that are none count as NaN.
  std::optional<std::vector<double>> numbers(std::size_t column) const;
};

// At most the first 2000 rows. Throws InputError; none where it is no table of at least two columns.
std::optional<SniffedTable> sniff_table(const std::filesystem::path& file);

}  // namespace herr
