#include "server/cli/study_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "server/cli/flags.h"
#include "server/cli/setting_flags.h"
#include "server/process/exit_code.h"
#include "server/settings/flag_values.h"
#include "server/settings/run_settings.h"
#include "server/study/plan/only_sweeps.h"
#include "server/study/relations/relation.h"

namespace herr {
namespace {

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    names.push_back(text.substr(at, end - at));
    if (names.back().empty()) throw UsageError("--only: a name is empty; separate names by single commas");
    at = end + 1;
  }
  return names;
}

std::string group_names() {
  std::vector<std::string> names;
  for (const RelationGroup& group : relation_groups()) names.emplace_back(group.name);
  return joined(names);
}

// The rate that --hz asks for, and what it does not go together with.
void add_hz_flag(CLI::App& app, StudyOptions& options) {
  value_flag(
      app, "--hz", "HZ",
      "the largest setting (polar size, light samples, profile scale) whose frames hold this rate on this "
      "machine, in place of error against time: --polar, --light-samples (default 256 here), --profile "
      "(default "
      "the session's here) and --profile-scale say the most of each, all other flags what else a frame has; "
      "where no setting holds it leaves out what flags can, then halves --polar, step by step until one "
      "does, "
      "and ends with 1 all the same, since what was asked does not hold; "
      "takes a minute or two a step, some ten runs of 100 frames or 20 s at most; "
      "--minutes ends it before, which with less than 2 mostly leaves settings open, 1 ... 1000",
      [&options](const std::string& text) { options.hz = parse_real_number("--hz", text, 1, 1000); });
}

void check_hz_options(const StudyOptions& options) {
  if (options.stability) throw UsageError("--hz: conflicts with --stability; give one of them");
  if (!options.report.empty())
    throw UsageError("--hz: conflicts with --report, which measures nothing; give one of them");
  if (options.render.polar_acuity) {
    throw UsageError(
        "--polar: acuity follows the display, and --hz chooses sizes; give WIDTHxHEIGHT, the most of them");
  }
  for (const std::string& flag : options.sweep_flags) {
    if (flag == "--minutes") continue;  // a limit of the search
    throw UsageError(flag + ": is of error against time; leave it out with --hz");
  }
  if (!options.only.empty()) throw UsageError("--only: --hz sweeps nothing; leave it out");
  if (!options.out.empty() || options.overwrite) {
    throw UsageError(std::string(options.overwrite ? "--overwrite" : "--out") +
                     ": --hz writes nothing; leave it out, and take --json for machines");
  }
}

// Flags of the sweeps alone.
void add_sweep_flags(CLI::App& app, StudyOptions& options) {
  const auto took = [&options](const char* flag) { options.sweep_flags.emplace_back(flag); };
  value_flag(app, "--frames", "N",
             "frames of the session, spread over head speed and gaze (default 3; --stability takes one)",
             [&options, took](const std::string& text) {
               options.frames = static_cast<int>(parse_whole_number("--frames", text, 1, 90));
               took("--frames");
             });
  value_flag(
      app, "--minutes", "M",
      "time for all of it, half of it for references; fewer frames and settings where it is short, "
      "all listed; one frame's references and the default are measured whatever they take; where less than "
      "a quarter of the settings fits, a warning says so before they are measured, and what to type; what is "
      "left over is used for what was dropped (default 20; with --hz no limit)",
      [&options, took](const std::string& text) {
        options.minutes = parse_real_number("--minutes", text, 0.1, 10000);
        took("--minutes");
      });
  file_flag(app, "--references", "folder of references that several studies share (default OUT/references)",
            [&options, took](const std::string& text) {
              options.references = text;
              took("--references");
            });
  file_flag(app, "--export", "new folder for picture sequences of a clip, for video metrics elsewhere",
            [&options, took](const std::string& text) {
              options.export_to = text;
              took("--export");
            });
  app.add_flag_callback(
      "--resume",
      [&options, took] {
        options.resume = true;
        took("--resume");
      },
      "go on with the study in that folder; its rows and references stay. --minutes counts the time of all "
      "runs together, those before included: to add 5 to a study of 10 give 15; more than before are shared "
      "out anew");
}

void check_stability_options(const StudyOptions& options) {
  if (options.sweep_flags.empty()) return;
  const std::string& flag = options.sweep_flags.front();
  throw UsageError(flag + ": --stability " +
                   (flag == "--frames"    ? "takes one frame with much to see; leave it out"
                    : flag == "--minutes" ? "asks every relation; leave it out, or choose groups with --only"
                    : flag == "--resume"  ? "asks all in one go; leave it out"
                                          : "takes no references and no clip; leave it out"));
}

}  // namespace

void add_study_flags(CLI::App& app, StudyOptions& options) {
  app.add_option("SESSION", options.session, "session folder")->type_name("");
  add_scene_flags(app, options.scene, options.asset_roots);
  add_setting_flags(app, profile_settings(options.profile, options.profile_scale), {SettingGroup::session});
  file_flag(app, "--out",
            "folder of study.csv, study.json and study.html (default study), or with --stability of "
            "stability.json and stability.html (default stability)",
            [&](const std::string& text) { options.out = text; });
  app.add_flag_callback(
      "--stability", [&] { options.stability = true; },
      "relations that must hold on stiff and extreme cases, in place of error against time; ends with 1 when "
      "one fails");
  value_flag(app, "--only", "NAME,...",
             "sweep these alone: " + joined(sweep_names()) +
                 "; with --stability groups of relations: " + group_names(),
             [&](const std::string& text) { options.only = names_in(text); });
  add_sweep_flags(app, options);
  add_hz_flag(app, options);
  file_flag(app, "--report",
            "print the report of this study.json or stability.json again instead; nothing is measured",
            [&](const std::string& text) { options.report = text; });
  file_flag(app, "--page", "with --report: where to write its page",
            [&](const std::string& text) { options.page = text; });
  app.add_flag_callback(
      "--overwrite", [&] { options.overwrite = true; }, "replace what is in that folder of an earlier one");
  app.add_flag_callback(
      "--strict", [&] { options.reading.strict = true; }, "a stream that was cut off is an error");
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "the report on stdout as JSON");
  add_preset_flags(app, options.render);
  add_render_flags(app, options.render);
}

void check_study_flags(const CLI::App& app, StudyOptions& options) {
  options.profile_given = app.count("--profile") > 0;
  options.minutes_given = app.count("--minutes") > 0;
  options.light_given = app.count("--light-samples") + app.count("--quality") > 0;
  if (options.hz) check_hz_options(options);
  if (!options.report.empty()) {
    if (!options.session.empty())
      throw UsageError("--report: prints a study that is done; leave SESSION out");
    if (!options.page.empty() && options.page == options.report) {
      throw UsageError("--page: is the file of --report; give another name");
    }
    if (options.resume || options.overwrite || !options.export_to.empty() || !options.only.empty()) {
      throw UsageError("--report: measures nothing; leave --resume, --overwrite, --export and --only out");
    }
    return;
  }
  if (!options.page.empty()) {
    throw UsageError(std::string("--page: is of --report only; a study writes OUT/") +
                     (options.stability ? "stability.html" : "study.html"));
  }
  if (options.stability) check_stability_options(options);
  if (options.session.empty()) throw UsageError("SESSION: missing; give a session folder");
  if (options.resume && options.overwrite) {
    throw UsageError("--resume: conflicts with --overwrite; give one of them");
  }
}

}  // namespace herr
