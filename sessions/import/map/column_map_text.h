// A column map as the JSON that reads back as the same map, laid out for people to edit.
// Before: a ColumnMap as parse_column_map makes it, or of the same values. After: `herr convert --check`
// proposes it.
#pragma once

#include <string>
#include <vector>

#include "sessions/import/map/column_map.h"

namespace herr {

// A key that nobody knows the value of yet, in each object that stands under `parent` (an array's elements
// do); empty: in any object that has it. `absent`: also where the map leaves it out.
struct OpenField {
  std::string parent, key;
  bool absent = false;
};

// Ends with a line end. `open` fields are null, which parse_column_map refuses by name;
// where axes of the head are, "handedness" is left out. Names that are not UTF-8 cannot stand in JSON: their
// bytes are replaced, and such columns are better named by number.
std::string column_map_text(const ColumnMap& map, const std::vector<OpenField>& open = {});

}  // namespace herr
