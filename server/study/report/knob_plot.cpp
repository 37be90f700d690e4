#include <algorithm>
#include <cmath>
#include <limits>

#include "server/study/report/figure_text.h"
#include "server/study/report/study_plots.h"

namespace herr {
namespace {

bool own_errors(const StudyRecord& record, const std::string& knob) {
  return std::any_of(record.points.begin(), record.points.end(),
                     [&](const StudyPoint& p) { return p.knob == knob && p.own_error; });
}

bool has_efforts(const StudyRecord& record, const std::string& knob) {
  return std::any_of(record.points.begin(), record.points.end(),
                     [&](const StudyPoint& p) { return p.knob == knob && p.n > 0; });
}

// What the diagram does not say: `plain`, the fit is of what it shows.
std::string fit_text(const StudyFit& fit, bool plain) {
  std::string text = fit.base;
  if (!plain) text += (text.empty() ? "" : ", ") + metric_label(fit.metric) + " against " + fit.against;
  text += text.empty() ? "" : ": ";
  if (!fit.fit) return text + "no fit" + (fit.remark.empty() ? "" : "; " + fit.remark);
  text += "p = " + figure(fit.fit->p, 2) + ", floor " + figure(fit.fit->floor, 2);
  text += fit.theory.empty() ? ", no theory" : ", theory " + fit.theory;
  return text + (fit.remark.empty() ? "" : "; " + fit.remark);
}

// floor + c n^p from the lowest to the highest effort.
PlotCurve fit_curve(const PowerFit& fit, double from, double to, const char* colour) {
  constexpr int kSteps = 48;
  PlotCurve curve;
  curve.colour = colour;
  curve.dashed = true;
  for (int i = 0; i <= kSteps; ++i) {
    const double n = from * std::pow(to / from, double(i) / kSteps);
    curve.at.push_back({n, fit.floor.estimate + fit.c * std::pow(n, fit.p.estimate)});
  }
  return curve;
}

struct BaseSeries {
  std::string base;
  MarkStyle style;
  double lowest_n = std::numeric_limits<double>::infinity(), highest_n = 0;
};

BaseSeries& series_of(std::vector<BaseSeries>& all, const std::string& base) {
  for (BaseSeries& series : all) {
    if (series.base == base) return series;
  }
  all.push_back({base, series_style(all.size())});
  return all.back();
}

void add_fits(const StudyRecord& record, const std::string& knob, bool own,
              const std::vector<BaseSeries>& all, StudyPlot& out) {
  for (const StudyFit& fit : record.fits) {
    if (fit.knob != knob) continue;
    const bool same = fit.metric == Metric::acuity_rmse && (fit.against == "own reference") == own;
    out.lines.push_back(fit_text(fit, same));
    for (const BaseSeries& series : all) {
      if (!fit.fit || !same || series.base != fit.base || !(series.highest_n > series.lowest_n)) continue;
      out.plot.curves.push_back(fit_curve(*fit.fit, series.lowest_n, series.highest_n, series.style.colour));
    }
  }
}

std::string effort_label(const StudyRecord& record, const std::string& knob) {
  for (const StudyFit& fit : record.fits) {
    if (fit.knob == knob && !fit.effort.empty()) return "n: " + fit.effort;
  }
  return "n";
}

}  // namespace

StudyPlot knob_plot(const StudyRecord& record, const std::string& knob, const std::string& id) {
  StudyPlot out;
  const bool own = own_errors(record, knob), efforts = has_efforts(record, knob);
  out.plot.id = id;
  out.plot.title = knob + (efforts ? ": error against effort" : ": error against time");
  out.plot.width = 400;
  out.plot.height = 300;
  out.plot.x_label = efforts ? effort_label(record, knob) : "frame time / default";
  out.plot.y_label = metric_label(Metric::acuity_rmse) + (own ? ", own" : "");
  std::vector<BaseSeries> all;
  for (const StudyPoint& point : record.points) {
    if (point.knob != knob || (own && !point.own_error)) continue;
    BaseSeries& series = series_of(all, point.base);
    PlotMark mark;
    mark.x = efforts ? point.n : point.time_ratio.estimate;
    mark.y = (own ? *point.own_error : point.error).at(Metric::acuity_rmse);
    mark.style = series.style;
    if (!efforts) {
      mark.x_low = point.time_ratio.lower;
      mark.x_high = point.time_ratio.upper;
    }
    mark.title = point_tip(point, (own ? "own error " : "error ") + figure(mark.y));
    out.plot.marks.push_back(mark);
    if (!(point.n > 0) || !std::isfinite(point.n)) continue;
    series.lowest_n = std::min(series.lowest_n, point.n);
    series.highest_n = std::max(series.highest_n, point.n);
  }
  if (efforts) add_fits(record, knob, own, all, out);
  if (all.size() > 1) {
    for (const BaseSeries& series : all) out.legend.push_back({series.style, series.base});
  }
  out.caption = own ? "Against endless effort of this knob alone." : "Against endless effort of all knobs.";
  return out;
}

}  // namespace herr
