#include "server/cli/check_flags.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "renderer/settings_list.h"
#include "renderer/settings_presets.h"
#include "server/cli/flags.h"
#include "server/cli/setting_flags.h"
#include "server/settings/flag_values.h"
#include "server/settings/run_settings.h"

namespace herr {
namespace {

// Of the command, not of the runs that it starts. --frames is given to each run by the command.
constexpr std::array<std::string_view, 15> kOfTheCommand{
    "--against",     "--baseline",        "--save",        "--only",      "--run-seconds",
    "--max-seconds", "--allow-different", "--frames",      "--overwrite", "--json",
    "--markdown",    "--junit",           "--annotations", "--measure",   "--slow-down"};

// Adds the flags of what --preset chooses between, as it is: another build may know no preset, or begin with
// another one. Returns their names, which are then no longer taken from the line.
std::vector<std::string> add_flags_of_preset(RenderSettings render, std::vector<std::string>& flags) {
  std::vector<std::string> names{"--preset"};
  RenderSettings direct = direct_light_settings(), paper;
  const std::vector<Setting> rows = settings_of(render), some = settings_of(direct), all = settings_of(paper);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Setting& row = rows[i];
    if (text_of(some[i]) == text_of(all[i])) continue;
    names.push_back(row.flag);
    if (!is_switch(row)) {
      flags.insert(flags.end(), {row.flag, text_of(row)});
      continue;
    }
    names.push_back(row.back_flag);
    const bool changed = (text_of(row) == "on") != row.flag.starts_with("--no-");
    flags.push_back(changed ? row.flag : row.back_flag);
  }
  return names;
}

AllowedDifferences read_parts(const std::string& text) {
  try {
    return allowed_differences_from(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--allow-different: ") + error.what());
  }
}

void add_comparison_flags(CLI::App& app, CheckOptions& options) {
  file_flag(app, "--against", "compare with this other build of herr, in alternating runs",
            [&](const std::string& text) { options.against = text; });
  file_flag(app, "--save", "store runs as a baseline in this file",
            [&](const std::string& text) { options.save = text; });
  file_flag(app, "--baseline", "compare with the runs stored in this file",
            [&](const std::string& text) { options.baseline = text; });
  value_flag(app, "--only", "TIER", "decide by counters (seconds, any machine) or by times alone",
             [&](const std::string& text) {
               const bool counters = parse_word("--only", text, {"counters", "times"}) == 0;
               options.tiers = counters ? CheckedTiers::counters : CheckedTiers::times;
             });
  value_flag(app, "--run-seconds", "S", "length of a measured run (default 1.5; --frames says it instead)",
             [&](const std::string& text) {
               options.run_seconds = parse_real_number("--run-seconds", text, 0.01, 600);
             });
  value_flag(
      app, "--max-seconds", "S",
      "end the check by then, 1 ... 1000000, with the verdict that the runs so far allow: 4 where they "
      "are too few",
      [&](const std::string& text) {
        options.max_seconds = parse_real_number("--max-seconds", text, 1, 1e6);
      });
  value_flag(
      app, "--allow-different", "PART,...",
      "compare although these differ, and say how: scene, settings, session; of --against, settings alone",
      [&](const std::string& text) { options.allowed = read_parts(text); });
  value_flag(
      app, "--slow-down", "PERCENT",
      "shows that the gate goes red: each frame of this program waits busily for this share of its time, "
      "0.1 ... 1000; not with --save or --only counters",
      [&](const std::string& text) {
        options.run.slow_down_percent = parse_real_number("--slow-down", text, 0.1, 1000);
      });
  app.add_flag_callback(
      "--overwrite", [&] { options.overwrite = true; }, "replace the file of --save");
}

void add_report_flags(CLI::App& app, CheckOptions& options) {
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "the report on stdout as JSON");
  file_flag(app, "--markdown", "append the report to this file as Markdown",
            [&](const std::string& text) { options.markdown = text; });
  file_flag(app, "--junit", "write the report to this file as JUnit XML",
            [&](const std::string& text) { options.junit = text; });
  value_flag(app, "--annotations", "NAME", "print what failed as annotations of a CI system: github",
             [&](const std::string& text) {
               parse_word("--annotations", text, {"github"});
               options.github_annotations = true;
             });
}

// Quality that follows the load would hide a regression, and writing pictures would drown it.
void add_forced_flags(CLI::App& app) {
  const auto only = [&app](const std::string& flag, const std::string& value, const std::string& help) {
    value_flag(app, flag, "NAME", help + ": " + value, [flag, value](const std::string& text) {
      if (text != value) throw UsageError(flag + ": check measures with '" + value + "' alone; leave it out");
    });
  };
  only("--policy", "fixed", "quality of each frame");
  only("--format", "none", "pictures");
}

// What part of the session a check measures: other words than those of a replay, which renders it all.
std::string sentence_of_span(const Setting& setting) {
  if (setting.name == "start_s") return "measure from this many seconds into the session on";
  if (setting.name == "duration_s") return "measure frames of this many seconds of the session at most";
  return "frames that each run renders, in place of --run-seconds; those after the first ten, but the last "
         "half at least, are measured, for counters and for times";
}

void add_span_flags(CLI::App& app, ReplayOptions& replay) {
  for (Setting setting : settings_of(replay)) {
    if (setting.group != SettingGroup::span) continue;
    setting.sentence = sentence_of_span(setting);
    if (setting.name == "frames")
      setting.otherwise =
          "as many as last --run-seconds, 30 for --only counters, "
          "those of --baseline";
    add_setting_flag(app, setting);
  }
}

// Between this program and the processes that it starts.
void add_hidden_flags(CLI::App& app, CheckOptions& options) {
  app.add_flag_callback(
         "--measure", [&] { options.measure = true; }, "be one measured run")
      ->group("");
}

}  // namespace

void add_check_flags(CLI::App& app, CheckOptions& options) {
  ReplayOptions& replay = options.run.replay;
  replay.formats = {};
  replay.sheet = SheetChoice::none;
  add_session_flags(app, replay);
  add_comparison_flags(app, options);
  add_report_flags(app, options);
  add_forced_flags(app);
  add_preset_flags(app, replay.render);
  add_setting_flags(app, settings_of(replay), {SettingGroup::session, SettingGroup::look});
  add_span_flags(app, replay);
  add_render_flags(app, replay.render);
  add_hidden_flags(app, options);
}

std::vector<std::string> measured_run_arguments(const CLI::App& app, const RenderSettings& render) {
  std::vector<std::string> flags, session;
  const std::vector<std::string> of_preset = add_flags_of_preset(render, flags);
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0) continue;
    if (option->get_positional()) {
      session = option->results();
      continue;
    }
    const std::string name = "--" + option->get_lnames().front();  // get_name() is empty for a hidden one
    if (std::find(kOfTheCommand.begin(), kOfTheCommand.end(), name) != kOfTheCommand.end()) continue;
    if (std::find(of_preset.begin(), of_preset.end(), name) != of_preset.end()) continue;
    flags.push_back(name);
    if (option->get_items_expected_max() == 0) continue;
    flags.push_back(option->results().back());
    // Of a flag that may be given several times, every value.
    if (option->get_multi_option_policy() != CLI::MultiOptionPolicy::TakeAll) continue;
    for (std::size_t i = 0; i + 1 < option->results().size(); ++i)
      flags.insert(flags.end() - 1, {option->results()[i], name});
  }
  flags.insert(flags.end(), session.begin(), session.end());
  return flags;
}

}  // namespace herr
