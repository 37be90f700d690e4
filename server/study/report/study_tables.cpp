#include "server/study/report/study_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "server/study/report/figure_text.h"
#include "server/study/report/report_facts.h"
#include "server/study/report/study_plots.h"
#include "server/text/text_number.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr Metric kShownMetrics[] = {Metric::acuity_rmse, Metric::rmse, Metric::flip};

double counter_of(const StudyPoint& point, const std::string& name) {
  for (const auto& [counter, value] : point.counters) {
    if (counter == name) return value;
  }
  return kUnknown;
}

std::vector<std::string> point_row(const StudyPoint& point) {
  const std::string floor = point.at_floor ? " *" : "";
  return {point.base,
          point.value + (point.of_default ? " (default)" : ""),
          figure(point.error.at(Metric::acuity_rmse)) + floor,
          figure(point.error.at(Metric::rmse)),
          figure(point.error.at(Metric::flip)),
          figure(point.own_error ? point.own_error->at(Metric::acuity_rmse) : kUnknown),
          figure(point.bias.value_or(kUnknown)),
          figure(point.time_ratio),
          fixed_figure(point.frame_ms, 2),
          count_figure(counter_of(point, "primary_rays")),
          count_figure(counter_of(point, "shadow_rays")),
          percent_figure(point.front_confidence),
          std::to_string(point.frames),
          point.own_reference,
          point.flags};
}

// By effort around each base, in whatever order they were measured.
std::vector<const StudyPoint*> sweep_points(const StudyRecord& record, const std::string& knob) {
  std::vector<const StudyPoint*> points;
  for (const StudyPoint& point : record.points) {
    if (point.knob == knob) points.push_back(&point);
  }
  const auto effort = [](const StudyPoint* point) {
    return std::isfinite(point->n) && point->n != 0 ? point->n : number_in(point->value).value_or(0);
  };
  std::stable_sort(points.begin(), points.end(), [&](const StudyPoint* a, const StudyPoint* b) {
    return a->base != b->base ? a->base < b->base : effort(a) < effort(b);
  });
  return points;
}

// The default, then the front.
std::vector<const StudyPoint*> chosen_points(const StudyRecord& record) {
  std::vector<const StudyPoint*> chosen;
  for (const StudyPoint& point : record.points) {
    if (point.knob == "default") chosen.push_back(&point);
  }
  for (const StudyPoint* point : front_of(record)) {
    if (point->knob != "default") chosen.push_back(point);
  }
  return chosen;
}

void add_band_columns(ReportTable& table) {
  for (const Band& band : bands()) table.columns.push_back({band.label});
}

