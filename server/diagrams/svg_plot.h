// A diagram with two logarithmic axes as an inline SVG element: marks with error bars, curves, a shaded
// floor. Before: study_plots, acuity_picture. After: study_page, a file.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "server/diagrams/plot_mark.h"

namespace herr {

inline constexpr double kNoBar = std::numeric_limits<double>::quiet_NaN();

struct PlotMark {
  double x = 0, y = 0;  // y = 0 has a lane of its own below the axis
  MarkStyle style;
  double radius = 3.6, opacity = 1;
  double x_low = kNoBar, x_high = kNoBar;  // error bars, cut at the ends of the axes
  double y_low = kNoBar, y_high = kNoBar;
  std::string title;  // plain text, told where a pointer rests
  std::string label;  // beside it, lower left: a number
};

struct PlotCurve {
  std::vector<std::array<double, 2>> at;
  const char* colour = "#222";
  bool dashed = false;
  std::string label = {};  // plain text: a line in the legend, in the upper right corner
};

struct Plot {
  std::string id;     // of this diagram alone in its page
  std::string title;  // read out in place of the picture
  int width = 460, height = 390;
  std::string x_label, y_label;
  std::vector<PlotMark> marks;    // later ones lie above
  std::vector<PlotCurve> curves;  // below the marks; they do not widen the axes
  double floor = kNoBar;          // shaded below
  std::string floor_label;
};

// What has no place (not finite, x not positive, y negative) is left out.
std::string svg_plot(const Plot& plot);
// The same as a file of its own: on white.
std::string svg_document(const Plot& plot);
// Marks that svg_plot() draws.
int marks_drawn(const Plot& plot);

}  // namespace herr
