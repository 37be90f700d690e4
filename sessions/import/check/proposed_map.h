// A column map for a recording that no preset knows, with the axes in which it looks like a person.
// Before: the roles of columns, axis_trials. After: proposal.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sessions/import/map/column_map.h"
#include "sessions/import/presets/fitting_columns.h"

namespace herr {

struct ProposedMap {
  std::optional<ColumnMap> map;  // a map to convert with, or, where there are questions, a draft of one
  StillParts still;
  std::vector<std::string> reasons, questions;
};

// `still.head`: the files hold no head. Throws InputError.
ProposedMap propose_map(const RecordingFiles& files, const StillParts& still);

}  // namespace herr
