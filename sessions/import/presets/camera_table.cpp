#include "sessions/import/presets/camera_table.h"

#include <algorithm>
#include <compare>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sessions/files/input_error.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/rows/time_reader.h"
#include "sessions/import/tables/row_source.h"

namespace herr {
namespace {

// How well columns fit a table, compared in this order.
struct TableFit {
  bool names_pictures = false;
  std::size_t named_columns = 0;  // asked for by name: the more, the less it fits by accident
  auto operator<=>(const TableFit&) const = default;
};

// None: a column is missing, or the first row has no stamp.
std::optional<TableFit> table_fit(const std::filesystem::path& table, const CameraColumns& columns) {
  std::vector<ColumnRef> wanted = columns.lens;
  add_columns(columns.time, wanted);
  if (columns.file) wanted.push_back(*columns.file);
  try {
    const std::unique_ptr<RowSource> rows = open_rows(table, columns.table, wanted);
    for (const ColumnRef& column : wanted)
      if (!rows->has(column)) return std::nullopt;
    TimeReader time(*rows, columns.time);
    if (!rows->next()) return std::nullopt;
    (void)time.read(*rows);
  } catch (const InputError&) {  // some other table
    return std::nullopt;
  }
  const auto named =
      std::count_if(wanted.begin(), wanted.end(), [](const ColumnRef& column) { return column.number == 0; });
  return TableFit{columns.file.has_value(), static_cast<std::size_t>(named)};
}

}  // namespace

CameraTableColumns camera_columns_of(const std::filesystem::path& table, const ColumnMap& map) {
  for (const CameraColumns& columns : map.camera)
    if (table_fit(table, columns)) return {columns, ""};
  CameraTableColumns best;
  std::optional<TableFit> best_fit;
  for (const BuiltInMap& built_in : built_in_maps()) {
    const ColumnMap other = parse_column_map(built_in.json, std::string(built_in.name) + ".json");
    for (const CameraColumns& columns : other.camera) {
      const std::optional<TableFit> fit = table_fit(table, columns);
      if (!fit || (best_fit && *fit <= *best_fit)) continue;
      best = {columns, std::string(built_in.name)};
      best_fit = fit;
    }
  }
  if (best_fit) return best;
  throw InputError(
      table, 0, "has the columns of no table of camera stamps that is known",
      "write rows of 'nanoseconds,file name' below the line '#timestamp [ns],filename', or say the "
      "columns in \"camera\" of a --map");
}

}  // namespace herr
