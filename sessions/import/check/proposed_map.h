// A column map for a table that no preset knows, tried with the axes of every convention. Before:
// column_roles. After: proposal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sessions/import/map/column_map.h"
#include "sessions/import/presets/fitting_columns.h"

namespace herr {

struct ProposedMap {
  std::optional<ColumnMap> map;  // none: cannot tell
  std::vector<std::string> reasons, questions;
};

ProposedMap propose_map(const RecordingFiles& files);

}  // namespace herr
