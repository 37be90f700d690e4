// From rows, one for each setting and frame, to points, one for each setting. Before: measure_setting, or
// study.csv read again. After: fits, front, advice and the report.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/study/measure/study_row.h"
#include "server/study/report/study_record.h"

namespace herr {

// In the order in which settings first occur. Errors over frames (metrics.h), times of all pairs together
// (paired_ratio; exactly 1 of the default itself), counters and times by their means. Rows of a clip add its
// flicker. Front and its confidence are of points against the picture of endless effort of
// `references.front()`: others are lit by another model.
std::vector<StudyPoint> points_of(std::span<const StudyRow> rows, std::span<const StudyReference> references);

// ln of the time ratios of two points to the default: of the first to the second, with the interval that both
// give together (half widths added in squares).
Interval ratio_between(const Interval& first, const Interval& second);

// As errors are told: four decimals, five below 0.01.
std::string error_text(double value);

// Acuity-weighted, against endless effort of the knob alone where there is one: so hard light's bias does not
// hide the rest.
double isolated_error(const StudyPoint& point);

}  // namespace herr
