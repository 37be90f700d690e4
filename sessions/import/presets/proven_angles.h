// Which formula the angles of a gaze file obey, where the file itself proves it: under the right one the
// combined ray of a row is the sum of the rays of its eyes.
// Before: alternatives of a map that read the same columns by different formulas. After: choose_format.
#pragma once

#include <filesystem>
#include <span>

#include "sessions/import/map/column_map.h"

namespace herr {

// Of `fitting`, alternatives of one variant whose columns are all in the file: the one with a ray for each
// eye whose formula is proven by the combined alternative of the same formula. Null where there is no choice
// or the first rows do not tell. Throws InputError.
const GazeColumns* proven_angles(const std::filesystem::path& file,
                                 std::span<const GazeColumns* const> fitting);

}  // namespace herr
