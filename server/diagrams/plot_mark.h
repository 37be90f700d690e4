// The marks of diagrams: shapes and colours that stay apart for the colour-blind and in grey. Before:
// study_plots. After: svg_plot, legends.
// Source of the colours: Okabe & Ito (2008) and Tol, "Colour Schemes" (2021), those with 3 : 1 against white.
#pragma once

#include <cstddef>
#include <string>

namespace herr {

enum class MarkShape { circle, square, triangle, triangle_down, diamond, pentagon, star, plus };

struct MarkStyle {
  MarkShape shape = MarkShape::circle;
  const char* colour = "#222";
  bool hollow = false;
};

// Of the i-th of several series; the first 24 differ.
MarkStyle series_style(std::size_t series);

// An SVG path around (x, y); `opacity` of its filling; `title` (HTML already) is told where a pointer rests.
std::string svg_mark(const MarkStyle& style, double x, double y, double radius, double opacity = 1,
                     const std::string& title = "");
// A whole small picture of it for a legend.
std::string legend_mark(const MarkStyle& style);

}  // namespace herr
