// summary.json: what was replayed, with which settings, and how long it took. Also what --json prints.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "server/results/session_report.h"
#include "server/settings/replay_options.h"

namespace herr {

// Keys keep their order. Never NaN: an empty statistic has count 0 and null values.
nlohmann::ordered_json summary_json(const SessionReport& report, const ReplayOptions& options);
// What is replayed and how: {"session", "scene", "profile", "settings"}.
nlohmann::ordered_json subject_json(const SessionReport& report, const ReplayOptions& options);
// Of the last frame: probes by state and how much the light changes. Of the run: the rays that their update
// traced in a frame on average.
nlohmann::ordered_json probes_json(const RunStatistics& run);
// [{"name", "runs", "reason"}, ...]
nlohmann::ordered_json plan_json(const FramePlan& plan);
// Bytes by name, then their sum as "together".
nlohmann::ordered_json memory_json(const MemoryUse& use);
// {"sessions": [...], "total": {...}, "exit_code": N} of a whole run.
nlohmann::ordered_json run_json(const std::vector<SessionReport>& reports, const ReplayOptions& options,
                                int exit_code);
// Indented, with bytes that are not UTF-8 replaced, and a line break at the end.
std::string json_text(const nlohmann::ordered_json& document);

}  // namespace herr
