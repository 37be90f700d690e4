// Which combinations of knobs are worth measuring: those that the knobs alone foretell to lie near the front.
// Before: every knob measured alone. After: study_run measures them, best first.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/study/plan/study_setting.h"

namespace herr {

struct MeasuredSetting {
  StudySetting setting;
  double log_time = 0, error = 0;  // ln of the time ratio to the default; acuity-weighted
};

// Pairs on one model (StudySetting::model) that want no setting at two values; at most `most` of them, those
// first that would gain most against the front of what was measured and of the pairs before them. Foretold
// against the setting of what both change alike, which must be among `measured` (light samples, or nothing:
// the default): times multiply, squared errors add. A pair gains the larger, the farther (in logarithms) it
// lies below every point that is as fast.
std::vector<StudySetting> combinations(const RenderSettings& defaults,
                                       const std::vector<MeasuredSetting>& measured, std::size_t most);

}  // namespace herr
