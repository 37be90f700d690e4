// The report of `herr inspect` for programs: one document with every number of the text.
// The schema stands in README.md of this folder. Unknown values are null, never NaN.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/inspect/inspect_report.h"

namespace herr {

nlohmann::ordered_json inspect_json(const InspectReport& report);

}  // namespace herr
