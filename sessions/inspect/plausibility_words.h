// What the attitude of a head is called, and what usually lies behind one that no head has.
// Before: AttitudeMeter. After: plausibility.h.
#pragma once

#include <string>

#include "sessions/inspect/meters/attitude_meter.h"

namespace herr {

std::string whole(double value);     // "-12"
std::string percents(double share);  // "82 %"

std::string where_it_looks(const AttitudeMeter& head);   // "straight up in 100 % of the rows"
std::string which_way_is_up(const AttitudeMeter& head);  // "upright in 97 % of the rows"
// Of a head that is not upright: the axis that seems wrong, as a question.
std::string likely_wrong_axis(const AttitudeMeter& head);

}  // namespace herr
