#include "server/inspect/time_plot.h"

#include <algorithm>
#include <cmath>

#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr int kLabelWidth = 8;

// A cell of the plot: row 1 is the lowest.
char cell(const ProfileSpan& span, double scale, int rows, int row) {
  if (span.values == 0) return ' ';
  const auto reaches = [=](double value) { return std::lround(value / scale * rows) >= row; };
  return reaches(span.mean()) ? '#' : reaches(span.peak) ? ':' : row == 1 ? '.' : ' ';
}

std::string without_trailing_spaces(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string time_axis(double seconds) {
  const std::string end = fixed_text(seconds, seconds < 100 ? 2 : 0) + " s";
  const std::string middle = fixed_text(seconds / 2, seconds < 100 ? 2 : 0);
  std::string axis = left_aligned("0", kPlotColumns);
  axis.replace(kPlotColumns / 2, middle.size(), middle);
  axis.replace(kPlotColumns - end.size(), end.size(), end);
  return std::string(kLabelWidth, ' ') + " +" + std::string(kPlotColumns, '-') + "\n" +
         std::string(kLabelWidth + 2, ' ') + axis + "\n";
}

}  // namespace

double round_scale(double value) {
  if (!(value > 0)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.2, 1.5, 2.0, 2.4, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (value <= step * power) return step * power;
  }
  return 10 * power;
}

std::string time_plot(const std::vector<ProfileSpan>& spans, const PlotRequest& request) {
  double highest = 0;
  for (const ProfileSpan& span : spans) highest = std::max(highest, span.peak);
  const double scale = round_scale(highest);
  std::string text = request.title + "\n";
  for (int row = request.rows; row > 0; --row) {
    const double top = scale * row / request.rows;
    std::string line = right_aligned(fixed_text(top, scale < 10 ? 2 : 0), kLabelWidth) + " |";
    for (const ProfileSpan& span : spans) line += cell(span, scale, request.rows, row);
    text += without_trailing_spaces(line);
  }
  text += time_axis(request.seconds);
  if (!request.mark_lost) return text;
  std::string line = right_aligned("lost", kLabelWidth) + " |";
  for (const ProfileSpan& span : spans) line += span.without == 0 ? ' ' : span.values == 0 ? 'x' : '-';
  return text + without_trailing_spaces(line);
}

}  // namespace herr
