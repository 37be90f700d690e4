// What to take for which error, and how foveation stands against rays per pixel and against the paper's own
// settings. Before: points. After: the first lines of the report.
#pragma once

#include <span>
#include <vector>

#include "server/study/report/study_record.h"

namespace herr {

// The knee of the front first: of three points on it or more the one with the smallest product of error and
// time. Then for twice, once, half and a quarter of the errors of the default with hard and with soft light:
// the fastest point that is no worse.
std::vector<StudyAdvice> advice_of(std::span<const StudyPoint> points);

// Rays per pixel at the default's error, and at full scale, for each number of light samples; and for each of
// the paper's settings one of ours with the same error (to 2 %), in the time that is not pixels. Errors with
// hard light are against hard light.
std::vector<StudyAim> aims_of(std::span<const StudyPoint> points);

}  // namespace herr
