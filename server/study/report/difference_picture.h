// Test, reference and their difference side by side, small, as PNG bytes: what the numbers mean. Before:
// pictures of one viewport. After: StudyRecord::pictures.
#pragma once

#include <string>

#include "server/study/error/linear_picture.h"
#include "server/study/report/study_record.h"

namespace herr {

// Three panels of at most `panel_px` columns each (box-filtered when smaller, never enlarged): test,
// reference in sRGB, and |difference| of the brightest channel times `gain`, on a black-body ramp (black,
// red, yellow, white at 1). Both pictures of one size.
StudyPicture difference_picture(const std::string& title, const LinearPicture& test,
                                const LinearPicture& reference, double gain, int panel_px);

}  // namespace herr
