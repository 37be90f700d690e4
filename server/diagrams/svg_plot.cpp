#include "server/diagrams/svg_plot.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "server/diagrams/html_text.h"
#include "server/diagrams/plot_axis.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr double kLeft_px = 66, kRight_px = 14, kTop_px = 12, kBottom_px = 48, kZeroLane_px = 24;
// The floor widens the axis only where it is this near to the lowest mark.
constexpr double kNearFloor = 10;
// Of text over lines.
const std::string kHalo =
    "text-anchor=\"end\" font-size=\"11\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"";

bool has_place(const PlotMark& mark) {
  return std::isfinite(mark.x) && mark.x > 0 && std::isfinite(mark.y) && mark.y >= 0;
}

std::string px(double coordinate) {
  return fixed_text(coordinate, 1);
}

std::string svg_line(double x1, double y1, double x2, double y2, const std::string& attributes) {
  return "<line x1=\"" + px(x1) + "\" y1=\"" + px(y1) + "\" x2=\"" + px(x2) + "\" y2=\"" + px(y2) + "\" " +
         attributes + "/>";
}

std::string svg_text(double x, double y, const std::string& attributes, const std::string& content) {
  return html_element("text", "x=\"" + px(x) + "\" y=\"" + px(y) + "\" " + attributes, content);
}

// Where things stand, worked out once.
struct PlotFrame {
  double left, right, top, bottom;  // of the area with logarithmic axes
  bool zero_lane;
  LogAxis x, y;
  double zero_y() const { return bottom + kZeroLane_px / 2; }
  double lowest_y() const { return zero_lane ? bottom + kZeroLane_px : bottom; }
};

PlotFrame frame_of(const Plot& plot) {
  std::vector<double> xs, ys;
  bool zero = false;
  for (const PlotMark& mark : plot.marks) {
    if (!has_place(mark)) continue;
    xs.push_back(mark.x);
    if (mark.y > 0) ys.push_back(mark.y);
    zero = zero || mark.y == 0;
  }
  const double lowest = ys.empty() ? plot.floor : *std::min_element(ys.begin(), ys.end());
  if (plot.floor > lowest / kNearFloor) ys.push_back(plot.floor);
  const double right = plot.width - kRight_px;
  const double bottom = plot.height - kBottom_px - (zero ? kZeroLane_px : 0);
  return {kLeft_px, right, kTop_px, bottom, zero, LogAxis(xs, kLeft_px, right), LogAxis(ys, bottom, kTop_px)};
}

std::string floor_area(const Plot& plot, const PlotFrame& frame) {
  const std::optional<double> at = frame.y.place(plot.floor);
  if (!at || plot.floor < frame.y.lower()) return {};
  return "<rect x=\"" + px(frame.left) + "\" y=\"" + px(*at) + "\" width=\"" + px(frame.right - frame.left) +
         "\" height=\"" + px(frame.lowest_y() - *at) + "\" fill=\"#e4e4e4\"/>" +
         svg_text(frame.right - 5, *at + 14 < frame.lowest_y() - 2 ? *at + 14 : *at - 4,
                  kHalo + " fill=\"#444\"", html_text(plot.floor_label));
}

std::string axis_parts(const Plot& plot, const PlotFrame& frame) {
  std::string svg;
  const auto stroke = [](const PlotTick& tick) {
    return std::string("stroke=\"") + (tick.label.empty() ? "#eee" : "#ccc") + "\"";
  };
  for (const PlotTick& tick : frame.x.ticks()) {
    const double x = *frame.x.place(tick.value);
    svg += svg_line(x, frame.top, x, frame.lowest_y(), stroke(tick));
    if (!tick.label.empty()) svg += svg_text(x, frame.lowest_y() + 17, "text-anchor=\"middle\"", tick.label);
  }
  for (const PlotTick& tick : frame.y.ticks()) {
    const double y = *frame.y.place(tick.value);
    svg += svg_line(frame.left, y, frame.right, y, stroke(tick));
    if (!tick.label.empty()) svg += svg_text(frame.left - 6, y + 4, "text-anchor=\"end\"", tick.label);
  }
  if (frame.zero_lane) {
    svg += svg_line(frame.left, frame.bottom, frame.right, frame.bottom, "stroke=\"#222\"");
    svg += svg_text(frame.left - 6, frame.zero_y() + 4, "text-anchor=\"end\"", "0");
  }
  svg += "<rect x=\"" + px(frame.left) + "\" y=\"" + px(frame.top) + "\" width=\"" +
         px(frame.right - frame.left) + "\" height=\"" + px(frame.lowest_y() - frame.top) +
         "\" fill=\"none\" stroke=\"#222\"/>";
  svg += svg_text((frame.left + frame.right) / 2, plot.height - 10, "text-anchor=\"middle\"",
                  html_text(plot.x_label));
  const double middle = (frame.top + frame.lowest_y()) / 2;
  svg += svg_text(0, 0, "text-anchor=\"middle\" transform=\"translate(15 " + px(middle) + ") rotate(-90)\"",
                  html_text(plot.y_label));
  return svg;
}

