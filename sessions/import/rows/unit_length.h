// How far values that ought to be units may be off: quaternions, directions, columns of rotation matrices.
// Before: numbers of a row. After: rotation_reader, rotation_matrix, gaze_reader.
#pragma once

#include <string>

#include "sessions/import/rows/reading_counts.h"
#include "sessions/import/tables/row_source.h"

namespace herr {

// Three decimals, as some loggers write them, move the length of a quaternion by up to 1e-3, that of a
// direction by 9e-4 and the product of two columns by 2e-3: that is still rounding, more is another quantity.
inline constexpr double kUnitSlack = 2e-3;
// Further off than this, it is no unit at all.
inline constexpr double kUnitLimit = 0.1;
// Off by less than this, a value is taken as it is: normalising would only change the last digits.
inline constexpr double kUnitRounding = 1e-6;

// What to divide a value of this length by. Counts a length that rounding does not explain; throws InputError
// where it is none of a unit. `what` names the value ("the quaternion"), `when_zero` says what to do about a
// zero.
double unit_divisor(const RowSource& rows, double length, const char* what, const char* when_zero,
                    ReadingCounts& counts);

// Six digits, for messages.
std::string short_number(double value);

}  // namespace herr
