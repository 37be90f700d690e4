// What to take for which error, and how foveation stands against rays per pixel and against the paper's own
// settings. Before: points. After: the first lines of the report.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/study/report/study_record.h"

namespace herr {

// The knee of the front first: of three points on it or more the one with the smallest product of error and
// time. Then for once, twice, half and a quarter of the errors of the default with hard and with soft light:
// the fastest point that is no worse. The smallest product at an end of the front is no knee: it comes last,
// with what was not measured beyond it. Where its error and that of the default differ by no more than
// references.front() errs by, which points are held against, the sentence says so beside the error.
std::vector<StudyAdvice> advice_of(std::span<const StudyPoint> points,
                                   std::span<const StudyReference> references);

// What holds for all advice: at which profile scale it was found; empty at full scale.
std::string advice_note(double profile_scale);

// Rays per pixel at the default's error, and at full scale, for each number of light samples; and for each of
// the paper's settings one of ours with the same error (to 2 %), in the time that is not pixels. Errors with
// hard light are against hard light.
std::vector<StudyAim> aims_of(std::span<const StudyPoint> points);

}  // namespace herr
