#include "sessions/import/presets/built_in_maps.h"

namespace herr {

std::vector<std::string> built_in_map_names() {
  std::vector<std::string> names;
  for (const BuiltInMap& map : built_in_maps()) names.emplace_back(map.name);
  return names;
}

}  // namespace herr
