// What a measured run depends on besides the program: settings, inputs and the machine.
// Before: open_session. After: Measurement, compared before any time is.
#pragma once

#include <string>

#include "scenes/model/scene.h"
#include "server/check/measure/measurement.h"
#include "server/results/session_report.h"
#include "server/settings/replay_options.h"

namespace herr {

// `libraries`: names and versions that run. Camera pictures count by name and size: another checkout of the
// same files is the same input. Throws InputError.
CheckFingerprint check_fingerprint(const SessionReport& report, const ReplayOptions& options,
                                   const Scene& scene, const std::string& libraries);

}  // namespace herr
