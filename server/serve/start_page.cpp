#include "server/serve/start_page.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "server/process/version.h"
#include "server/results/settings_report.h"
#include "server/results/summary_json.h"
#include "server/serve/latest_picture.h"
#include "server/serve/page_files.h"
#include "server/serve/serve_json.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

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
      "<h2>Latency, last 10 s</h2>\n<div "
      "class=\"wide\"><table>\n<thead><tr><th>milliseconds</th><th>mean</th><th>median</th>"
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
  row("CPU, all threads", window.cpu);
  if (window.views.count() > 0) row("further views, after the frame", window.views);
  row("sampling the session", window.sample);
  row("motion to photon", window.motion_to_photon);
  row("age of pose", window.pose_age);
  row("age of gaze", window.gaze_age);
  row("age of camera", window.camera_age);
  return html + "</tbody>\n</table></div>\n";
}

std::string count_cells(const char* name, const RunStatistics& statistics, double length_s) {
  const double rate = length_s > 0 ? static_cast<double>(statistics.frames) / length_s : 0;
  return std::string("<tr><td>") + name + "</td><td>" + std::to_string(statistics.frames) + "</td><td>" +
         fixed_text(rate, 1) + "</td><td>" + std::to_string(statistics.missed_frames) + "</td><td>" +
         std::to_string(statistics.missed_by_machine) + "</td><td>" +
         std::to_string(statistics.missed_by_work) + "</td><td>" + std::to_string(statistics.missed_by_both) +
         "</td><td>" + std::to_string(statistics.dropped_frames) + "</td><td>" +
         std::to_string(statistics.repeated_ticks) + "</td></tr>\n";
}

std::string counts_section(const ServeSnapshot& snapshot, const RunStatistics& window, TimeNs now_ns) {
  const double run_s = static_cast<double>(now_ns - snapshot.started_ns) * kSecondsPerNs;
  return "<h2>Frames</h2>\n<div class=\"wide\"><table>\n<thead><tr><th></th><th>rendered</th><th>per "
         "second</th><th>missed</th>"
         "<th>for the machine</th><th>for the work</th><th>for "
         "both</th><th>dropped</th><th>repeated</th></tr></thead>\n<tbody>\n" +
         count_cells("last 10 s", window, std::min(run_s, 10.0)) + count_cells("run", snapshot.run, run_s) +
         "</tbody>\n</table></div>\n";
}

std::string frame_row(const RecentFrame& frame, TimeNs now_ns) {
  const FrameRecord& record = frame.record;
  const double ago_s = static_cast<double>(now_ns - frame.finished_ns) * kSecondsPerNs;
  const auto cell = [](const std::string& text) { return "<td>" + text + "</td>"; };
  return "<tr><td>" + std::to_string(record.frame) + "</td>" + cell(fixed_text(record.times.frame_ms, 2)) +
         cell(record.cpu_ms ? fixed_text(*record.cpu_ms, 2) : "–") +
         cell(record.preemptions ? std::to_string(*record.preemptions) : "–") +
         cell(record.missed ? name_of(record.cause) : "") + cell(fixed_text(std::max(0.0, ago_s), 1)) +
         cell(std::to_string(frame.sequence)) + "</tr>\n";
}

// The newest frames, and the newest that missed: did the machine take the cores, or was it the work?
std::string frames_section(const std::vector<RecentFrame>& recent, TimeNs now_ns) {
  constexpr std::size_t kNewest = 5, kLate = 10;
  std::string newest, late;
  std::size_t late_count = 0;
  for (std::size_t i = 0; i < recent.size(); ++i) {
    const RecentFrame& frame = recent[recent.size() - 1 - i];
    if (i < kNewest) newest += frame_row(frame, now_ns);
    if (!frame.record.missed || frame.finished_ns <= now_ns - kWindowNs) continue;
    if (++late_count <= kLate) late += frame_row(frame, now_ns);
  }
  const std::string head =
      "<div class=\"wide\"><table>\n<thead><tr><th>frame</th><th>wall, ms</th><th>CPU, ms</th>"
      "<th>preemptions</th><th>missed: cause</th><th>seconds "
      "ago</th><th>sequence</th></tr></thead>\n<tbody>\n";
  std::string html = "<h2>Newest frames</h2>\n" + head + newest + "</tbody>\n</table></div>\n";
  if (late.empty()) return html;
  return html + "<h2>Late frames, " + std::to_string(late_count) + " in the last 10 s</h2>\n" + head + late +
         "</tbody>\n</table></div>\n<p class=\"quiet\">machine: preempted, less than 80 % of the frame on "
         "the cores, and its CPU time fits into the period; both: so, and it does not fit; else work. "
         "<a href=\"/v1/frames?missed=1\">All of them</a>.</p>\n";
}

