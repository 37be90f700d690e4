// Which camera columns a table of stamps has: those of the recording's own map, or of any built-in map.
// Before: built_in_maps. After: cameras/picture_stamps reads the table.
#pragma once

#include <filesystem>
#include <string>

#include "sessions/import/map/column_map.h"

namespace herr {

struct CameraTableColumns {
  CameraColumns columns;
  std::string preset;  // whose they are; empty: the recording's own map's
};

// Throws InputError that says which columns such tables have.
CameraTableColumns camera_columns_of(const std::filesystem::path& table, const ColumnMap& map);

}  // namespace herr
