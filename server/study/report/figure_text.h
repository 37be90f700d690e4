// Figures of a report as text, for page and terminal alike. A dash stands for what is not finite.
#pragma once

#include <string>

#include "server/study/statistics/interval.h"

namespace herr {

inline constexpr const char* kNoFigure = "\u2013";

// `digits` significant digits: 0.00123, 45.6, 1.2e-05.
std::string figure(double value, int digits = 3);
// "0.74 [0.68, 0.80]"
std::string figure(const Interval& value, int digits = 3);
// Of things counted, a mean: no decimals from 100 on.
std::string count_figure(double value);
std::string fixed_figure(double value, int decimals);
// Of a share: "97 %".
std::string percent_figure(double share);

}  // namespace herr
