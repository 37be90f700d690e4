// What mirrors and glass of a scene show of the real room, and what they cannot.
// Before: inspect_report. After: inspect_text, inspect_json.
#pragma once

#include <string>
#include <vector>

#include "server/inspect/inspect_report.h"

namespace herr {

// Sentences; none where nothing virtual mirrors or lets light through, or without a plan.
std::vector<std::string> mirror_words(const InspectReport& report);

}  // namespace herr