// Without columns in which all cells are empty or a dash.
void drop_empty_columns(ReportTable& table) {
  for (std::size_t i = table.columns.size(); i-- > 0;) {
    const bool empty = std::all_of(table.rows.begin(), table.rows.end(),
                                   [&](const auto& row) { return row[i].empty() || row[i] == kNoFigure; });
    if (!empty || table.rows.empty()) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    table.columns.erase(table.columns.begin() + at);
    for (auto& row : table.rows) row.erase(row.begin() + at);
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> study_facts(const StudyRecord& record) {
  ReportFacts facts;
  facts.add_head(record);
  const auto measured = std::count_if(record.points.begin(), record.points.end(),
                                      [](const StudyPoint& point) { return !point.of_default; });
  facts.add("Measured", {counted(static_cast<std::int64_t>(measured), "setting", "settings") + " on " +
                         counted(static_cast<std::int64_t>(record.frames.size()), "frame", "frames") +
                         ", in " + fixed_figure(record.minutes_taken, 1) + " of " +
                         fixed_figure(record.minutes_allowed, 1) + " minutes"});
  facts.add("Default", {record.default_settings});
  facts.add("Program", {record.program});
  if (record.timing) facts.add("Times", {record.timing->sentence});
  return facts.take();
}

ReportTable frame_table(const StudyRecord& record) {
  ReportTable table{"Frames", {{"frame"}, {"time, s"}, {"head, \u00b0/s"}, {"gaze, \u00b0"}}, {}, ""};
  for (const StudyFrame& frame : record.frames) {
    table.rows.push_back({std::to_string(frame.number), fixed_figure(frame.time_s, 2),
                          fixed_figure(frame.head_deg_per_s, 1), fixed_figure(frame.gaze_deg, 1)});
  }
  if (!record.clip.empty()) {
    table.note = "Flicker: frames " + std::to_string(record.clip.front().number) + " to " +
                 std::to_string(record.clip.back().number) + ".";
  }
  return table;
}

ReportTable reference_table(const StudyRecord& record) {
  ReportTable table{"References and their own errors",
                    {{"reference", true}, {"passes"}, {"at most"}},
                    {},
                    "Passes: per half at least, and where the halves differed. Good enough: below 1/5 of the "
                    "smallest error that is judged by it."};
  for (const Metric metric : kShownMetrics) table.columns.push_back({metric_label(metric)});
  table.columns.insert(table.columns.end(), {{"good enough", true}, {"s"}, {"settings", true, true}});
  for (const StudyReference& reference : record.references) {
    std::vector<std::string> row{reference.name, std::to_string(reference.passes),
                                 std::to_string(reference.most_passes)};
    for (const Metric metric : kShownMetrics) row.push_back(figure(reference.error.at(metric)));
    row.insert(row.end(),
               {reference.goal_met ? "yes" : "no", fixed_figure(reference.seconds, 1), reference.settings});
    table.rows.push_back(row);
  }
  return table;
}

ReportTable front_table(const StudyRecord& record) {
  ReportTable table{"Pareto front, quickest first",
                    {{"no."},
                     {"setting", true},
                     {metric_label(Metric::acuity_rmse)},
                     {"time / default"},
                     {"on front"},
                     {"flags", true, true}},
                    {},
                    ""};
  for (const StudyPoint* point : front_of(record)) {
    table.rows.push_back({std::to_string(table.rows.size() + 1), point->name,
                          figure(point->error.at(Metric::acuity_rmse)), figure(point->time_ratio),
                          percent_figure(point->front_confidence), point->flags});
  }
  return table;
}

std::vector<ReportTable> point_tables(const StudyRecord& record) {
  std::vector<ReportTable> tables;
  for (const std::string& knob : knobs_of(record)) {
    ReportTable table{knob,
                      {{"around", true},
                       {"value", true},
                       {"acuity RMSE"},
                       {"RMSE"},
                       {"FLIP"},
                       {"own"},
                       {"bias"},
                       {"time / default"},
                       {"ms"},
                       {"primary rays", false, true},
                       {"shadow rays"},
                       {"on front"},
                       {"frames", false, true},
                       {"own reference", true, true},
                       {"flags", true, true}},
                      {},
                      ""};
    for (const StudyPoint* point : sweep_points(record, knob)) {
      table.rows.push_back(point_row(*point));
      if (point->at_floor) table.note = "* below 3 times the reference's own error: not told apart from it.";
    }
    drop_empty_columns(table);
    tables.push_back(table);
  }
  return tables;
}

ReportTable band_table(const StudyRecord& record) {
  ReportTable table{"Errors by distance from the gaze", {{"setting", true}, {"metric", true}}, {}, ""};
  add_band_columns(table);
  for (const StudyPoint* point : chosen_points(record)) {
    for (const Metric metric : kShownMetrics) {
      std::vector<std::string> row{point->name, metric_label(metric)};
      for (std::size_t band = 0; band < kBands; ++band) row.push_back(figure(point->error.at(metric, band)));
      table.rows.push_back(row);
    }
  }
  return table;
}

ReportTable metric_table(const StudyRecord& record) {
  ReportTable table{"All metrics, over all pixels", {{"setting", true}}, {}, ""};
  for (const MetricRow& metric : metric_rows()) table.columns.push_back({metric.label});
  for (const StudyPoint* point : chosen_points(record)) {
    std::vector<std::string> row{point->name};
    for (std::size_t i = 0; i < kMetrics; ++i) row.push_back(figure(point->error.value[kAllPixels][i]));
    table.rows.push_back(row);
  }
  return table;
}

ReportTable fit_table(const StudyRecord& record) {
  ReportTable table{"Fits: error = floor + c n^p",
                    {{"knob", true},
                     {"around", true},
                     {"metric", true},
                     {"against", true},
                     {"p"},
                     {"floor"},
                     {"c"},
                     {"residual"},
                     {"points"},
                     {"n", true, true},
                     {"theory", true, true},
                     {"remark", true, true}},
                    {},
                    "In brackets: 95 % intervals. Residual: RMS, relative to the fit."};
  for (const StudyFit& fit : record.fits) {
    std::vector<std::string> row{fit.knob, fit.base, metric_label(fit.metric), fit.against};
    if (fit.fit) {
      row.insert(row.end(), {figure(fit.fit->p, 2), figure(fit.fit->floor), figure(fit.fit->c),
                             percent_figure(fit.fit->relative_rms), std::to_string(fit.fit->points)});
    } else {
      row.insert(row.end(), 5, kNoFigure);
    }
    row.insert(row.end(), {fit.effort, fit.theory, fit.remark});
    table.rows.push_back(row);
  }
  return table;
}

ReportTable flicker_table(const StudyRecord& record) {
  ReportTable table{"Flicker: change from frame to frame while the gaze rests",
                    {{"setting", true}, {"change of", true}},
                    {},
                    "RMS over pixels. Excess: of the difference of both changes."};
  add_band_columns(table);
  for (const StudyPoint& point : record.points) {
    if (!point.flicker) continue;
    const auto add = [&](const char* name, const std::array<double, kBands>& values) {
      std::vector<std::string> row{point.name, name};
      for (const double value : values) row.push_back(figure(value));
      table.rows.push_back(row);
    };
    add("setting", point.flicker->test);
    add("reference", point.flicker->reference);
    add("excess", point.flicker->excess);
  }
  return table;
}

std::string aim_text(const StudyAim& aim) {
  return aim.name + ": measured " + figure(aim.measured) + ", aim " +
         (aim.at_least ? "at least " : "at most ") + figure(aim.aim) + "." +
         (aim.sentence.empty() ? "" : " " + aim.sentence);
}

}  // namespace herr