std::string figure(const std::string& name, int width_px, int height_px, const std::string& caption) {
  const std::string path = "/v1/frames/latest/" + name + ".png";
  return "<figure><a href=\"" + path + "?full=1\"><img src=\"" + path + "\" alt=\"" + name + "\" width=\"" +
         std::to_string(width_px) + "\" height=\"" + std::to_string(height_px) + "\"></a><figcaption>" +
         caption + "<span class=\"sequence\"></span></figcaption></figure>\n";
}

std::string pictures_section(const ServeSnapshot& snapshot, const ServedPictures* polar) {
  const SessionReport& subject = *snapshot.subject;
  std::string html = "<h2>Newest frame</h2>\n<div class=\"pictures\">\n";
  for (const PictureOutline& picture : subject.pictures()) {
    // Names of pictures are of [a-z0-9_-].
    html += figure(picture.name, picture.width_px, picture.height_px,
                   words_of(picture.name.c_str()) + ", " + std::to_string(picture.width_px) + " × " +
                       std::to_string(picture.height_px));
  }
  for (std::size_t eye = 0; polar != nullptr && eye < kPolarPictures.size(); ++eye) {
    const ViewportImage& picture = polar->polar[eye];
    html += figure(kPolarPictures[eye], picture.width_px, picture.height_px,
                   std::string(kPolarPictures[eye]) + ": gaze at the left border, angle upwards");
  }
  return html + "</div>\n";
}

std::string plan_section(const FramePlan& plan) {
  const auto left_out = std::count_if(plan.entries.begin(), plan.entries.end(),
                                      [](const PlanEntry& entry) { return !entry.runs; });
  std::string html = "<h2>Frame plan, " + std::to_string(left_out) +
                     " left out</h2>\n<div class=\"wide\"><table class=\"words\">\n<thead><tr><th>stage</th>"
                     "<th></th><th></th></tr></thead>\n<tbody>\n";
  for (const PlanEntry& entry : plan.entries) {
    html += std::string("<tr") + (entry.runs ? "" : " class=\"out\"") + "><td>" + shown(entry.name) +
            "</td><td>" + (entry.runs ? "runs" : "left out") + "</td><td>" + shown(entry.reason) +
            "</td></tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string heading(const ServeSnapshot& snapshot, const ReplayOptions& options) {
  std::string html =
      "<p class=\"quiet\">" + std::string(program_with_version()) + ", " + name_of(snapshot.phase);
  if (!snapshot.subject) return html + "</p>\n<p>The session is being opened.</p>\n";
  const SessionReport& subject = *snapshot.subject;
  html += "</p>\n<p>Session <b>" + shown(subject.name) + "</b>, scene <b>" + shown(subject.scene_name) +
          "</b> (" + counted(subject.scene_triangles, "triangle", "triangles") + "), display <b>" +
          shown(subject.profile.name) + "</b>, clock " + name_of(options.clock) + ", display period " +
          fixed_text(subject.range.period_ms(), 2) + " ms.<br>\nFrame " + std::to_string(snapshot.frame) +
          " of " + std::to_string(subject.range.first) + " … " +
          std::to_string(subject.range.first + subject.range.count - 1) + ", lap " +
          std::to_string(snapshot.lap + 1) + ". " + counted(subject.settings.threads, "thread", "threads") +
          ", " + name_of(subject.settings.isa) + ", " + shown(headline_text(options, subject)) + ".</p>\n";
  for (const std::string& warning : subject.warnings) {
    html += "<p class=\"warning\">" + shown(warning) + "</p>\n";
  }
  return html;
}

// The page's template with its marks replaced, in their order; what is put in is not searched again.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& parts) {
  std::string html;
  for (const auto& [mark, part] : parts) {
    const std::size_t at = page.find(mark);
    if (at == std::string_view::npos) throw std::logic_error("page.html lacks a mark");
    html += page.substr(0, at);
    html += part;
    page.remove_prefix(at + mark.size());
  }
  return html.append(page);
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

std::string start_page(const ServeSnapshot& snapshot, const ReplayOptions& options, TimeNs now_ns,
                       const ServedPictures* polar) {
  std::string numbers, pictures, links;
  if (snapshot.subject && snapshot.rendered > 0) {
    const RunStatistics window = window_statistics(snapshot.recent, now_ns);
    pictures = pictures_section(snapshot, polar);
    numbers = counts_section(snapshot, window, now_ns) + frames_section(snapshot.recent, now_ns) +
              latency_section(window) + plan_section(snapshot.subject->plan);
  }
  for (const char* path :
       {"/v1/status", "/v1/latency", "/v1/frames", "/v1/plan", "/metrics", "/livez", "/readyz"}) {
    links += "<a href=\"" + std::string(path) + "\">" + path + "</a> ";
  }
  return filled(page_file("page.html"), {{"{{heading}}", heading(snapshot, options)},
                                         {"{{pictures}}", pictures},
                                         {"{{numbers}}", numbers},
                                         {"{{links}}", links}});
}

}  // namespace herr
