// The tables of a study's reports. Before: StudyRecord. After: study_page, study_text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "server/study/report/report_table.h"
#include "server/study/report/study_record.h"

namespace herr {

// What was measured, on what and how long, by name; without what is not known.
std::vector<std::pair<std::string, std::string>> study_facts(const StudyRecord& record);

ReportTable frame_table(const StudyRecord& record);
ReportTable reference_table(const StudyRecord& record);
// Numbered as in the diagram.
ReportTable front_table(const StudyRecord& record);
// One for each knob.
std::vector<ReportTable> point_tables(const StudyRecord& record);
// Stands below these: why their two columns of time can contradict.
inline constexpr const char* kTimesNote =
    "Times: ms is the median of this run's moment; time / default is of pairs timed side by side. On a busy "
    "machine the two can contradict: compare settings by time / default.";
// Of the default and the front: by band, and by all metrics.
ReportTable band_table(const StudyRecord& record);
ReportTable metric_table(const StudyRecord& record);
ReportTable fit_table(const StudyRecord& record);
ReportTable flicker_table(const StudyRecord& record);

// "NAME: measured 6.2 [5.9, 6.6], aim at least 8. How it was measured."
std::string aim_text(const StudyAim& aim);

}  // namespace herr
