// The settings of a run as a reader of its results finds them: as JSON, and as one line of text.
// Before: the lists of settings (renderer/settings_list.h, server/settings/run_settings.h).
// After: summary.json and /v1/status; file headers and reports.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "renderer/render_settings.h"
#include "server/results/session_report.h"
#include "server/settings/replay_options.h"

namespace herr {

// The options with what they left to session and machine filled in: threads, instruction set, profile.
ReplayOptions resolved_options(const ReplayOptions& options, const SessionReport& report);

// Every setting by its name. Widths of polar buffers are those of one eye there, as they always were.
nlohmann::ordered_json settings_json(const ReplayOptions& resolved);

// One line for file headers that tells two runs apart whose settings give other pictures: what most readers
// look for, and each further setting that has not its default. What means nothing is not told: the polar
// buffer without foveation, the camera in a session that has none.
std::string settings_text(const ReplayOptions& resolved, bool session_has_camera);
// The same for the headline of a run, which states threads and instruction set beside it.
std::string headline_text(const ReplayOptions& options, const SessionReport& report);
// The same of a render alone, without the instruction set: for reports that state it beside.
std::string settings_text(const RenderSettings& settings, bool session_has_camera);
// The same without the size of the polar buffer and the number of light samples.
std::string features_text(const RenderSettings& settings, bool session_has_camera);

}  // namespace herr
