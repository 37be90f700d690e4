// The stability report for a terminal. Before: StabilityRecord. After: stdout.
#pragma once

#include <string>

#include "server/study/stability/report/stability_record.h"

namespace herr {

// What fails first, then a table of each group, what was not asked and why, and the verdict in the last
// lines. Lines of at most 118 columns.
std::string stability_text(const StabilityRecord& record);

}  // namespace herr
