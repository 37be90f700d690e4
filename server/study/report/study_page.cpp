#include "server/study/report/study_page.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "server/diagrams/html_text.h"
#include "server/study/report/figure_text.h"
#include "server/study/report/page_parts.h"
#include "server/study/report/report_table.h"
#include "server/study/report/study_plots.h"
#include "server/study/report/study_tables.h"

namespace herr {
namespace {

std::string head_facts(const StudyRecord& record) {
  std::string facts;
  const auto fact = [&](const std::string& name, const std::string& value) {
    facts += html_element("dt", "", name) + html_element("dd", "", value) + "\n";
  };
  for (const auto& [name, value] : study_facts(record)) fact(name, html_text(value));
  if (!record.command_line.empty()) fact("Again", page_code(record.command_line));
  if (!record.warnings.empty()) {
    fact("Warnings", html_element("a", "href=\"#warnings\"", std::to_string(record.warnings.size())));
  }
  return html_element("dl", "class=\"facts\"", facts) + "\n";
}

std::string aims_part(const StudyRecord& record) {
  std::string items;
  for (const bool met : {false, true}) {
    for (const StudyAim& aim : record.aims) {
      if (aim.met != met) continue;
      items += html_element("li", met ? "" : "class=\"missed\"",
                            html_element("b", "", met ? "Met: " : "Missed: ") + html_text(aim_text(aim))) +
               "\n";
    }
  }
  return items.empty() ? "" : html_element("ul", "class=\"aims\"", items) + "\n";
}

std::string advice_part(const StudyRecord& record) {
  std::string items;
  for (const StudyAdvice& advice : record.advice) {
    const auto point = std::find_if(record.points.begin(), record.points.end(), [&](const StudyPoint& p) {
      return !advice.point.empty() && p.name == advice.point;
    });
    const bool flags = point != record.points.end() && !point->flags.empty();
    items +=
        html_element("li", "", html_text(advice.sentence) + (flags ? " " + page_code(point->flags) : "")) +
        "\n";
  }
  if (items.empty()) return {};
  const std::string& note = record.advice_note;
  return (note.empty() ? "" : html_element("p", "", html_text(note)) + "\n") +
         html_element("ul", "class=\"lines\"", items) + "\n";
}

std::string plot_figure(const StudyPlot& plot, const std::string& title, const std::string& css) {
  if (marks_drawn(plot.plot) == 0) return {};
  std::string legend, caption;
  for (const auto& [style, name] : plot.legend) {
    legend += html_element("li", "", legend_mark(style) + html_element("span", "", html_text(name)));
  }
  if (!legend.empty()) legend = html_element("ul", "class=\"legend\"", legend) + "\n";
  caption = html_element("p", "", html_element("b", "", html_text(title)) + ". " + html_text(plot.caption));
  for (const std::string& line : plot.lines) caption += html_element("p", "", html_text(line));
  return html_element("figure", css,
                      "\n" + svg_plot(plot.plot) + legend + html_element("figcaption", "", caption)) +
         "\n";
}

std::string overview_part(const StudyRecord& record) {
  return plot_figure(work_precision_plot(record, Metric::acuity_rmse, "plot-acuity"),
                     "What the eye can see of the error, against time", "class=\"main\"") +
         page_table(front_table(record)) +
         plot_figure(work_precision_plot(record, Metric::flip, "plot-flip"), "FLIP against time",
                     "class=\"main\"");
}

std::string knobs_part(const StudyRecord& record) {
  std::string figures;
  int number = 0;
  for (const std::string& knob : knobs_of(record)) {
    const std::string id = "plot-knob-" + std::to_string(++number);
    if (knob == "default" || knob == "combination" || knob == "paper") continue;
    figures += plot_figure(knob_plot(record, knob, id), knob, "");
  }
  return figures.empty() ? "" : html_element("div", "class=\"grid\"", "\n" + figures) + "\n";
}

std::string points_part(const StudyRecord& record) {
  std::string tables;
  for (const ReportTable& table : point_tables(record)) tables += page_table(table);
  return tables.empty() ? "" : tables + html_element("p", "class=\"note\"", html_text(kTimesNote)) + "\n";
}

std::string metrics_part() {
  std::string items;
  for (const MetricRow& metric : metric_rows()) {
    items += html_element("dt", "", html_text(metric.label)) +
             html_element("dd", "", html_text(metric.sentence) + " Blind to: " + html_text(metric.blind_to)) +
             "\n";
  }
  return html_element("dl", "class=\"metrics\"", items) + "\n";
}

std::string remarks_part(const StudyRecord& record) {
  std::vector<std::string> lines;
  for (const StudyRemark& remark : record.remarks) lines.push_back(remark.knob + ": " + remark.text);
  return page_list(lines);
}

std::string page_body(const StudyRecord& record) {
  return html_element("h1", "", "Error against time: " + html_text(record.session)) + "\n" +
         (record.no_advice.empty() ? "" : html_element("p", "", html_text(record.no_advice)) + "\n") +
         head_facts(record) + page_section("aims", "Aims", aims_part(record)) +
         page_section("advice", "Recommendation", advice_part(record)) +
         page_section("overview", "Error against time", overview_part(record)) +
         page_section("knobs", "Each knob by itself", knobs_part(record)) +
         page_section("pictures", "What the errors look like", page_pictures(record.pictures)) +
         page_section("points", "All settings", points_part(record)) +
         page_section("bands", "Default and front in detail",
                      page_table(band_table(record)) + page_table(metric_table(record))) +
         page_section("fits", "How errors fall: error = floor + c n^p",
                      page_table(fit_table(record), false)) +
         page_section("flicker", "Flicker: change from frame to frame while the gaze rests",
                      page_table(flicker_table(record), false)) +
         page_section("references", "References and their own errors",
                      page_table(reference_table(record), false)) +
         page_section("frames", "Frames", page_table(frame_table(record), false)) +
         page_section("metrics", "Metrics", metrics_part()) +
         page_section("remarks", "Remarks", remarks_part(record)) +
         page_section("left-out", "Left out: nothing in the scene for them", page_list(record.left_out)) +
         page_section("dropped", "Dropped for want of time", page_list(record.dropped)) +
         page_section("warnings", "Warnings", page_list(record.warnings));
}

}  // namespace

std::string study_page(const StudyRecord& record) {
  return page_document("Error against time: " + record.session, page_body(record));
}

}  // namespace herr
