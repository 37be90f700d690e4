// What was measured as a record. Before: measure_groups. After: every report.
#pragma once

#include "server/study/stability/report/stability_record.h"
#include "server/study/stability/stability_case.h"

namespace herr {

// The three worst that have pictures are shown: failures first, then by share of their bound.
StabilityRecord stability_record_of(const StudyOptions& options, const StabilityCase& subject,
                                    std::vector<RelationResult> results, double seconds);

}  // namespace herr
