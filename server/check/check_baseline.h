// Runs that are stored, and later runs held against them when the other program is gone.
// Before: check_command. After: a file; CheckReport.
#pragma once

#include "server/check/check_options.h"
#include "server/check/measure/time_limit.h"
#include "server/check/report/check_report.h"

namespace herr {

// Writes nothing when the machine was too restless or time ran out: the verdict is then `noisy` or
// `inconclusive`. Throws RunFailed, WriteError, UsageError when the file is there and options.overwrite is
// not set; OutOfTime where not even one run ended within the limit.
void save_baseline(const CheckOptions& options, const TimeLimit& limit, CheckReport& report);

// Throws NotComparable, RunFailed, InputError, OutOfTime.
void check_baseline(const CheckOptions& options, const TimeLimit& limit, CheckReport& report);

}  // namespace herr
