// One measured run: frames as fast as they go, the calibration beside each, counters; nothing is written.
// Before: a process that does nothing else. After: Measurement, printed as JSON.
#pragma once

#include "server/check/measure/measure_options.h"
#include "server/check/measure/measurement.h"

namespace herr {

// Frames that warm caches up and are not measured, of a run of `frames`.
std::int64_t warm_up_frames(std::int64_t frames);

// Throws as open_session; UsageError where a run has less than two frames.
Measurement measure_run(const MeasureOptions& options);

}  // namespace herr
