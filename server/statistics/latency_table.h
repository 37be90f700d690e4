// The table of stage times that ends a replay: one row per stage, then the whole frame.
#pragma once

#include <string>

#include "server/statistics/run_statistics.h"

namespace herr {

// Columns: mean, p50, p95, p99, max in milliseconds, and the stage's share of the frame time. Stages that
// took no time in any frame are left out. Ends with a line break.
std::string latency_table(const RunStatistics& statistics);

}  // namespace herr
