#include "server/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <memory>

#include "renderer/settings_list.h"
#include "server/cli/check_flags.h"
#include "server/cli/convert_flags.h"
#include "server/cli/flags.h"
#include "server/cli/look_flags.h"
#include "server/cli/setting_flags.h"
#include "server/cli/study_flags.h"
#include "server/cli/synth_flags.h"
#include "server/process/version.h"
#include "server/settings/flag_values.h"
#include "server/settings/option_checks.h"
#include "server/settings/run_settings.h"
#include "server/synth/synth_command.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

void add_bench(CLI::App& app, BenchOptions& options) {
  app.add_option("SESSION", options.session, "session folder (default: the sample desk-walk)")->type_name("");
  add_scene_flags(app, options.scene, options.asset_roots);
  add_setting_flags(app, profile_settings(options.profile, options.profile_scale), {SettingGroup::session});
  add_preset_flags(app, options.render);
  add_render_flags(app, options.render);
  value_flag(app, "--frames", "N", "frames of the session to measure, spread over it (default 8)",
             [&](const std::string& text) {
               options.frames = static_cast<int>(parse_whole_number("--frames", text, 1, 10000));
             });
  value_flag(app, "--repeats", "N", "times that these frames are measured, in order (default 5)",
             [&](const std::string& text) {
               options.repeats = static_cast<int>(parse_whole_number("--repeats", text, 1, 1000));
             });
  app.add_flag_callback(
      "--table", [&] { options.table = true; },
      "average frame times with 1, 64 and 256 light samples instead, for polar buffers 1576x768 and "
      "2048x1024 "
      "or the one of --polar");
  app.add_flag_callback(
      "--left-out", [&] { options.left_out = true; },
      "what the frame plan leaves out of this scene instead, and the time and memory that this saves");
  value_flag(
      app, "--seconds", "S", "frame time that each cell of --table is averaged over (default 10)",
      [&](const std::string& text) { options.seconds = parse_real_number("--seconds", text, 0.001, 3600); });
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "results on stdout as JSON");
}

// What probes know, as pictures.
void add_probe_dump_flags(CLI::App& app, InspectOptions& options) {
  file_flag(app, "--probe-pictures", "new folder for what the scene's probes know, as pictures and an index",
            [&](const std::string& text) {
              options.probes.folder = text;
              options.render.probes.on = true;
            });
  // Elsewhere --probes is a switch.
  app.add_option_function<std::vector<std::string>>(
         "--probes",
         [](const std::vector<std::string>&) {
           throw UsageError("--probes: is called --probe-pictures here; give --probe-pictures DIR");
         },
         "")
      ->expected(0, 1)
      ->group("");
  value_flag(app, "--probe-updates", "N",
             "updates of every probe before that, 1 ... 100000 (default " +
                 std::to_string(kDefaultProbeUpdates) + ")",
             [&](const std::string& text) {
               options.probes.updates =
                   static_cast<int>(parse_whole_number("--probe-updates", text, 1, 100000));
             });
  app.add_flag_callback(
      "--no-probes", [&] { options.render.probes.on = false; }, "the frame plan without probes");
  const std::vector<Setting> settings = settings_of(options.render);
  add_setting_flag(app, setting_named(settings, "probe_rays"));
  add_setting_flags(app, settings, {SettingGroup::machine});
  app.add_flag_callback(
      "--overwrite", [&] { options.overwrite = options.probes.overwrite = true; },
      "replace what an earlier --probe-pictures or --acuity-plot wrote");
}

// What no single flag of bench can know.
void check_bench_flags(const CLI::App& app, BenchOptions& options) {
  options.polar_given = app.count("--polar") > 0;
  if (options.table && options.left_out)
    throw UsageError("--left-out: conflicts with --table; give one of them");
  if (!options.table) {
    if (app.count("--seconds") > 0) throw UsageError("--seconds: is of --table only; leave it out");
    return;
  }
  for (const char* flag : {"--light-samples", "--quality"}) {
    if (app.count(flag) > 0)
      throw UsageError(std::string(flag) + ": the columns of --table have 1, 64 and 256; leave it out");
  }
  if (app.count("--repeats") > 0) throw UsageError("--repeats: --table has --seconds instead");
}

