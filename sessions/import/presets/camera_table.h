// Which camera columns a table of stamps has: those of the recording's own map, or of any built-in map.
// Before: built_in_maps. After: cameras/picture_stamps reads the table.
#pragma once

#include <filesystem>

#include "sessions/import/map/column_map.h"

namespace herr {

// Throws InputError that says which columns such tables have.
CameraColumns camera_columns_of(const std::filesystem::path& table, const ColumnMap& map);

}  // namespace herr
