// How an error falls with effort: error = floor + c n^p, fitted to relative residuals, so that small errors
// count as much as large ones. For each p the best floor >= 0 and c >= 0 are a linear problem of two unknowns
// (Golub & Pereyra, "The differentiation of pseudo-inverses and nonlinear least squares problems whose
// variables separate", 1973); the 95 % intervals are those of the profile (Bates & Watts, "Nonlinear
// Regression Analysis", 1988, section 6.1): every value whose best fit is no worse than
// S_min (1 + t^2 / (points - parameters)), t the 97.5 % quantile of Student's distribution.
#pragma once

#include <optional>
#include <span>

#include "server/study/statistics/interval.h"

namespace herr {

struct PowerFit {
  Interval p;               // within [-8, 8]
  Interval floor;           // 0 without floor
  double c = 0;             // error of n = 1 without the floor
  double relative_rms = 0;  // of the residuals
  int points = 0;
};

// `n` and `error` are positive and finite, of one length; throws std::invalid_argument otherwise. None for
// fewer points than parameters + 1 (2 parameters, 3 with floor), or fewer different n than parameters. A
// bound of p is infinite where its end of [-8, 8] still fits. Where any p fits as well, p is 0 and the floor
// is 0.
std::optional<PowerFit> fit_power(std::span<const double> n, std::span<const double> error, bool with_floor);

}  // namespace herr
