// Pairs of fresh runs of two programs, in alternating order, until the verdict is clear.
// Before: check_command. After: CheckReport.
#pragma once

#include "server/check/check_options.h"
#include "server/check/report/check_report.h"

namespace herr {

// Fills `report` as it goes. Throws NotComparable, RunFailed, UsageError.
void check_against(const CheckOptions& options, CheckReport& report);

}  // namespace herr
