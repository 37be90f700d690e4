// What a run measured as the record that reports are made of. Before: study_run. After: study_json,
// study_text, study_page.
#pragma once

#include "server/study/report/study_record.h"
#include "server/study/study_run.h"

namespace herr {

// Renders a few settings once more at the first frame, for pictures of their differences.
StudyRecord record_of(const StudyOptions& options, StudySubject& subject, StudyRun& run);

}  // namespace herr