// Broken where a point has no place.
std::string curve_path(const PlotCurve& curve, const PlotFrame& frame) {
  std::string path;
  bool drawing = false;
  for (const auto& [x, y] : curve.at) {
    const std::optional<double> at_x = frame.x.place(x), at_y = frame.y.place(y);
    const bool inside = at_x && at_y && frame.y.holds(y);
    if (inside) path += (drawing ? "L" : "M") + px(*at_x) + " " + px(*at_y);
    drawing = inside;
  }
  if (path.empty()) return {};
  return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + curve.colour + "\" stroke-width=\"1.6\"" +
         (curve.dashed ? " stroke-dasharray=\"5 4\"" : "") + "/>";
}

std::string error_bars(const PlotMark& mark, double x, double y, const PlotFrame& frame) {
  const std::string stroke = std::string("stroke=\"") + mark.style.colour + "\" stroke-opacity=\"0.6\"";
  std::string svg;
  const std::optional<double> left = frame.x.place(mark.x_low), right = frame.x.place(mark.x_high);
  if (left && right) svg += svg_line(*left, y, *right, y, stroke);
  const std::optional<double> low = frame.y.place(mark.y_low), high = frame.y.place(mark.y_high);
  if (low && high && mark.y > 0) svg += svg_line(x, *low, x, *high, stroke);
  return svg;
}

std::string mark_parts(const Plot& plot, const PlotFrame& frame) {
  std::string bars, marks;
  for (const PlotMark& mark : plot.marks) {
    if (!has_place(mark)) continue;
    const double x = *frame.x.place(mark.x), y = mark.y > 0 ? *frame.y.place(mark.y) : frame.zero_y();
    bars += error_bars(mark, x, y, frame);
    marks += svg_mark(mark.style, x, y, mark.radius, mark.opacity, html_text(mark.title));
  }
  return bars + marks;
}

// Above all marks; one that would stand on the last one is left out.
std::string label_parts(const Plot& plot, const PlotFrame& frame) {
  std::string svg;
  double last_x = -100, last_y = -100;
  for (const PlotMark& mark : plot.marks) {
    if (mark.label.empty() || !has_place(mark)) continue;
    const double x = *frame.x.place(mark.x), y = mark.y > 0 ? *frame.y.place(mark.y) : frame.zero_y();
    if (std::abs(x - last_x) < 15 && std::abs(y - last_y) < 11) continue;
    svg += svg_text(x - mark.radius - 2, y + mark.radius + 8, kHalo, html_text(mark.label));
    last_x = x;
    last_y = y;
  }
  return svg;
}

// Lines with their names, right-aligned: nobody knows how wide a text will be.
std::string legend_parts(const Plot& plot, const PlotFrame& frame) {
  std::string svg;
  double y = frame.top + 18;
  for (const PlotCurve& curve : plot.curves) {
    if (curve.label.empty()) continue;
    svg += svg_line(frame.right - 36, y - 4, frame.right - 8, y - 4,
                    std::string("stroke=\"") + curve.colour + "\" stroke-width=\"1.6\"" +
                        (curve.dashed ? " stroke-dasharray=\"5 4\"" : ""));
    svg += svg_text(frame.right - 42, y, kHalo, html_text(curve.label));
    y += 18;
  }
  return svg;
}

std::string svg_element(const Plot& plot, const std::string& attributes, const std::string& ground) {
  const PlotFrame frame = frame_of(plot);
  const std::string width = std::to_string(plot.width), height = std::to_string(plot.height);
  std::string content = ground + floor_area(plot, frame) + axis_parts(plot, frame);
  for (const PlotCurve& curve : plot.curves) content += curve_path(curve, frame);
  content += mark_parts(plot, frame) + label_parts(plot, frame) + legend_parts(plot, frame);
  return html_element("svg",
                      attributes + "id=\"" + html_text(plot.id) +
                          "\" class=\"plot\" role=\"img\" aria-label=\"" + html_text(plot.title) +
                          "\" width=\"" + width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width +
                          " " + height + "\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\"",
                      content) +
         "\n";
}

}  // namespace

int marks_drawn(const Plot& plot) {
  return static_cast<int>(std::count_if(plot.marks.begin(), plot.marks.end(), has_place));
}

std::string svg_plot(const Plot& plot) {
  return svg_element(plot, "", "");
}

std::string svg_document(const Plot& plot) {
  return svg_element(plot, "xmlns=\"http://www.w3.org/2000/svg\" ",
                     "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>");
}

}  // namespace herr
