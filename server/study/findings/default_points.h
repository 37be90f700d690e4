// The default as a point of each sweep that it lies on. Before: points_of. After: fits, aims, diagrams.
#pragma once

#include <span>
#include <vector>

#include "server/study/plan/study_setting.h"
#include "server/study/report/study_record.h"

namespace herr {

// Adds what of `of_default` (StudySweeps) no point has the name of: the point of the default of its base
// under its own name, on no front, since the default stands there, and without flicker. Nothing where that
// default was not measured, or nothing else of the sweep around its base.
void add_points_of_default(std::span<const StudySetting> of_default, std::vector<StudyPoint>& points);

}  // namespace herr
