#include "server/study/report/study_plots.h"

#include <algorithm>
#include <cmath>

#include "server/study/report/figure_text.h"

namespace herr {
namespace {

// Knobs that are no sweeps have marks of their own.
MarkStyle style_of(const std::string& knob, const std::vector<std::string>& knobs) {
  if (knob == "default") return {MarkShape::star, "#000", false};
  if (knob == "uniform") return {MarkShape::square, "#000", true};
  if (knob == "paper") return {MarkShape::triangle, "#000", false};
  if (knob == "combination") return {MarkShape::diamond, "#555", true};
  std::size_t series = 0;
  for (const std::string& other : knobs) {
    if (other == knob) break;
    series += other != "default" && other != "uniform" && other != "paper" && other != "combination";
  }
  return series_style(series);
}

std::string legend_text(const std::string& knob) {
  if (knob == "uniform") return "uniform (baseline)";
  if (knob == "paper") return "settings of the paper";
  if (knob == "combination") return "combinations";
  return knob;
}

// A factor below any error keeps the lower end of a bar on the axis.
void add_error_bar(PlotMark& mark, double reference_error) {
  if (!(mark.y > 0) || !(reference_error > 0)) return;
  mark.y_low = std::max(mark.y - reference_error, 1e-3 * mark.y);
  mark.y_high = mark.y + reference_error;
}

// Horizontally to the time of the next point, then down to its error: nothing between two settings is
// claimed.
PlotCurve front_curve(const std::vector<const StudyPoint*>& front) {
  PlotCurve curve;
  for (const StudyPoint* point : front) {
    const double x = point->time_ratio.estimate, y = point->error.at(Metric::acuity_rmse);
    if (!curve.at.empty()) curve.at.push_back({x, curve.at.back()[1]});
    curve.at.push_back({x, y});
  }
  return curve;
}

// Drawn over the many: what they are held against, and the front. The default over all.
int layer_of(const StudyPoint& point) {
  if (point.knob == "default") return 2;
  return point.knob == "uniform" || point.knob == "paper" || point.on_front ? 1 : 0;
}

// How full a mark is: the more, the surer its place on the front.
double opacity_of(const StudyPoint& point, Metric metric) {
  if (metric != Metric::acuity_rmse || layer_of(point) > 0) return 1;
  return point.front_confidence >= 0 && point.front_confidence <= 1 ? 0.25 + 0.75 * point.front_confidence
                                                                    : 0.25;
}

PlotMark time_mark(const StudyPoint& point, Metric metric, const std::vector<std::string>& knobs,
                   double reference_error) {
  PlotMark mark;
  mark.x = point.time_ratio.estimate;
  mark.y = point.error.at(metric);
  mark.x_low = point.time_ratio.lower;
  mark.x_high = point.time_ratio.upper;
  add_error_bar(mark, reference_error);
  mark.style = style_of(point.knob, knobs);
  mark.opacity = opacity_of(point, metric);
  if (point.knob == "default") mark.radius = 6;
  mark.title = point_tip(point, metric_label(metric) + " " + figure(mark.y));
  return mark;
}

}  // namespace

std::string metric_label(Metric metric) {
  return metric_rows()[static_cast<std::size_t>(metric)].label;
}

std::string point_tip(const StudyPoint& point, const std::string& error) {
  return point.name + ": " + error + ", time x " + figure(point.time_ratio);
}

std::vector<std::string> knobs_of(const StudyRecord& record) {
  std::vector<std::string> knobs;
  for (const StudyPoint& point : record.points) {
    if (std::find(knobs.begin(), knobs.end(), point.knob) == knobs.end()) knobs.push_back(point.knob);
  }
  return knobs;
}

std::vector<const StudyPoint*> front_of(const StudyRecord& record) {
  std::vector<const StudyPoint*> front;
  for (const StudyPoint& point : record.points) {
    const bool placed = std::isfinite(point.time_ratio.estimate) && point.time_ratio.estimate > 0 &&
                        std::isfinite(point.error.at(Metric::acuity_rmse));
    if (point.on_front && placed) front.push_back(&point);
  }
  std::stable_sort(front.begin(), front.end(), [](const StudyPoint* a, const StudyPoint* b) {
    return a->time_ratio.estimate < b->time_ratio.estimate;
  });
  return front;
}

const StudyReference* floor_reference(const StudyRecord& record) {
  return record.references.empty() ? nullptr : &record.references.front();
}

StudyPlot work_precision_plot(const StudyRecord& record, Metric metric, const std::string& id) {
  StudyPlot out;
  out.plot.id = id;
  out.plot.title = metric_label(metric) + " against time, all settings";
  out.plot.x_label = "frame time / default (less is quicker)";
  out.plot.y_label = metric_label(metric);
  const StudyReference* reference = floor_reference(record);
  const double own = reference == nullptr ? kNoBar : reference->error.at(metric);
  const std::vector<std::string> knobs = knobs_of(record);
  const std::vector<const StudyPoint*> front = front_of(record);
  for (const int layer : {0, 1, 2}) {
    for (const StudyPoint& point : record.points) {
      // Points of other light are held against other pictures.
      if (layer_of(point) != layer || !point.comparable) continue;
      out.plot.marks.push_back(time_mark(point, metric, knobs, own));
      const auto place = std::find(front.begin(), front.end(), &point);
      if (metric != Metric::acuity_rmse || place == front.end()) continue;
      out.plot.marks.back().label = std::to_string(place - front.begin() + 1);
    }
  }
  for (const std::string& knob : knobs) {
    const bool drawn = std::any_of(record.points.begin(), record.points.end(), [&](const StudyPoint& point) {
      return point.knob == knob && point.comparable;
    });
    if (drawn) out.legend.push_back({style_of(knob, knobs), legend_text(knob)});
  }
  out.caption =
      "Each mark is one setting; lower left is better. Horizontal bars: 95 % interval of the time "
      "ratio; vertical bars: plus and minus the reference's own error.";
  if (own > 0) {
    out.plot.floor = kFloorOfReference * own;
    out.plot.floor_label = "at the floor: below 3 x the reference's own error";
  }
  if (metric == Metric::acuity_rmse) {
    if (front.size() > 1) out.plot.curves.push_back(front_curve(front));
    out.caption +=
        " The line is the Pareto front, its numbers are those of the table below; the fuller a "
        "mark, the more often it is on the front when frames and times are drawn anew.";
  }
  const auto others = std::count_if(record.points.begin(), record.points.end(),
                                    [](const StudyPoint& point) { return !point.comparable; });
  if (others > 0) {
    out.caption += " Not here, since their light or frames are others: " + std::to_string(others) +
                   " settings, each in the diagram of its knob.";
  }
  const int missing = static_cast<int>(out.plot.marks.size()) - marks_drawn(out.plot);
  if (missing > 0) out.caption += " Without a place for want of a number: " + std::to_string(missing) + ".";
  return out;
}

}  // namespace herr
