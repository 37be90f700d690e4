// What heads every report of a study: what it is about, the machine, and the command line that measures the
// same again, as a shell takes it. Before: StudyOptions, a session that is open. After: the records.
#pragma once

#include "server/results/session_report.h"
#include "server/study/report/study_record.h"
#include "server/study/study_options.h"

namespace herr {

ReportHead report_head_of(const StudyOptions& options, const SessionReport& report);

}  // namespace herr
