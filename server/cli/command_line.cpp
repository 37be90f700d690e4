#include "server/cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>

#include "server/cli/flag_values.h"
#include "server/cli/version.h"

namespace herr {
namespace {

constexpr std::int64_t kMostFrames = 1'000'000'000;
constexpr double kLongestSeconds = 1e7;  // 115 days
constexpr int kWidestPolarBuffer = 16384;

using Reader = std::function<void(const std::string& text)>;

// A flag with a value. The reader runs once the whole line is understood.
void value_flag(CLI::App& app, const std::string& flag, const std::string& value_name,
                const std::string& help, const Reader& read) {
  app.add_option_function<std::string>(flag, read, help)->type_name(value_name)->take_last()->expected(1);
}

void file_flag(CLI::App& app, const std::string& flag, const std::string& help, const Reader& read) {
  value_flag(app, flag, "PATH", help, [flag, read](const std::string& text) {
    if (text.empty()) throw UsageError(flag + ": the path is empty; give a file or folder");
    read(text);
  });
}

void read_polar_size(const std::string& text, RenderSettings& render) {
  const SizeValue size = parse_size("--polar", text, kWidestPolarBuffer);
  if (size.width % 2 != 0 || size.height % 2 != 0) {
    throw UsageError(
        "--polar: both numbers must be even (the width is both eyes together); for example 1576x768");
  }
  if (size.height > kWidestPolarBuffer / 2) {
    throw UsageError("--polar: the height is at most " + std::to_string(kWidestPolarBuffer / 2));
  }
  render.polar_width = size.width / 2;
  render.polar_height = size.height;
}

// Settings that every rendering command shares.
void add_render_flags(CLI::App& app, RenderSettings& render) {
  value_flag(app, "--polar", "WxH", "polar buffer of both eyes together (default 1576x768)",
             [&render](const std::string& text) { read_polar_size(text, render); });
  value_flag(app, "--light-samples", "N",
             "shadow rays per light and hit, 1 ... 4096 (default 1: hard shadows)",
             [&render](const std::string& text) {
               render.light_samples = static_cast<int>(parse_whole_number("--light-samples", text, 1, 4096));
             });
  value_flag(app, "--threads", "N", "render threads, 1 ... 512 (default: all this process may use)",
             [&render](const std::string& text) {
               render.threads = static_cast<int>(parse_whole_number("--threads", text, 1, 512));
             });
  value_flag(app, "--isa", "NAME", "instruction set: sse4, avx2, avx512 or best (default best)",
             [&render](const std::string& text) {
               constexpr std::array<Isa, 4> kIsas{Isa::sse4, Isa::avx2, Isa::avx512, Isa::best};
               render.isa = kIsas.at(parse_word("--isa", text, {"sse4", "avx2", "avx512", "best"}));
             });
  app.add_flag_callback(
      "--no-reflections", [&render] { render.reflections = false; }, "trace no mirror rays");
  app.add_flag_callback(
      "--no-camera", [&render] { render.camera = false; }, "leave the camera feed out");
}

void add_picture_flags(CLI::App& app, ReplayOptions& options) {
  value_flag(app, "--format", "NAME", "pictures: png, exr or none (default png)",
             [&](const std::string& text) {
               constexpr std::array<PictureFormat, 3> kFormats{PictureFormat::png, PictureFormat::exr,
                                                               PictureFormat::none};
               options.format = kFormats.at(parse_word("--format", text, {"png", "exr", "none"}));
             });
  value_flag(app, "--foveation", "NAME", "log-polar, or off: one ray per pixel (default log-polar)",
             [&](const std::string& text) {
               const bool off = parse_word("--foveation", text, {"log-polar", "off"}) == 1;
               options.render.foveation = off ? Foveation::off : Foveation::log_polar;
             });
  app.add_flag_callback(
      "--gaze-marker", [&] { options.render.gaze_marker = true; }, "red circle at the gaze");
  app.add_flag_callback(
      "--debug-tiles", [&] { options.render.debug_tiles = true; },
      "colour the polar buffer in tiles of 15 degrees");
  value_flag(app, "--contact-sheet", "WHICH",
             "all viewports in one picture: none, all, middle or a frame number",
             [&](const std::string& text) {
               const bool number = !text.empty() && text.front() >= '0' && text.front() <= '9';
               if (number) {
                 options.sheet = SheetChoice::one;
                 options.sheet_frame = parse_whole_number("--contact-sheet", text, 0, kMostFrames);
                 return;
               }
               constexpr std::array<SheetChoice, 3> kChoices{SheetChoice::none, SheetChoice::all,
                                                             SheetChoice::middle};
               options.sheet = kChoices.at(parse_word("--contact-sheet", text, {"none", "all", "middle"}));
             });
}

// A word that the design knows but this version does not offer is told apart from a wrong one.
std::size_t parse_offered_word(const std::string& flag, const std::string& text,
                               const std::vector<std::string>& offered,
                               const std::vector<std::string>& later) {
  if (std::find(later.begin(), later.end(), text) != later.end()) {
    throw UsageError(flag + ": '" + text + "' is not available yet; use " + offered.front());
  }
  return parse_word(flag, text, offered);
}

void add_time_flags(CLI::App& app, ReplayOptions& options) {
  value_flag(app, "--policy", "NAME", "quality of each frame: fixed (default fixed)",
             [](const std::string& text) {
               parse_offered_word("--policy", text, {"fixed"}, {"motion", "deadline"});
             });
  value_flag(app, "--clock", "NAME",
             "virtual: one display period per frame; max: as fast as it goes (default virtual)",
             [&](const std::string& text) {
               const bool max = parse_offered_word("--clock", text, {"virtual", "max"}, {"realtime"}) == 1;
               options.clock = max ? ReplayClock::max : ReplayClock::virtual_time;
             });
  value_flag(app, "--sampling", "NAME", "headset state: latest, predict or interpolate (default latest)",
             [&](const std::string& text) {
               constexpr std::array<SamplingMode, 3> kModes{SamplingMode::latest, SamplingMode::predict,
                                                            SamplingMode::interpolate};
               options.session.sampling =
                   kModes.at(parse_word("--sampling", text, {"latest", "predict", "interpolate"}));
             });
  value_flag(app, "--start", "S", "begin this many seconds into the session (default 0)",
             [&](const std::string& text) {
               options.start_s = parse_real_number("--start", text, 0, kLongestSeconds);
             });
  value_flag(app, "--duration", "S", "replay this many seconds (default: to the end)",
             [&](const std::string& text) {
               options.duration_s = parse_real_number("--duration", text, 0, kLongestSeconds);
             });
  value_flag(app, "--frames", "N", "replay at most this many frames", [&](const std::string& text) {
    options.frames = parse_whole_number("--frames", text, 1, kMostFrames);
  });
}

void add_replay(CLI::App& app, ReplayOptions& options) {
  app.add_option("SESSION", options.sessions, "session folders")->required()->type_name("");
  file_flag(app, "--scene", "scene file (default: the one that the session names)",
            [&](const std::string& text) { options.scene = text; });
  file_flag(app, "--out", "folder for results; each session gets a folder in it (default out)",
            [&](const std::string& text) { options.out = text; });
  value_flag(app, "--profile", "NAME|FILE",
             "display profile: xr1, xr1-half or a file (default: the session's)",
             [&](const std::string& text) { options.profile = text; });
  add_picture_flags(app, options);
  add_time_flags(app, options);
  add_render_flags(app, options.render);
  app.add_flag_callback(
      "--overwrite", [&] { options.overwrite = true; }, "replace results that are there");
  app.add_flag_callback(
      "--keep-going", [&] { options.session.keep_going = true; },
      "skip bad rows and images, end with exit code 5");
  app.add_flag_callback(
      "--strict", [&] { options.session.strict = true; }, "a stream that was cut off is an error");
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "results on stdout as JSON");
}

void add_bench(CLI::App& app, BenchOptions& options) {
  app.add_option("SESSION", options.session, "session folder (default: the sample desk-walk)")->type_name("");
  file_flag(app, "--scene", "scene file (default: the one that the session names)",
            [&](const std::string& text) { options.scene = text; });
  value_flag(app, "--profile", "NAME|FILE",
             "display profile: xr1, xr1-half or a file (default: the session's)",
             [&](const std::string& text) { options.profile = text; });
  add_render_flags(app, options.render);
  value_flag(app, "--frames", "N", "instants of the session to measure (default 8)",
             [&](const std::string& text) {
               options.frames = static_cast<int>(parse_whole_number("--frames", text, 1, 10000));
             });
  value_flag(app, "--repeats", "N", "measurements of each instant (default 5)", [&](const std::string& text) {
    options.repeats = static_cast<int>(parse_whole_number("--repeats", text, 1, 1000));
  });
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "results on stdout as JSON");
}

