// One logarithmic axis of a diagram: its range, where a value lies, and where ticks stand. Before: the values
// drawn. After: svg_plot.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace herr {

struct PlotTick {
  double value = 0;
  std::string label;  // SVG: the content of a text element; empty: a tick without label
};

class LogAxis {
 public:
  // From the lowest to the highest of the values that are positive and finite, with a margin, and a factor of
  // 4 at least. `low_px` and `high_px`: coordinates of its ends.
  LogAxis(std::span<const double> values, double low_px, double high_px);

  // Limited to the ends of the axis. None for what has no place: not finite, 0 or negative.
  std::optional<double> place(double value) const;
  bool holds(double value) const { return value >= lower() && value <= upper(); }
  double lower() const;
  double upper() const;
  // Decades; with steps of 1, 2, 5 (or 1, 2, 3, 5, 7) where fewer than three lie within.
  std::vector<PlotTick> ticks() const;

 private:
  double low_px_, high_px_;
  double low_ = 0, high_ = 0;  // log10
};

}  // namespace herr
