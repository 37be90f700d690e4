// A value over time as text: columns of '#' up to the mean and ':' up to the peak, rounded to rows; '.' where
// both round to nothing. ASCII, 80 columns wide.
// Before: TimeProfile. After: inspect_text.
#pragma once

#include <string>
#include <vector>

#include "sessions/inspect/time_profile.h"

namespace herr {

inline constexpr int kPlotColumns = 70;

struct PlotRequest {
  std::string title;
  int rows = 5;
  bool mark_lost = false;  // a line below the plot: 'x' where nothing is known, '-' where some of it is lost
  double seconds = 0;      // length of the time axis
};

// Lines with line ends. `spans`: kPlotColumns of them, from second 0 on.
std::string time_plot(const std::vector<ProfileSpan>& spans, const PlotRequest& request);

// The least of 1, 1.2, 1.5, 2, 2.4, 3, 4, 5, 6 and 8 times a power of ten that is at least `value`; 1 for 0.
double round_scale(double value);

}  // namespace herr