void add_inspect(CLI::App& app, InspectOptions& options) {
  app.add_option("PATH", options.path, "session folder, or a scene: .scene.json, .gltf, .glb, .vox")
      ->required()
      ->type_name("");
  add_scene_flags(app, options.scene, options.asset_roots);
  add_setting_flags(app, profile_settings(options.profile, options.profile_scale), {SettingGroup::session});
  add_preset_flags(app, options.render);
  add_setting_flags(app, settings_of(options.render), {SettingGroup::look, SettingGroup::rays});
  app.add_flag_callback(
      "--decode", [&] { options.decode = true; }, "read every picture whole, not only its header");
  file_flag(
      app, "--acuity-plot",
      "new .svg file: samples per degree over eccentricity, against the acuity function and the display",
      [&](const std::string& text) { options.acuity_plot = text; });
  add_probe_dump_flags(app, options);
  app.add_flag_callback(
      "--strict", [&] { options.strict = true; }, "a stream that was cut off is an error");
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "results on stdout as JSON");
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::vector<std::string> long_flags(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;  // of old, and refused
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// A flag before the command, which has only --help and --version there.
void refuse_early_flag(const std::vector<std::string>& arguments, const std::string& command) {
  if (arguments.empty() || !arguments.front().starts_with("-") || arguments.front() == "--") return;
  const std::string flag = printable(arguments.front().substr(0, arguments.front().find('=')));
  if (command.empty())
    throw UsageError(flag +
                     ": flags go after a command, and there is none; 'herr --help' lists the commands");
  throw UsageError(flag + ": flags go after the command: 'herr " + command + " " + flag + " ...'; 'herr " +
                   command + " --help' lists all");
}

// What the parser says of a line that it cannot take: "--frames: its value (N) is missing".
std::string parser_message(const CLI::ParseError& error) {
  std::string message = one_line(error.what());
  constexpr std::string_view kRequired = ": 1 required ", kMissing = " missing";
  const std::size_t at = message.find(kRequired);
  if (at == std::string::npos || !message.ends_with(kMissing)) return message;
  const std::size_t from = at + kRequired.size();
  const std::string value = message.substr(from, message.size() - kMissing.size() - from);
  return message.substr(0, at) + ": its value (" + value + ") is missing";
}

// What the line says that no command understands.
[[noreturn]] void refuse_extras(const CLI::App& app, const CLI::App* command, const CLI::Error& error) {
  const CLI::App& place = command != nullptr ? *command : app;
  const std::string name = command != nullptr ? "herr " + command->get_name() : "herr";
  std::vector<std::string> extras = place.remaining();
  if (extras.empty()) extras = app.remaining();
  for (const std::string& extra : extras) {
    if (extra.starts_with("-")) throw UsageError(unknown_flag_message(extra, long_flags(place), name));
  }
  if (!extras.empty()) {
    std::vector<std::string> commands;
    for (const CLI::App* known : app.get_subcommands({})) commands.push_back(known->get_name());
    if (command == nullptr) {
      parse_word("command", extras.front(), commands);
    }
    throw UsageError("'" + extras.front() + "' is one argument too many; '" + name +
                     " --help' shows the usage");
  }
  throw UsageError(one_line(error.what()));
}

// The options live beside the parser that fills them.
struct Parser {
  CLI::App app{"herr replays recorded XR sessions and ray-traces each frame with log-polar foveation.",
               "herr"};
  ReplayOptions replay;
  ServeOptions serve;
  BenchOptions bench;
  CheckOptions check;
  InspectOptions inspect;
  LookOptions look;
  StudyOptions study;
  SynthOptions synth;
  ConvertOptions convert;
  bool show_version = false;
  CLI::App* replay_command = nullptr;
  CLI::App* serve_command = nullptr;
  CLI::App* bench_command = nullptr;
  CLI::App* check_command = nullptr;
  CLI::App* inspect_command = nullptr;
  CLI::App* look_command = nullptr;
  CLI::App* study_command = nullptr;
  CLI::App* synth_command = nullptr;
  CLI::App* convert_command = nullptr;

  Parser() {
    app.add_flag("--version", show_version, "show the version");
    replay_command = app.add_subcommand("replay", "render recorded sessions to files");
    serve_command = app.add_subcommand("serve", "replay sessions in a loop behind HTTP");
    bench_command = app.add_subcommand("bench", "frame time against the time of its bare rays and pixels");
    check_command = app.add_subcommand("check", "did frames become slower? a gate for CI");
    study_command = app.add_subcommand(
        "study",
        "error against run time, for every setting that trades them; the largest setting that holds a rate; "
        "relations that must hold");
    inspect_command = app.add_subcommand("inspect", "check and describe a session or a scene");
    look_command = app.add_subcommand("look", "a picture of a model, without a session");
    synth_command = app.add_subcommand("synth", "make a synthetic session");
    convert_command = app.add_subcommand("convert", "make a session of a recording in another format");
    add_replay_flags(*replay_command, replay);
    add_serve_flags(*serve_command, serve);
    add_bench(*bench_command, bench);
    add_check_flags(*check_command, check);
    add_study_flags(*study_command, study);
    add_inspect(*inspect_command, inspect);
    add_look_flags(*look_command, look);
    add_synth_flags(*synth_command, synth);
    add_convert_flags(*convert_command, convert);
    app.require_subcommand(0, 1);
    app.footer("'herr COMMAND --help' lists the flags of a command.");
  }

  const CLI::App* chosen() const {
    for (const CLI::App* command : commands()) {
      if (command->parsed()) return command;
    }
    return nullptr;
  }
  std::array<const CLI::App*, 9> commands() const {
    return {replay_command,  serve_command, bench_command, check_command,  study_command,
            inspect_command, look_command,  synth_command, convert_command};
  }
};

bool has(const std::vector<std::string>& arguments, std::string_view flag) {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  return std::find(arguments.begin(), end, flag) != end;
}

std::vector<std::string> command_names(const Parser& parser) {
  std::vector<std::string> names;
  for (const CLI::App* command : parser.commands()) names.push_back(command->get_name());
  return names;
}

std::string help_text(const Parser& parser, const std::vector<std::string>& arguments) {
  for (const CLI::App* command : parser.commands()) {
    if (!arguments.empty() && arguments.front() == command->get_name()) return command->help("herr");
  }
  return parser.app.help();
}

// 'herr help', 'herr help COMMAND'.
std::string help_on(const Parser& parser, const std::vector<std::string>& arguments) {
  const std::vector<std::string> asked(arguments.begin() + 1, arguments.end());
  if (!asked.empty()) parse_word("help", asked.front(), command_names(parser));
  return help_text(parser, asked);
}

// The first word that is a command; empty: none is.
std::string command_named(const Parser& parser, const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    for (const CLI::App* command : parser.commands()) {
      if (argument == command->get_name()) return argument;
    }
  }
  return "";
}

