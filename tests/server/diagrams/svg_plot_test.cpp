// Axes and marks of diagrams.
#include "server/diagrams/svg_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "server/diagrams/plot_axis.h"

namespace herr {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kEndless = std::numeric_limits<double>::infinity();

std::vector<double> labelled(const LogAxis& axis) {
  std::vector<double> values;
  for (const PlotTick& tick : axis.ticks()) {
    if (!tick.label.empty()) values.push_back(tick.value);
  }
  return values;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(LogAxis, HasTicksAtDecadesFromATenthToAMillion) {
  const LogAxis axis(std::vector<double>{0.1, 1e6}, 0, 700);
  EXPECT_EQ(labelled(axis), (std::vector<double>{0.1, 1, 10, 100, 1e3, 1e4, 1e5, 1e6}));
}

TEST(LogAxis, DecadesAreEvenlySpaced) {
  const LogAxis axis(std::vector<double>{0.01, 100}, 0, 432);
  // 4 decades and 4 % of them on each side make 4.32: 100 px each. log10 and the product round by less than
  // 1e-12 px.
  for (int i = -2; i <= 2; ++i) EXPECT_NEAR(*axis.place(std::pow(10.0, i)), 216 + 100 * i, 1e-9);
}

TEST(LogAxis, LabelsSeveralTicksHoweverNarrowOrWideTheSpan) {
  for (const double lowest : {1e-300, 3e-5, 0.9, 1.01, 4.9, 77.0, 1e250}) {
    for (const double factor : {1.0, 1.001, 2.0, 5.0, 30.0, 300.0, 1e6, 1e20, 1e50}) {
      const std::vector<double> values{lowest, lowest * factor};
      const LogAxis axis(values, 0, 100);
      const std::vector<double> ticks = labelled(axis);
      EXPECT_GE(ticks.size(), 2u) << lowest << " x " << factor;
      EXPECT_LE(ticks.size(), 9u) << lowest << " x " << factor;
      EXPECT_TRUE(axis.holds(values[0]) && axis.holds(values[1]));
      for (const PlotTick& tick : axis.ticks()) {
        ASSERT_TRUE(axis.place(tick.value));
        EXPECT_TRUE(axis.holds(tick.value * (1 + 1e-9)) || axis.holds(tick.value * (1 - 1e-9)));
      }
    }
  }
}

TEST(LogAxis, HasNoPlaceForWhatIsNotPositiveOrNotFinite) {
  const LogAxis axis(std::vector<double>{kNan, kEndless, -1, 0, 1, 10}, 0, 100);
  for (const double value : {kNan, kEndless, -kEndless, 0.0, -0.0, -1.0}) EXPECT_FALSE(axis.place(value));
  EXPECT_LT(axis.upper(), 20);
  EXPECT_GT(axis.lower(), 0.5);
  EXPECT_EQ(axis.place(1e308), 100.0);  // at the end
}

TEST(SvgPlot, LeavesOutWhatHasNoPlaceAndDrawsTheRest) {
  Plot plot;
  for (const double x : {kNan, kEndless, -kEndless, 0.0, -1.0, 1.0, 5e-324, 1e308}) {
    for (const double y : {kNan, kEndless, -kEndless, -1.0, 0.0, 1.0}) {
      PlotMark mark;
      mark.x = x;
      mark.y = y;
      mark.x_low = y;
      mark.y_high = x;
      plot.marks.push_back(mark);
    }
  }
  plot.floor = kEndless;
  plot.curves.push_back({{{1, 1}, {kNan, 1}, {1, kEndless}, {2, 1}}});
  EXPECT_EQ(marks_drawn(plot), 6);  // 3 values of x with 2 of y
  const std::string svg = svg_plot(plot);
  EXPECT_EQ(count_of(svg, "<circle"), 6u);
  for (const char* word : {"nan", "inf", "n/a"}) EXPECT_EQ(svg.find(word), std::string::npos) << word;
}

TEST(SvgPlot, AnErrorOfZeroHasALaneOfItsOwn) {
  Plot plot;
  plot.marks.resize(2);
  plot.marks[0].x = plot.marks[1].x = 1;
  plot.marks[0].y = 0.5;
  EXPECT_EQ(count_of(svg_plot(plot), ">0</text>"), 1u);
  plot.marks[1].y = 0.5;
  EXPECT_EQ(count_of(svg_plot(plot), ">0</text>"), 0u);
}

TEST(SvgPlot, CurvesWithALabelStandInALegendAndOnlyAFileNamesItsNamespace) {
  Plot plot;
  plot.marks.resize(1);
  plot.marks[0].x = plot.marks[0].y = 1;
  plot.curves = {{{{1, 1}, {2, 2}}, "#222", false, "a < b"}, {{{1, 2}, {2, 1}}}};
  const std::string svg = svg_plot(plot), document = svg_document(plot);
  EXPECT_EQ(count_of(svg, "a &lt; b"), 1u);
  EXPECT_EQ(count_of(svg, "xmlns"), 0u);
  EXPECT_EQ(document.find("<svg xmlns=\"http://www.w3.org/2000/svg\" "), 0u);
  EXPECT_EQ(count_of(document, "fill=\"#fff\""), count_of(svg, "fill=\"#fff\"") + 1);
}

TEST(SvgPlot, AnEmptyDiagramIsStillOne) {
  const std::string svg = svg_plot(Plot{});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_NE(svg.find("viewBox=\"0 0 460 390\""), std::string::npos);
}

TEST(SeriesStyle, TwentyFourSeriesDiffer) {
  std::set<std::string> marks;
  for (std::size_t i = 0; i < 24; ++i) marks.insert(legend_mark(series_style(i)));
  EXPECT_EQ(marks.size(), 24u);
}

}  // namespace
}  // namespace herr
