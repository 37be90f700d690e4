// How far the time ratios of a study can be trusted: what pairs of one setting differ by, and what the
// machine gave to them. Before: rows. After: the line "Times" of the report, and `timing` of study.json.
#pragma once

#include <span>
#include <string>

#include "server/study/measure/study_row.h"
#include "server/study/report/study_record.h"

namespace herr {

// No flag makes it another setting than the one that everything is held against.
bool is_the_default(const StudyRow& row);

// spread: 1.4826 median absolute deviations of the pairs' ln ratios, from 0 for the default, whose ratio to
// itself is 1, and from the median of their row for all others; 0 without rows of two pairs. With its
// sentence.
StudyTiming timing_of(std::span<const StudyRow> rows);

// One line: by how much ratios are uncertain; where the machine was busy also why, and what to do. It was
// quiet with a spread of 5 % at most and no threads that waited for cores which others had.
std::string timing_text(const StudyTiming& timing);

}  // namespace herr
