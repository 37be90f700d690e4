#include "server/serve/start_page.h"

#include <algorithm>
#include <cstddef>

#include "server/cli/version.h"
#include "server/replay/summary_json.h"
#include "server/serve/serve_json.h"
#include "server/statistics/number_text.h"
#include "sessions/input_error.h"

namespace herr {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="refresh" content="5">
<title>HERR replay</title>
<style>
:root { color-scheme: light dark }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 68rem; margin: 2rem auto; padding: 0 1rem }
h1 { font-size: 1.4rem; margin-bottom: 0 }
h2 { font-size: 1.1rem; margin: 2rem 0 .5rem }
table { border-collapse: collapse; font-variant-numeric: tabular-nums }
th, td { padding: .15rem .9rem .15rem 0; text-align: right; font-weight: normal }
th:first-child, td:first-child { text-align: left }
thead th, .sum td { border-bottom: 1px solid currentColor }
.sum td { font-weight: bold }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(15rem, 1fr)); gap: 1rem }
figure { margin: 0 }
img { width: 100%; height: auto; background: #222 }
figcaption, .quiet { opacity: .75 }
.warning { border-left: .3rem solid #c80; padding-left: .7rem }
</style>
</head>
<body>
)";

std::string shown(const std::string& text) {
  return html_escaped(printable(text));
}

std::string milliseconds(double ns) {
  return fixed_text(ns * 1e-6, 2);
}

std::string cells(const LatencyHistogram& times) {
  if (times.count() == 0) return "<td>–</td><td>–</td><td>–</td><td>–</td><td>–</td>";
  std::string row = "<td>" + milliseconds(times.mean_ns()) + "</td>";
  for (const double fraction : {0.5, 0.95, 0.99}) {
    row += "<td>" + milliseconds(times.quantile_ns(fraction)) + "</td>";
  }
  return row + "<td>" + milliseconds(static_cast<double>(times.max_ns())) + "</td>";
}

std::string words_of(const char* name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

// As Table 1 of the paper: the last ten seconds, stage by stage.
std::string latency_section(const RunStatistics& window) {
  std::string html =
      "<h2>Latency, last 10 s</h2>\n<table>\n<thead><tr><th>milliseconds</th><th>mean</th><th>median</th>"
      "<th>95 %</th><th>99 %</th><th>max</th></tr></thead>\n<tbody>\n";
  const auto row = [&](const std::string& name, const LatencyHistogram& times, bool sum = false) {
    html += std::string("<tr") + (sum ? " class=\"sum\"" : "") + "><td>" + name + "</td>" + cells(times) +
            "</tr>\n";
  };
  for (std::size_t i = 0; i < kStageCount; ++i) {
    // A stage that the plan leaves out took no time in any frame.
    if (window.stages[i].max_ns() > 0) row(words_of(name_of(static_cast<Stage>(i))), window.stages[i]);
  }
  row("frame", window.frame, true);
  row("sampling the session", window.sample);
  row("motion to photon", window.motion_to_photon);
  row("age of pose", window.pose_age);
  row("age of gaze", window.gaze_age);
  row("age of camera", window.camera_age);
  return html + "</tbody>\n</table>\n";
}

std::string count_cells(const char* name, const RunStatistics& statistics, double length_s) {
  const double rate = length_s > 0 ? static_cast<double>(statistics.frames) / length_s : 0;
  return std::string("<tr><td>") + name + "</td><td>" + std::to_string(statistics.frames) + "</td><td>" +
         fixed_text(rate, 1) + "</td><td>" + std::to_string(statistics.missed_frames) + "</td><td>" +
         std::to_string(statistics.dropped_frames) + "</td><td>" + std::to_string(statistics.repeated_ticks) +
         "</td></tr>\n";
}

std::string counts_section(const ServeSnapshot& snapshot, const RunStatistics& window, TimeNs now_ns) {
  const double run_s = static_cast<double>(now_ns - snapshot.started_ns) * kSecondsPerNs;
  return "<h2>Frames</h2>\n<table>\n<thead><tr><th></th><th>rendered</th><th>per second</th><th>missed</th>"
         "<th>dropped</th><th>repeated</th></tr></thead>\n<tbody>\n" +
         count_cells("last 10 s", window, std::min(run_s, 10.0)) + count_cells("run", snapshot.run, run_s) +
         "</tbody>\n</table>\n";
}

std::string pictures_section(const ServeSnapshot& snapshot) {
  std::string html = "<h2>Newest frame</h2>\n<div class=\"pictures\">\n";
  for (const Viewport& viewport : snapshot.subject->profile.viewports) {
    // Names of viewports are of [a-z0-9_].
    const std::string link = "/v1/frames/latest/" + viewport.name + ".png";
    html += "<figure><a href=\"" + link + "?full=1\"><img src=\"" + link + "\" alt=\"" + viewport.name +
            "\" width=\"" + std::to_string(viewport.width_px) + "\" height=\"" +
            std::to_string(viewport.height_px) + "\"></a><figcaption>" + words_of(viewport.name.c_str()) +
            ", " + std::to_string(viewport.width_px) + " × " + std::to_string(viewport.height_px) +
            "</figcaption></figure>\n";
  }
  return html + "</div>\n";
}

std::string plan_section(const FramePlan& plan) {
  std::string html =
      "<h2>Frame plan</h2>\n<table>\n<thead><tr><th>stage</th><th>runs</th><th></th></tr></thead>\n<tbody>\n";
  for (const PlanEntry& entry : plan.entries) {
    html += "<tr><td>" + shown(entry.name) + "</td><td>" + (entry.runs ? "yes" : "no") +
            "</td><td style=\"text-align: left\">" + shown(entry.reason) + "</td></tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string heading(const ServeSnapshot& snapshot, const ReplayOptions& options) {
  std::string html = "<h1>HERR replay</h1>\n<p class=\"quiet\">" + std::string(program_with_version()) +
                     ", " + name_of(snapshot.phase);
  if (!snapshot.subject) return html + "</p>\n<p>The session is being opened.</p>\n";
  const SessionReport& subject = *snapshot.subject;
  html += "</p>\n<p>Session <b>" + shown(subject.name) + "</b>, scene <b>" + shown(subject.scene_name) +
          "</b> (" + std::to_string(subject.scene_triangles) + " triangles), display <b>" +
          shown(subject.profile.name) + "</b>, clock " + name_of(options.clock) + ", display period " +
          fixed_text(subject.range.period_ms(), 2) + " ms.<br>\nFrame " + std::to_string(snapshot.frame) +
          " of " + std::to_string(subject.range.first) + " … " +
          std::to_string(subject.range.first + subject.range.count - 1) + ", lap " +
          std::to_string(snapshot.lap + 1) + ". " + std::to_string(subject.settings.threads) + " threads, " +
          name_of(subject.settings.isa) + ", " + shown(settings_text(subject.settings)) + ".</p>\n";
  for (const std::string& warning : subject.warnings) {
    html += "<p class=\"warning\">" + shown(warning) + "</p>\n";
  }
  return html;
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string start_page(const ServeSnapshot& snapshot, const ReplayOptions& options, TimeNs now_ns) {
  std::string html = kHead + heading(snapshot, options);
  if (snapshot.subject && snapshot.rendered > 0) {
    const RunStatistics window = window_statistics(snapshot.recent, now_ns);
    html += pictures_section(snapshot) + counts_section(snapshot, window, now_ns) + latency_section(window) +
            plan_section(snapshot.subject->plan);
  }
  html += "<h2>For programs</h2>\n<p>";
  for (const char* path :
       {"/v1/status", "/v1/latency", "/v1/frames", "/v1/plan", "/metrics", "/livez", "/readyz"}) {
    html += "<a href=\"" + std::string(path) + "\">" + path + "</a> ";
  }
  return html + "</p>\n</body>\n</html>\n";
}

}  // namespace herr
