#include "server/replay/replay_command.h"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "server/frames/frame_quality.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/replay/batch_lines.h"
#include "server/replay/policy_text.h"
#include "server/replay/replay_session.h"
#include "server/replay/session_check.h"
#include "server/results/output_folder.h"
#include "server/results/settings_report.h"
#include "server/results/summary_json.h"
#include "server/settings/option_checks.h"
#include "server/settings/quality_target.h"
#include "server/statistics/late_frames.h"
#include "server/statistics/latency_table.h"
#include "server/statistics/load_json.h"
#include "server/text/number_text.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/inspect/number_words.h"

namespace herr {
namespace {

constexpr std::size_t kMostWarningsShown = 10;

// A word of --format that stands apart is taken for a session: before the others are rendered in vain.
void check_for_formats(const ReplayOptions& options) {
  for (const std::filesystem::path& session : options.sessions) {
    const std::string word = session.string();
    const auto format = std::find_if(kPictureFormats.begin(), kPictureFormats.end(),
                                     [&](PictureFormat one) { return word == name_of(one); });
    if (format == kPictureFormats.end() || path_exists(session)) continue;
    PictureFormats meant = options.formats;
    meant.add(*format);
    throw UsageError("there is no session '" + printable(word) +
                     "', but a format of that name; did you mean --format " + text_of(meant) + "?");
  }
}

void check_folders(const ReplayOptions& options) {
  const EarlierResults earlier = options.overwrite ? EarlierResults::replace
                                 : options.resume  ? EarlierResults::resume
                                                   : EarlierResults::refuse;
  std::vector<std::string> names;
  for (const std::filesystem::path& session : options.sessions) {
    const std::string name = session_folder_name(session);
    for (const std::string& other : names) {
      if (name == other) {
        throw UsageError("two sessions are called " + printable(name) +
                         " and would share one output folder; replay them into different --out");
      }
    }
    names.push_back(name);
    OutputFolder(options.out, session).check(earlier);
  }
}

// `warnings`: those of the report, as they are to be shown.
void show_messages(const SessionReport& report, const std::vector<std::string>& warnings) {
  if (!report.remark.empty()) print_message("warning: " + report.remark);
  if (report.nothing_to_do) {
    print_message(printable(report.name) + ": nothing to do, " +
                  (report.kept_frames == 1
                       ? "the one frame is there"
                       : "all " + std::to_string(report.kept_frames) + " frames are there"));
  } else if (report.kept_frames > 0) {
    print_message(printable(report.name) + ": " + std::to_string(report.kept_frames) + " of " +
                  counted(report.range.count, "frame", "frames") +
                  (report.kept_frames == 1 ? " was there" : " were there"));
  }
  for (std::size_t i = 0; i < warnings.size(); ++i) {
    if (i == kMostWarningsShown) {
      print_message("warning: " + std::to_string(warnings.size() - i) + " more are in " +
                    printable((report.out_folder / "summary.json").string()));
      return;
    }
    print_message("warning: " + warnings[i]);
  }
}

// "load: 152.3 ms of CPU for each frame, 97.8 % of 2 cores; memory: ..."
std::string load_text(const SessionReport& report) {
  return "load: " + cpu_text(report.statistics, report.load.cores) +
         "\nmemory: " + fixed_text(static_cast<double>(total_bytes(report.memory)) * 1e-6, 1) +
         " MB in renderer, scene and pictures; at most " + peak_text(report.load) +
         " resident in the whole process so far\n";
}

// "acuity: k radial 183.6 at least, 190.2 median; k angular 131.0 at least, 131.0 median; ..."
std::string acuity_text(const RunStatistics& statistics) {
  const auto figures = [](const LatencyHistogram& values) {
    return fixed_text(static_cast<double>(values.min_ns()) * 1e-6, 1) + " at least, " +
           fixed_text(values.quantile_ns(0.5) * 1e-6, 1) + " median";
  };
  return "acuity: k radial " + figures(statistics.k_radial) + "; k angular " + figures(statistics.k_angular) +
         "\n(samples per degree times theta + 1, worst circle, worse eye; 200 / (theta + 1) asks for "
         "200)\n\n";
}

// "further views: blended-left 1980x1980, ...", or nothing.
std::string further_views_text(const SessionReport& report) {
  std::string text;
  for (const PictureOutline& view : further_views(report.profile, report.settings)) {
    text += (text.empty() ? "further views: " : ", ") + view.name + " " + std::to_string(view.width_px) +
            "x" + std::to_string(view.height_px);
  }
  return text.empty() ? text : text + "\n";
}

// "clipped: 1234 pixels of the PNG files, 0.1 %, are ...", or nothing.
std::string clipped_text(const SessionReport& report, const ReplayOptions& options) {
  const std::int64_t clipped = report.statistics.clipped_pixels;
  if (clipped == 0) return {};
  double pixels = 0;  // of a frame
  for (const PictureOutline& picture : report.pictures())
    pixels += static_cast<double>(picture.width_px) * picture.height_px;
  const double share =
      static_cast<double>(clipped) / (pixels * static_cast<double>(report.statistics.frames));
  return "clipped: " + counted(clipped, "pixel", "pixels") + " of the PNG files, " +
         fixed_text(100 * share, 2) + " %, " + (clipped == 1 ? "is" : "are") +
         " brighter than white or below 0; --exposure moves white, " +
         (options.formats.has(PictureFormat::exr) ? "the EXR files hold their values\n"
                                                  : "--format png,exr keeps values too\n");
}

// The heading and table of one session, and where its files are.
std::string report_text(const SessionReport& report, const ReplayOptions& options) {
  const RunStatistics& statistics = report.statistics;
  std::string text = printable(report.name) + ": " +
                     (report.state == ReplayState::done ? counted(statistics.frames, "frame", "frames")
                                                        : std::to_string(statistics.frames));
  if (report.state != ReplayState::done) {
    text += " of " + counted(report.range.count, "frame", "frames") + " (" + name_of(report.state) + ")";
  }
  if (options.target_ms) {
    text += ", " + std::to_string(statistics.over_target) + " over the target of " +
            target_text(*options.target_ms) + " ms";
  }
  text += ", " + std::to_string(statistics.missed_frames) + " over the display period of " +
          fixed_text(report.range.period_ms(), 2) + " ms" + causes_text(statistics) + "; " +
          counted(report.settings.threads, "thread", "threads") + ", " + name_of(report.settings.isa) + ", " +
          "scene " + printable(report.scene_name) + ", " + headline_text(options, report);
  if (const std::string done = policy_text(statistics, options.policy); !done.empty()) text += "; " + done;
  text += "\n\n";
  if (statistics.frames > 0) text += latency_table(statistics) + "\n";
  if (statistics.k_radial.count() > 0) text += acuity_text(statistics);
  text += load_text(report) + "\n";
  text += further_views_text(report);
  text += clipped_text(report, options);
  text += "results: " + printable(report.out_folder.string()) + "\n";
  if (report.state != ReplayState::done && is_reproducible(options)) {
    text += "to go on with it: the same command and --resume\n";
  }
  for (const std::string& sheet : report.contact_sheets) {
    if (report.contact_sheets.size() > 1) break;
    text += "contact sheet: " + printable((report.out_folder / sheet).string()) + "\n";
  }
  return text;
}

// "all 3 sessions: 24 frames, ...", "2 of 3 sessions: 16 frames, ..." of those that came to their end.
std::string total_text(const std::vector<SessionReport>& reports, std::size_t asked) {
  RunStatistics total;
  std::size_t done = 0;
  std::int64_t frames_done = 0;
  for (const SessionReport& report : reports) {
    total.merge(report.statistics);
    if (report.state != ReplayState::done) continue;
    ++done;
    frames_done += report.statistics.frames;
  }
  if (total.frames == 0) return {};
  std::string text = done == asked ? "\nall " : "\n" + std::to_string(done) + " of ";
  text += std::to_string(asked) + " sessions: " + counted(frames_done, "frame", "frames");
  if (total.frames > frames_done) {
    text += ", and " + std::to_string(total.frames - frames_done) + " of sessions that ended early";
  }
  return text + "; " + std::to_string(total.missed_frames) + " over the display period" + causes_text(total) +
         "\n\n" + latency_table(total);
}

void show_session(const SessionReport& report, const std::vector<std::string>& warnings,
                  const ReplayOptions& options, bool first) {
  show_messages(report, warnings);
  if (!report.error.empty()) print_message(report.error);
  if (!options.json && report.statistics.frames > 0) {
    print_result((first ? "" : "\n") + report_text(report, options));
  }
}

// After the last session that was begun: those behind it that were refused are known, too. The names of the
// others.
std::vector<std::string> add_refused(const std::vector<SessionReport>& checked, const ReplayOptions& options,
                                     std::vector<SessionReport>& reports) {
  std::vector<std::string> unbegun;
  for (std::size_t i = reports.size(); i < checked.size(); ++i) {
    if (checked[i].unopened)
      reports.push_back(checked[i]);
    else
      unbegun.push_back(session_folder_name(options.sessions[i]));
  }
  return unbegun;
}

}  // namespace

int run_replay(const ReplayOptions& options) {
  check_render_settings(options.render);
  check_for_formats(options);
  check_folders(options);
  const std::size_t asked = options.sessions.size();
  const std::vector<SessionReport> checked = check_sessions(options);
  if (const std::string line = refused_line(checked); !line.empty()) print_message(line);
  for (const SessionReport& report : checked) {
    if (report.unopened) write_refusal(report, options);
  }
  std::vector<SessionReport> reports;
  std::set<std::string> said_of_scenes;
  int exit_code = kExitDone;
  bool first = true;
  for (std::size_t i = 0; i < asked; ++i) {
    if (checked[i].unopened) {
      reports.push_back(checked[i]);  // was named
    } else {
      reports.push_back(replay_session(options.sessions[i], options));
      const SessionReport& report = reports.back();
      show_session(report,
                   asked == 1 ? report.warnings : batch_warnings(report, checked[i].warnings, said_of_scenes),
                   options, first);
      first = false;
    }
    const SessionReport& report = reports.back();
    if (report.unopened && !checked[i].unopened && asked > 1) write_refusal(report, options);
    exit_code = worse_exit_code(exit_code, report.exit_code);
    // A full disk or the user's wish to stop holds for the sessions that follow as well.
    if (const int signal = stop_signal(); signal != 0) {
      if (reports.size() < asked) exit_code = worse_exit_code(exit_code, kExitSignalBase + signal);
      break;
    }
    if (report.exit_code == kExitTemporary) break;
  }
  const std::vector<std::string> unbegun = add_refused(checked, options, reports);
  if (options.json) {
    print_result(json_text(run_json(reports, options, exit_code)));
  } else if (asked > 1) {
    print_result(total_text(reports, asked));
  }
  if (const std::string line = closing_line(reports, unbegun, options); asked > 1 && !line.empty())
    print_message(line);
  return exit_code;
}

}  // namespace herr
