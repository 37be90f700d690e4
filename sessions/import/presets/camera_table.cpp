#include "sessions/import/presets/camera_table.h"

#include <algorithm>
#include <optional>
#include <string>

#include "sessions/files/input_error.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/rows/time_reader.h"
#include "sessions/import/tables/row_source.h"

namespace herr {
namespace {

// How many of the columns are asked for by name, where all are there and the first row has a stamp.
std::optional<std::size_t> named_columns(const std::filesystem::path& table, const CameraColumns& columns) {
  std::vector<ColumnRef> wanted;
  add_columns(columns.time, wanted);
  if (columns.file) wanted.push_back(*columns.file);
  wanted.insert(wanted.end(), columns.lens.begin(), columns.lens.end());
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
  return static_cast<std::size_t>(std::count_if(wanted.begin(), wanted.end(),
                                                [](const ColumnRef& column) { return column.number == 0; }));
}

}  // namespace

CameraColumns camera_columns_of(const std::filesystem::path& table, const ColumnMap& map) {
  for (const CameraColumns& columns : map.camera)
    if (named_columns(table, columns)) return columns;
  std::optional<CameraColumns> best;
  std::size_t most = 0;
  for (const BuiltInMap& built_in : built_in_maps()) {
    const ColumnMap other = parse_column_map(built_in.json, std::string(built_in.name) + ".json");
    for (const CameraColumns& columns : other.camera) {
      const auto named = named_columns(table, columns);
      if (!named || (best && *named <= most)) continue;
      best = columns;
      most = *named;
    }
  }
  if (best) return *best;
  throw InputError(
      table, 0, "has the columns of no table of camera stamps that is known",
      "write rows of 'nanoseconds,file name' below the line '#timestamp [ns],filename', or say the "
      "columns in \"camera\" of a --map");
}

}  // namespace herr
