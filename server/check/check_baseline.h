// Runs that are stored, and later runs held against them when the other program is gone.
// Before: check_command. After: a file; CheckReport.
#pragma once

#include "server/check/check_options.h"
#include "server/check/report/check_report.h"

namespace herr {

// Writes nothing when the machine was too restless: the verdict is then `noisy`. Throws RunFailed,
// WriteError, UsageError when the file is there and options.overwrite is not set.
void save_baseline(const CheckOptions& options, CheckReport& report);

// Throws NotComparable, RunFailed, InputError.
void check_baseline(const CheckOptions& options, CheckReport& report);

}  // namespace herr