void add_synth(CLI::App& app, SynthOptions& options) {
  app.add_option("OUT", options.out, "folder of the new session; must be empty or new")
      ->required()
      ->type_name("");
  file_flag(app, "--scene", "the room that the camera sees",
            [&](const std::string& text) { options.room = text; });
  file_flag(app, "--replay-scene", "scene that session.json names, relative to OUT",
            [&](const std::string& text) { options.scene = text; });
  value_flag(app, "--seed", "N", "same seed, same session (default 1)", [&](const std::string& text) {
    options.seed = static_cast<std::uint64_t>(parse_whole_number("--seed", text, 0, kMostFrames));
  });
  const auto number = [&app](const std::string& flag, const std::string& help, double lowest, double highest,
                             double& value) {
    value_flag(app, flag, "X", help, [flag, lowest, highest, &value](const std::string& text) {
      value = parse_real_number(flag, text, lowest, highest);
    });
  };
  number("--duration", "seconds (default 2)", 0.1, 36000, options.duration_s);
  number("--hz", "rate of the poses (default 90)", 1, 1000, options.pose_hz);
  number("--gaze-hz", "rate of the gaze (default 120)", 1, 1000, options.gaze_hz);
  number("--camera-hz", "rate of the camera (default 10)", 0.1, 240, options.camera_hz);
  number("--camera-hfov", "width of the camera's view in degrees (default 90)", 10, 150,
         options.camera_hfov_deg);
  value_flag(app, "--camera-size", "WxH", "size of its pictures (default 480x360)",
             [&](const std::string& text) {
               const SizeValue size = parse_size("--camera-size", text, 4096);
               options.camera_width_px = size.width;
               options.camera_height_px = size.height;
             });
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::vector<std::string> long_flags(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
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
  BenchOptions bench;
  SynthOptions synth;
  bool show_version = false;
  CLI::App* replay_command = nullptr;
  CLI::App* bench_command = nullptr;
  CLI::App* synth_command = nullptr;

  Parser() {
    app.add_flag("--version", show_version, "show the version");
    replay_command = app.add_subcommand("replay", "render recorded sessions to files");
    bench_command = app.add_subcommand("bench", "frame time against the time of its bare rays and pixels");
    synth_command = app.add_subcommand("synth", "make a synthetic session");
    add_replay(*replay_command, replay);
    add_bench(*bench_command, bench);
    add_synth(*synth_command, synth);
    app.require_subcommand(0, 1);
    app.footer("'herr COMMAND --help' lists the flags of a command.");
  }

  const CLI::App* chosen() const {
    for (const CLI::App* command : {replay_command, bench_command, synth_command}) {
      if (command->parsed()) return command;
    }
    return nullptr;
  }
};

bool has(const std::vector<std::string>& arguments, std::string_view flag) {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  return std::find(arguments.begin(), end, flag) != end;
}

std::string help_text(const Parser& parser, const std::vector<std::string>& arguments) {
  for (const CLI::App* command : {parser.replay_command, parser.bench_command, parser.synth_command}) {
    if (!arguments.empty() && arguments.front() == command->get_name()) return command->help("herr");
  }
  return parser.app.help();
}

void check_required(const SynthOptions& options) {
  if (options.out.empty()) throw UsageError("OUT: the path is empty; give a folder");
  if (options.room.empty()) throw UsageError("--scene: missing; give the scene file of the room");
}

}  // namespace

Command parse_command_line(const std::vector<std::string>& arguments) {
  const auto parser = std::make_unique<Parser>();
  // Help and version never fail, whatever else the line says.
  if (has(arguments, "--help") || has(arguments, "-h")) return ShowText{help_text(*parser, arguments)};
  if (has(arguments, "--version")) return ShowText{std::string(program_with_version()) + "\n"};
  try {
    parser->app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ExtrasError& error) {
    refuse_extras(parser->app, parser->chosen(), error);
  } catch (const CLI::ParseError& error) {
    throw UsageError(one_line(error.what()) + "; 'herr --help' shows the usage");
  }
  if (parser->replay_command->parsed()) return parser->replay;
  if (parser->bench_command->parsed()) return parser->bench;
  if (parser->synth_command->parsed()) {
    check_required(parser->synth);
    return parser->synth;
  }
  throw UsageError("no command; 'herr --help' lists the commands");
}

}  // namespace herr
