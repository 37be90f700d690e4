// The report of a study as one HTML file without scripts and without anything from elsewhere: diagrams are
// SVG, pictures are part of it. Readable on a phone and on paper. Before: StudyRecord. After: study.html.
#pragma once

#include <string>

#include "server/study/report/study_record.h"

namespace herr {

std::string study_page(const StudyRecord& record);

}  // namespace herr
