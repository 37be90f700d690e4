// What frames and process take of the machine, as JSON and as a line of text: CPU time, cores, memory.
// Before: RunStatistics, process_load(). After: summary.json, the table on stdout, GET /v1/latency,
// /v1/status.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "server/process/process_load.h"
#include "server/statistics/run_statistics.h"

namespace herr {

// CPU time over wall time of all `cores`; none where either is not known.
std::optional<double> cpu_share(double cpu_ms, double wall_ms, int cores);

// {"cores", "cpu" (of a frame, with its "unit", "ms"), "cpu_share", "preemptions",
// "peak_resident_bytes"}; null: not told.
nlohmann::ordered_json load_json(const RunStatistics& statistics, const ProcessLoad& load);
nlohmann::ordered_json load_definitions_json();

// "152.3 ms of CPU for each frame, 97.8 % of 2 cores"; "n/a" in place of what is not told.
std::string cpu_text(std::optional<double> cpu_ms, double wall_ms, int cores);
std::string cpu_text(const RunStatistics& statistics, int cores);
// "533.0 MB", "n/a".
std::string peak_text(const ProcessLoad& load);

}  // namespace herr
