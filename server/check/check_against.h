// Pairs of fresh runs of two programs, in alternating order, until the verdict is clear.
// Before: check_command. After: CheckReport.
#pragma once

#include "server/check/check_options.h"
#include "server/check/measure/time_limit.h"
#include "server/check/report/check_report.h"

namespace herr {

// Fills `report` as it goes. Throws NotComparable, RunFailed, UsageError; OutOfTime where not even one pair
// ended within the limit.
void check_against(const CheckOptions& options, const TimeLimit& limit, CheckReport& report);

}  // namespace herr
