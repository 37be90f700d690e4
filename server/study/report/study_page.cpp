#include "server/study/report/study_page.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "server/study/diagrams/html_text.h"
#include "server/study/report/figure_text.h"
#include "server/study/report/page_style.h"
#include "server/study/report/report_table.h"
#include "server/study/report/study_plots.h"
#include "server/study/report/study_tables.h"
#include "server/text/base64.h"

namespace herr {
namespace {

// Nothing without content.
std::string page_section(const std::string& id, const std::string& title, const std::string& content) {
  if (content.empty()) return {};
  return html_element("section", "id=\"" + id + "\"", html_element("h2", "", title) + "\n" + content) + "\n";
}

std::string page_table(const ReportTable& table, bool caption = true) {
  return table.rows.empty() ? "" : table_html(table, caption);
}

std::string page_list(const std::vector<std::string>& lines) {
  std::string items;
  for (const std::string& line : lines) items += html_element("li", "", html_text(line)) + "\n";
  return items.empty() ? "" : html_element("ul", "class=\"lines\"", items) + "\n";
}

// Broken between its words, as far as they fit into a line: not at hyphens.
std::string page_code(const std::string& text) {
  std::string words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    words += (at > 0 ? " " : "") + html_element("span", "", html_text(text.substr(at, end - at)));
    at = end + 1;
  }
  return html_element("code", "", words);
}

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
  return items.empty() ? "" : html_element("ul", "class=\"lines\"", items) + "\n";
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

std::string pictures_part(const StudyRecord& record) {
  std::string figures;
  for (const StudyPicture& picture : record.pictures) {
    if (picture.png.empty()) continue;
    const std::string title = html_text(picture.title);
    figures += html_element("figure", "",
                            "<img width=\"" + std::to_string(picture.width_px) + "\" height=\"" +
                                std::to_string(picture.height_px) + "\" alt=\"" + title +
                                "\" src=\"data:image/png;base64," +
                                base64_text(std::as_bytes(std::span(picture.png))) + "\">\n" +
                                html_element("figcaption", "",
                                             html_element("p", "",
                                                          html_element("b", "", title) + ". " +
                                                              html_text(picture.caption)))) +
               "\n";
  }
  return figures;
}

std::string points_part(const StudyRecord& record) {
  std::string tables;
  for (const ReportTable& table : point_tables(record)) tables += page_table(table);
  return tables;
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
         head_facts(record) + page_section("aims", "Aims", aims_part(record)) +
         page_section("advice", "Recommendation", advice_part(record)) +
         page_section("overview", "Error against time", overview_part(record)) +
         page_section("knobs", "Each knob by itself", knobs_part(record)) +
         page_section("pictures", "What the errors look like", pictures_part(record)) +
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
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         html_element("title", "", "Error against time: " + html_text(record.session)) + "\n" +
         html_element("style", "", kPageStyle) + "\n</head>\n<body>\n" + page_body(record) +
         "</body>\n</html>\n";
}

}  // namespace herr
