#include "server/inspect/acuity/acuity_picture.h"

#include <algorithm>
#include <array>

#include "server/diagrams/svg_plot.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

// Where marks stand, and from where on curves are drawn: a logarithmic axis has no 0.
constexpr std::array kMarked_deg{0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 90.0};

void add_curve(Plot& plot, const AcuityFacts& facts, const std::string& label, std::size_t style, bool dashed,
               double (*of)(const AcuityPoint&)) {
  const MarkStyle mark_style = series_style(style);
  PlotCurve curve{{}, mark_style.colour, dashed, label};
  auto marked = kMarked_deg.begin();
  for (const AcuityPoint& point : facts.ahead) {
    const double value = of(point);
    if (point.theta_deg < kMarked_deg.front() || !(value > 0)) continue;
    curve.at.push_back({point.theta_deg, value});
    if (marked == kMarked_deg.end() || point.theta_deg < *marked) continue;
    while (marked != kMarked_deg.end() && point.theta_deg >= *marked) ++marked;
    PlotMark mark;
    mark.x = point.theta_deg, mark.y = value;
    mark.style = mark_style;
    mark.radius = 2.6;
    mark.title =
        label + ": " + fixed_text(value, 1) + " per degree at " + fixed_text(point.theta_deg, 2) + " deg";
    plot.marks.push_back(mark);
  }
  plot.curves.push_back(curve);
}

}  // namespace

std::string acuity_picture(const AcuityFacts& facts, const RenderSettings& settings) {
  const AcuityOfGaze& ahead = facts.gazes.front();
  Plot plot;
  plot.id = "acuity";
  plot.width = 640, plot.height = 460;
  plot.title = "samples per degree over eccentricity, gaze straight ahead";
  const std::string size = "polar buffers of both eyes " + std::to_string(2 * ahead.columns) + "x" +
                           std::to_string(ahead.rows) + (settings.polar_acuity ? " (--polar acuity)" : "");
  plot.x_label = "degrees off the gaze, straight ahead; " + size;
  plot.y_label = "samples or pixels per degree";
  add_curve(plot, facts, "acuity function 200 / (theta + 1)", 0, true,
            [](const AcuityPoint& p) { return p.asked; });
  add_curve(plot, facts, "samples along the radius, k " + fixed_text(ahead.reached.k_radial, 1), 1, false,
            [](const AcuityPoint& p) { return p.radial; });
  add_curve(plot, facts,
            "samples around the circle, k " + fixed_text(ahead.reached.k_angular, 1) + " at least", 2, false,
            [](const AcuityPoint& p) { return p.angular.value_or(0); });
  add_curve(plot, facts, "pixels of the display's finest viewport", 3, false,
            [](const AcuityPoint& p) { return p.display; });
  return svg_document(plot);
}

}  // namespace herr
