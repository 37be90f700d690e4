// How the error of each knob falls with its effort, and where it does not do what is expected of it. Before:
// points. After: the report.
#pragma once

#include <span>
#include <vector>

#include "server/study/plan/knobs.h"
#include "server/study/report/study_record.h"

namespace herr {

struct StudyFits {
  std::vector<StudyFit> fits;
  std::vector<StudyRemark> remarks;
};

// One fit for each knob with an effort and each base, against the knob's own reference where it has one, with
// a floor where there are points enough.
StudyFits fit_knobs(std::span<const Knob> knobs, std::span<const StudyPoint> points,
                    std::span<const StudyReference> references);

}  // namespace herr
