// A column map as the JSON that reads back as the same map, laid out for people to edit.
// Before: a ColumnMap as parse_column_map makes it, or of the same values. After: `herr convert --check`
// proposes it.
#pragma once

#include <string>

#include "sessions/import/map/column_map.h"

namespace herr {

// Ends with a line end. Names that are not UTF-8 cannot stand in JSON: their bytes are replaced, and such
// columns are better named by number.
std::string column_map_text(const ColumnMap& map);

}  // namespace herr
