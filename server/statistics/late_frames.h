// How many frames were late and why, in words: for the last line of a run. Before: RunStatistics.
// After: the lines of replay and serve.
#pragma once

#include <string>

#include "server/statistics/run_statistics.h"

namespace herr {

// " (4 for the machine, 6 for the work, 2 for both)", without those that are none; empty where none was late.
std::string causes_text(const RunStatistics& statistics);

}  // namespace herr
