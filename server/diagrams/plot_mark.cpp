#include "server/diagrams/plot_mark.h"

#include <array>
#include <cmath>
#include <numbers>

#include "server/diagrams/html_text.h"
#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#008060", "#aa3377", "#332288", "#7a5c00"};
constexpr MarkShape kShapes[] = {MarkShape::circle, MarkShape::triangle_down, MarkShape::pentagon,
                                 MarkShape::plus};

std::string mark_point(char command, double x, double y) {
  return command + fixed_text(x, 1) + " " + fixed_text(y, 1);
}

// Corners on one circle, or on two by turns; `turn` in quarters from the top.
std::string corners(double x, double y, int count, double turn, double outer, double inner) {
  std::string path;
  for (int i = 0; i < count; ++i) {
    const double angle = (turn / 4 + double(i) / count) * 2 * std::numbers::pi;
    const double radius = i % 2 == 0 ? outer : inner;
    path += mark_point(i == 0 ? 'M' : 'L', x + radius * std::sin(angle), y - radius * std::cos(angle));
  }
  return path + "Z";
}

std::string plus_path(double x, double y, double r) {
  const double t = 0.36 * r;
  const std::array<std::array<double, 2>, 12> at{{{-t, -r},
                                                  {t, -r},
                                                  {t, -t},
                                                  {r, -t},
                                                  {r, t},
                                                  {t, t},
                                                  {t, r},
                                                  {-t, r},
                                                  {-t, t},
                                                  {-r, t},
                                                  {-r, -t},
                                                  {-t, -t}}};
  std::string path;
  for (const auto& [dx, dy] : at) path += mark_point(path.empty() ? 'M' : 'L', x + dx, y + dy);
  return path + "Z";
}

std::string mark_path(MarkShape shape, double x, double y, double r) {
  switch (shape) {
    case MarkShape::square:
      return corners(x, y, 4, 0.5, 1.2 * r, 1.2 * r);
    case MarkShape::triangle:
      return corners(x, y, 3, 0, 1.25 * r, 1.25 * r);
    case MarkShape::triangle_down:
      return corners(x, y, 3, 2, 1.25 * r, 1.25 * r);
    case MarkShape::diamond:
      return corners(x, y, 4, 0, 1.3 * r, 1.3 * r);
    case MarkShape::pentagon:
      return corners(x, y, 5, 0, 1.1 * r, 1.1 * r);
    case MarkShape::star:
      return corners(x, y, 10, 0, 1.5 * r, 0.65 * r);
    case MarkShape::plus:
      return plus_path(x, y, 1.15 * r);
    case MarkShape::circle:
      break;
  }
  return {};
}

}  // namespace

MarkStyle series_style(std::size_t series) {
  return {kShapes[series % std::size(kShapes)], kColours[series % std::size(kColours)], series / 12 % 2 == 1};
}

std::string svg_mark(const MarkStyle& style, double x, double y, double radius, double opacity,
                     const std::string& title) {
  const std::string colour = style.colour;
  std::string attributes;
  if (style.shape == MarkShape::circle) {
    attributes =
        "cx=\"" + fixed_text(x, 1) + "\" cy=\"" + fixed_text(y, 1) + "\" r=\"" + fixed_text(radius, 1) + "\"";
  } else {
    attributes = "d=\"" + mark_path(style.shape, x, y, radius) + "\"";
  }
  attributes += style.hollow ? " fill=\"#fff\"" : " fill=\"" + colour + "\"";
  if (opacity < 1 && !style.hollow) attributes += " fill-opacity=\"" + fixed_text(opacity, 2) + "\"";
  attributes += " stroke=\"" + colour + "\" stroke-width=\"" + (style.hollow ? "1.8" : "1") + "\"";
  return html_element(style.shape == MarkShape::circle ? "circle" : "path", attributes,
                      title.empty() ? "" : html_element("title", "", title));
}

std::string legend_mark(const MarkStyle& style) {
  return html_element("svg", "width=\"18\" height=\"18\" viewBox=\"0 0 18 18\" aria-hidden=\"true\"",
                      svg_mark(style, 9, 9, 5));
}

}  // namespace herr
