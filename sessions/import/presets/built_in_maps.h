// The column maps that come with the program: the files of maps/, compiled in.
// Before: `convert --preset NAME`. After: parse_column_map.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace herr {

struct BuiltInMap {
  std::string_view name;  // of the file, without .json
  std::string_view json;
};

// Sorted by name.
const std::vector<BuiltInMap>& built_in_maps();
std::vector<std::string> built_in_map_names();

}  // namespace herr
