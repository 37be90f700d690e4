// The report of a study for a terminal. Before: StudyRecord. After: stdout.
#pragma once

#include <string>

#include "server/study/report/study_record.h"

namespace herr {

// Aims that were missed first, then advice, points by knob, fits, references, what was dropped or left out.
// Lines of at most 118 columns.
std::string study_text(const StudyRecord& record);

}  // namespace herr
