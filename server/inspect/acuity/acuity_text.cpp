#include "server/inspect/acuity/acuity_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "server/text/number_text.h"

namespace herr {
namespace {

constexpr int kLabelWidth = 8, kRows = 15;

std::string whole_row(const std::string& name, const std::array<std::string, 4>& cells) {
  std::string text = "  " + left_aligned(name, 30);
  for (const std::string& cell : cells) text += right_aligned(cell, 11);
  return text + "\n";
}

std::string gaze_row(const AcuityFacts& facts, const AcuityOfGaze& of) {
  const bool alike = std::all_of(facts.gazes.begin(), facts.gazes.end(), [&](const AcuityOfGaze& other) {
    return other.gaze != of.gaze || other.theta_max_deg == of.theta_max_deg;
  });
  if (alike && of.eye == Eye::right && facts.gazes.front().eye == Eye::left) return "";
  const std::string eye = alike ? "" : of.eye == Eye::left ? ", left eye" : ", right eye";
  return whole_row(
      "gaze " + of.gaze + eye,
      {fixed_text(of.theta_max_deg, 1), std::to_string(2 * of.columns) + "x" + std::to_string(of.rows),
       fixed_text(of.reached.k_radial, 1), fixed_text(of.reached.k_angular, 1)});
}

std::string frames_rows(const AcuityOfFrames& frames) {
  const auto least = [](const LatencyHistogram& values) {
    return fixed_text(static_cast<double>(values.min_ns()) * 1e-6, 1);
  };
  const auto most = [](const LatencyHistogram& values) {
    return fixed_text(static_cast<double>(values.max_ns()) * 1e-6, 1);
  };
  const auto median = [](const LatencyHistogram& values) {
    return fixed_text(values.quantile_ns(0.5) * 1e-6, 1);
  };
  return whole_row("recorded gaze, worst frame",
                   {most(frames.theta_max), "", least(frames.k_radial), least(frames.k_angular)}) +
         whole_row("recorded gaze, median",
                   {median(frames.theta_max), "", median(frames.k_radial), median(frames.k_angular)}) +
         whole_row("recorded gaze, best frame",
                   {least(frames.theta_max), "", most(frames.k_radial), most(frames.k_angular)});
}

// A plot that several curves share.
class AcuityCanvas {
 public:
  AcuityCanvas(std::size_t columns, double lowest, double highest)
      : lines_(kRows, std::string(columns, ' ')), low_(std::log(lowest)), high_(std::log(highest)) {}

  void put(std::size_t column, double value, char mark) {
    const double place = (std::log(value) - low_) / (high_ - low_) * kRows;
    if (!(value > 0) || !(place >= 0) || place >= kRows) return;
    char& cell = lines_[static_cast<std::size_t>(kRows - 1 - static_cast<int>(place))][column];
    const bool both = (cell == 'f' && mark == 'r') || (cell == 'r' && mark == 'f');
    cell = cell == ' ' ? mark : both ? '*' : '+';
  }
  // The value at the lower edge of each row.
  std::string text() const {
    std::string text;
    for (int row = 0; row < kRows; ++row) {
      const double value = std::exp(low_ + (high_ - low_) * (kRows - 1 - row) / kRows);
      std::string line = right_aligned(fixed_text(value, value < 10 ? 1 : 0), kLabelWidth) + " |" +
                         lines_[static_cast<std::size_t>(row)];
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
    return text;
  }

 private:
  std::vector<std::string> lines_;
  double low_, high_;
};

// Degrees below the columns where they lie, as many as have room.
std::string theta_axis(const std::vector<AcuityPoint>& points) {
  const std::size_t columns = points.size();
  std::string axis(columns + 8, ' ');
  std::size_t free = 0;
  const auto put = [&](std::size_t column, const std::string& label) {
    if (column < free) return;
    axis.replace(column, label.size(), label);
    free = column + label.size() + 1;
  };
  const std::string end = fixed_text(points.back().theta_deg, 1) + " deg";
  for (const double degrees : {0.0, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 45.0, 90.0}) {
    const auto at = std::find_if(points.begin(), points.end(),
                                 [&](const AcuityPoint& point) { return point.theta_deg >= degrees - 1e-9; });
    const auto column = static_cast<std::size_t>(at - points.begin());
    const std::string label = shortest_text(degrees);
    if (at != points.end() && column + label.size() + end.size() < columns) put(column, label);
  }
  axis.replace(columns - end.size(), end.size(), end);
  axis.erase(axis.find_last_not_of(' ') + 1);
  return std::string(kLabelWidth, ' ') + " +" + std::string(columns, '-') + "\n" +
         std::string(kLabelWidth + 2, ' ') + axis + "\n";
}

}  // namespace

std::string acuity_plot(const std::vector<AcuityPoint>& points) {
  if (points.empty()) return "";
  // Around small circles samples are dense beyond any use: they leave the plot at the top.
  double lowest = points.front().asked, highest = 2 * points.front().asked;
  for (const AcuityPoint& point : points) {
    for (const double value : {point.asked, point.radial, point.display, point.angular.value_or(0)}) {
      if (value > 0) lowest = std::min(lowest, value);
    }
    highest = std::max({highest, 1.01 * point.radial, 1.01 * point.display});
  }
  AcuityCanvas canvas(points.size(), 0.99 * lowest, highest);
  for (std::size_t i = 0; i < points.size(); ++i) {
    canvas.put(i, points[i].asked, 'f');
    canvas.put(i, points[i].radial, 'r');
    canvas.put(i, points[i].display, 'd');
    if (points[i].angular) canvas.put(i, *points[i].angular, 'a');
  }
  return canvas.text() + theta_axis(points);
}

std::string acuity_text(const AcuityFacts& facts) {
  std::string text = "acuity: k = samples per degree times theta + 1, theta = degrees off the gaze\n" +
                     whole_row("", {"theta max", "polar", "k radial", "k angular"});
  for (const AcuityOfGaze& of : facts.gazes) text += gaze_row(facts, of);
  if (facts.frames) text += frames_rows(*facts.frames);
  const AcuityOfGaze& first = facts.gazes.front();
  text += whole_row("f = 200 / (theta + 1) asks for", {"", "", "200", "200"});
  text += "k angular: of the worst circle, " + fixed_text(first.reached.k_angular_at_deg, 1) +
          " deg off the gaze. polar: width of both eyes x height. --polar acuity reaches f everywhere\n\n";
  return text + "samples per degree, gaze straight ahead: f 200 / (theta + 1), r radial, a angular,\n" +
         "d display (its finest viewport), * f and r together, + other ones together\n" +
         acuity_plot(facts.ahead) + "\n";
}

}  // namespace herr
