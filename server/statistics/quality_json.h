// What the policy chose, how well feed and objects agree, and how even the frames were, as JSON.
// Before: RunStatistics of a run or of a window. After: summary.json, GET /v1/latency, GET /v1/status.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "server/statistics/run_statistics.h"

namespace herr {

// {"polar_width": {count, mean, min, ... p99.9}, "light_samples": ..., "head_deg_s": ..., "reasons": {name:
// frames}}. Reasons that no frame had are left out.
nlohmann::ordered_json quality_json(const RunStatistics& statistics);
// Angles in arc minutes.
nlohmann::ordered_json feed_json(const RunStatistics& statistics);
// Stutter and the three 1 % lows.
nlohmann::ordered_json pace_json(const RunStatistics& statistics);

// {"name": "its formula", ...} of everything in pace_json(); statistics_rows.h has those of the others.
nlohmann::ordered_json pace_definitions_json();

}  // namespace herr