void check_required(const ReplayOptions& options) {
  for (const std::filesystem::path& session : options.sessions) non_empty("SESSION", session.native());
}

void check_required(const InspectOptions& options) {
  non_empty("PATH", options.path.native());
  if (!options.probes.folder.empty()) {
    if (!options.render.probes.on)
      throw UsageError("--no-probes: conflicts with --probe-pictures; give one of them");
    return;
  }
  if (options.overwrite && options.acuity_plot.empty())
    throw UsageError("--overwrite: nothing is written; give --probe-pictures DIR or --acuity-plot FILE");
  if (options.probes.updates != kDefaultProbeUpdates)
    throw UsageError("--probe-updates: nothing is updated; give --probe-pictures DIR");
}

void check_required(const SynthOptions& options) {
  if (options.out.empty()) throw UsageError("OUT: the path is empty; give a folder");
  check_synth_options(options);
}

}  // namespace

Command parse_command_line(const std::vector<std::string>& arguments) {
  const auto parser = std::make_unique<Parser>();
  // Help and version never fail, whatever else the line says.
  if (has(arguments, "--help") || has(arguments, "-h")) return ShowText{help_text(*parser, arguments)};
  if (has(arguments, "--version")) return ShowText{std::string(program_with_version()) + "\n"};
  if (!arguments.empty() && arguments.front() == "help") return ShowText{help_on(*parser, arguments)};
  const std::string named = command_named(*parser, arguments);
  refuse_early_flag(arguments, named);
  try {
    parser->app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ExtrasError& error) {
    refuse_extras(parser->app, parser->chosen(), error);
  } catch (const CLI::ParseError& error) {
    throw UsageError(parser_message(error) + "; 'herr" + (named.empty() ? "" : " " + named) +
                     " --help' shows the usage");
  }
  if (parser->replay_command->parsed()) {
    check_replay_options(parser->replay);
    check_required(parser->replay);
    return parser->replay;
  }
  if (parser->serve_command->parsed()) {
    check_serve_options(parser->serve);
    check_required(parser->serve.replay);
    return parser->serve;
  }
  if (parser->bench_command->parsed()) {
    check_bench_flags(*parser->bench_command, parser->bench);
    return parser->bench;
  }
  if (parser->check_command->parsed()) {
    parser->check.run_arguments =
        measured_run_arguments(*parser->check_command, parser->check.run.replay.render);
    check_check_options(parser->check);
    return parser->check;
  }
  if (parser->study_command->parsed()) {
    check_study_flags(*parser->study_command, parser->study);
    return parser->study;
  }
  if (parser->inspect_command->parsed()) {
    check_required(parser->inspect);
    return parser->inspect;
  }
  if (parser->look_command->parsed()) {
    check_look_options(parser->look);
    return parser->look;
  }
  if (parser->synth_command->parsed()) {
    check_required(parser->synth);
    return parser->synth;
  }
  if (parser->convert_command->parsed()) {
    check_convert_flags(parser->convert);
    parser->convert.arguments.assign(arguments.begin() + 1, arguments.end());
    return parser->convert;
  }
  throw UsageError("no command; 'herr --help' lists the commands");
}

}  // namespace herr
