// How many frames a measured run has, and what a report says about such runs.
// Before: the command's options. After: check_against, check_baseline.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/check/check_options.h"
#include "server/check/measure/measured_program.h"
#include "server/check/measure/run_values.h"
#include "server/check/report/check_report.h"

namespace herr {

// Of this program, with what only tests give it.
MeasuredProgram candidate_of(const CheckOptions& options);

// As many as --frames says, or as last --run-seconds here and now: a short run finds that out. Throws as it
// does.
std::int64_t frames_of_run(const CheckOptions& options, const MeasuredProgram& candidate,
                           const TimeLimit& limit);

// "--profile xr1-half, --polar 788x384, --no-probes, ..., --threads 2": as flags that would ask for it,
// whether they were given or a preset stands for them, what somebody would look at first, and each further
// setting that has not its default.
std::string settings_line(const CheckFingerprint& fingerprint);

inline constexpr double kToldTail = 0.05;  // of bounds that decide nothing

// The times that a report tells, judged or not, from runs of both programs.
using ShiftOf = Shift (*)(std::span<const double> candidate, std::span<const double> baseline);
std::vector<CheckedTime> told_times(std::span<const RunValues> candidate, std::span<const RunValues> baseline,
                                    ShiftOf shift_of);

// The worst verdict of all counters and of the time that decides, with its reason, into the report's own.
void conclude(CheckReport& report);

}  // namespace herr
