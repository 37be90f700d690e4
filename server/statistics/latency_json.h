// Latency statistics as JSON, and what each of their names means.
// Before: RunStatistics of a run or of a window. After: summary.json, GET /v1/latency.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/settings/replay_clock.h"
#include "server/statistics/run_statistics.h"

namespace herr {

// Count, mean, extremes and quantiles in the unit that was added, milliseconds mostly. An empty one has count
// 0 and null values, never NaN.
nlohmann::ordered_json distribution_json(const LatencyHistogram& values);

// Milliseconds; keys keep their order.
nlohmann::ordered_json latencies_json(const RunStatistics& statistics);
// Totals of a frame's counters, and values that were not finite in pictures.
nlohmann::ordered_json counters_json(const RunStatistics& statistics);
// {"rendered", "missed", "missed_by_machine", "missed_by_work", "missed_by_both", "over_target", "dropped",
// "repeated"}.
nlohmann::ordered_json frame_counts_json(const RunStatistics& statistics);
// {"name": "what it counts", ...} of each of these.
nlohmann::ordered_json count_definitions_json(ReplayClock clock);
// {"name": "its formula", ...} of every distribution, of the pace and of the counts of frames.
nlohmann::ordered_json definitions_json(ReplayClock clock);

}  // namespace herr
