// The diagrams of a study: which points stand in which one, what its axes are, and its fits. Before:
// StudyRecord. After: study_page.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "server/diagrams/svg_plot.h"
#include "server/study/report/study_record.h"

namespace herr {

struct StudyPlot {
  Plot plot;
  std::string caption;                                    // plain text
  std::vector<std::string> lines;                         // below it: fits, as plain text
  std::vector<std::pair<MarkStyle, std::string>> legend;  // plain text
};

// Knobs in the order of their first point.
std::vector<std::string> knobs_of(const StudyRecord& record);
// The points that nothing beats, quickest first; those without time or error are left out.
std::vector<const StudyPoint*> front_of(const StudyRecord& record);
// What points are held against at endless effort: the first one; null without any.
const StudyReference* floor_reference(const StudyRecord& record);

std::string metric_label(Metric metric);
// Name, error and time of a point, for who points at its mark.
std::string point_tip(const StudyPoint& point, const std::string& error);

// All points: time against the error by one metric. With the front where it is the acuity-weighted RMSE.
StudyPlot work_precision_plot(const StudyRecord& record, Metric metric, const std::string& id);
// The points of one knob: its effort (its time, where it has no number) against its own error (its error,
// where none has one).
StudyPlot knob_plot(const StudyRecord& record, const std::string& knob, const std::string& id);

}  // namespace herr
