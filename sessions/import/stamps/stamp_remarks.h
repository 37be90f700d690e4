// What the clock of a stream did, in sentences for whoever converts it.
// Before: stamp_survey counts and stamp_runs chooses. After: StampSurvey::remarks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sessions/import/stamps/stamp_runs.h"
#include "sessions/import/stamps/step_pattern.h"

namespace herr {

struct ClockCounts {
  std::int64_t rows = 0;
  std::int64_t equal = 0, equal_line = 0;  // stamps like the one before, and the first of them
  TimeNs equal_ns = 0;
  std::int64_t backward = 0;
};

std::vector<std::string> stamp_remarks(const ClockCounts& clock, const StepPattern& pattern,
                                       const StampRuns& runs);

}  // namespace herr
