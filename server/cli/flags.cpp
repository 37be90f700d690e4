#include "server/cli/flags.h"

#include <arpa/inet.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <stdexcept>

#include "scenes/model/scene.h"
#include "server/settings/flag_values.h"
#include "server/settings/option_checks.h"
#include "sessions/files/input_error.h"

namespace herr {
namespace {

constexpr double kLongestSeconds = 1e7;  // 115 days
constexpr int kWidestPolarBuffer = 16384;

bool is_ipv4_loopback(const std::string& text) {
  in_addr address{};
  return ::inet_pton(AF_INET, text.c_str(), &address) == 1 && (ntohl(address.s_addr) >> 24) == 127;
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

// As a Host header has it, in lower case, without a port.
std::string parse_host_name(const std::string& text) {
  std::string name = text;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  // The parser of the command line takes brackets for those of a list, and away.
  if (name.find(':') != std::string::npos && !name.starts_with('[')) name = "[" + name + "]";
  const bool ipv6 = name.size() > 2 && name.front() == '[' && name.back() == ']';
  const std::string allowed = ipv6 ? "[]0123456789abcdef:." : "0123456789abcdefghijklmnopqrstuvwxyz-._";
  if (name.empty() || name.size() > 253 || name.find_first_not_of(allowed) != std::string::npos)
    throw UsageError("--allowed-host: '" + printable(text) +
                     "' is no name of a host; give one without scheme and port");
  return name;
}

// Light that bounces between surfaces.
void add_probe_flags(CLI::App& app, ProbeSettings& probes) {
  app.add_flag_callback(
      "--probes", [&] { probes.on = true; }, "light that bounces between surfaces, gathered by probes");
  app.add_flag_callback(
      "--no-probes", [&] { probes.on = false; }, "constant ambient light instead (the default)");
  value_flag(app, "--probe-budget", "N", "probes updated in a frame, in turn (default 0: all)",
             [&](const std::string& text) {
               probes.budget = static_cast<int>(parse_whole_number("--probe-budget", text, 0, kMostProbes));
             });
  add_probe_ray_flag(app, probes);
}

// Which files are written.
void add_picture_flags(CLI::App& app, ReplayOptions& options) {
  value_flag(app, "--format", "NAME", "pictures: png, exr or none (default png)",
             [&](const std::string& text) {
               constexpr std::array<PictureFormat, 3> kFormats{PictureFormat::png, PictureFormat::exr,
                                                               PictureFormat::none};
               options.format = kFormats.at(parse_word("--format", text, {"png", "exr", "none"}));
             });
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

// How the quality of each frame is chosen.
void add_policy_flags(CLI::App& app, ReplayOptions& options) {
  value_flag(app, "--policy", "NAME",
             "quality of each frame: fixed; motion: less while the head moves fast; deadline: what holds "
             "--target-ms; motion+deadline (default fixed)",
             [&](const std::string& text) {
               constexpr std::array<QualityPolicy, 4> kPolicies{
                   QualityPolicy{false, false}, {true, false}, {false, true}, {true, true}};
               options.policy = kPolicies.at(
                   parse_word("--policy", text, {"fixed", "motion", "deadline", "motion+deadline"}));
             });
  value_flag(app, "--polar-floor", "N",
             "least width of the polar buffers, both eyes together, that a policy may choose (default: an "
             "eighth of that of --polar)",
             [&](const std::string& text) {
               const std::int64_t both = parse_whole_number("--polar-floor", text, 2, kWidestPolarBuffer);
               if (both % 2 != 0) throw UsageError("--polar-floor: must be even: it is both eyes together");
               options.narrowest_width = static_cast<int>(both / 2);
             });
}

void add_time_flags(CLI::App& app, ReplayOptions& options) {
  add_policy_flags(app, options);
  const std::string default_clock = name_of(options.clock);
  value_flag(
      app, "--clock", "NAME",
      "virtual: one display period per frame; realtime: late frames drop; max: as fast as it goes (default " +
          default_clock + ")",
      [&](const std::string& text) {
        constexpr std::array<ReplayClock, 3> kClocks{ReplayClock::virtual_time, ReplayClock::realtime,
                                                     ReplayClock::max};
        options.clock = kClocks.at(parse_word("--clock", text, {"virtual", "realtime", "max"}));
      });
  value_flag(
      app, "--target-ms", "MS",
      "display period of the clock realtime, time of a frame of the policy deadline (default: the profile's)",
      [&](const std::string& text) { options.target_ms = parse_real_number("--target-ms", text, 1, 10000); });
  add_span_flags(app, options);
}

}  // namespace

void value_flag(CLI::App& app, const std::string& flag, const std::string& value_name,
                const std::string& help, const FlagReader& read) {
  app.add_option_function<std::string>(flag, read, help)->type_name(value_name)->take_last()->expected(1);
}

void file_flag(CLI::App& app, const std::string& flag, const std::string& help, const FlagReader& read) {
  value_flag(app, flag, "PATH", help, [flag, read](const std::string& text) { read(non_empty(flag, text)); });
}

void add_session_flags(CLI::App& app, ReplayOptions& options) {
  app.add_option("SESSION", options.sessions, "session folders")->required()->type_name("");
  file_flag(app, "--scene", "scene file (default: the one that the session names)",
            [&](const std::string& text) { options.scene = text; });
  value_flag(app, "--profile", "NAME|FILE",
             "display profile: xr1, xr1-half or a file (default: the session's)",
             [&](const std::string& text) { options.profile = non_empty("--profile", text); });
  app.add_flag_callback(
      "--strict", [&] { options.session.strict = true; }, "a stream that was cut off is an error");
}

void add_span_flags(CLI::App& app, ReplayOptions& options) {
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

void add_look_flags(CLI::App& app, RenderSettings& render) {
  value_flag(app, "--foveation", "NAME", "log-polar, or off: one ray per pixel (default log-polar)",
             [&render](const std::string& text) {
               const bool off = parse_word("--foveation", text, {"log-polar", "off"}) == 1;
               render.foveation = off ? Foveation::off : Foveation::log_polar;
             });
  app.add_flag_callback(
      "--gaze-marker", [&render] { render.gaze_marker = true; }, "red circle at the gaze");
  app.add_flag_callback(
      "--debug-tiles", [&render] { render.debug_tiles = true; },
      "colour the polar buffer in tiles of 15 degrees");
}

void add_plan_flags(CLI::App& app, RenderSettings& render) {
  value_flag(app, "--polar", "WxH", "polar buffer of both eyes together (default 1576x768)",
             [&render](const std::string& text) { read_polar_size(text, render); });
  value_flag(app, "--light-samples", "N",
             "shadow rays per light and hit, 1 ... 4096 (default 1: hard shadows)",
             [&render](const std::string& text) {
               render.light_samples =
                   static_cast<int>(parse_whole_number("--light-samples", text, 1, kMostLightSamples));
             });
  value_flag(app, "--quality", "NAME", "shadows: hard, soft or ultra, that is 1, 64 or 256 light samples",
             [&render](const std::string& text) {
               constexpr std::array<int, 3> kSamples{1, 64, 256};
               render.light_samples = kSamples.at(parse_word("--quality", text, {"hard", "soft", "ultra"}));
             });
  value_flag(
      app, "--first-light-samples", "N",
      "adaptive, up to 256 light samples: trace N, the rest only where they disagree; 0: all (default 0)",
      [&render](const std::string& text) {
        render.first_light_samples =
            static_cast<int>(parse_whole_number("--first-light-samples", text, 0, kMostLightSamples));
      });
  value_flag(app, "--occlusion-rays", "N",
             "short rays of ambient occlusion per hit, 0 ... 64 (default 0: none)",
             [&render](const std::string& text) {
               render.occlusion_rays = static_cast<int>(parse_whole_number("--occlusion-rays", text, 0, 64));
             });
  value_flag(app, "--occlusion-radius", "M", "metres that they reach, 0.001 ... 1000 (default 0.3)",
             [&render](const std::string& text) {
               render.occlusion_radius_m = parse_real_number("--occlusion-radius", text, 0.001, 1000);
             });
  app.add_flag_callback(
      "--no-reflections", [&render] { render.reflections = false; }, "trace no mirror rays");
  app.add_flag_callback(
      "--no-refraction", [&render] { render.refraction = false; }, "draw transparent materials opaque");
  app.add_flag_callback(
      "--no-camera", [&render] { render.camera = false; }, "leave the camera feed out");
}

void add_probe_ray_flag(CLI::App& app, ProbeSettings& probes) {
  value_flag(app, "--probe-rays", "N", "rays of a probe and update, 8 ... 512 (default 64)",
             [&probes](const std::string& text) {
               probes.rays = static_cast<int>(parse_whole_number("--probe-rays", text, 8, 512));
             });
}

void add_render_flags(CLI::App& app, RenderSettings& render) {
  add_plan_flags(app, render);
  add_probe_flags(app, render.probes);
  add_machine_flags(app, render);
}

void add_machine_flags(CLI::App& app, RenderSettings& render) {
  value_flag(app, "--threads", "N", "render threads, 1 ... 512 (default: all this process may use)",
             [&render](const std::string& text) {
               render.threads = static_cast<int>(parse_whole_number("--threads", text, 1, 512));
             });
  value_flag(app, "--isa", "NAME", "instruction set: sse4, avx2, avx512 or best (default best)",
             [&render](const std::string& text) {
               constexpr std::array<Isa, 4> kIsas{Isa::sse4, Isa::avx2, Isa::avx512, Isa::best};
               render.isa = kIsas.at(parse_word("--isa", text, {"sse4", "avx2", "avx512", "best"}));
             });
}

void add_replay_flags(CLI::App& app, ReplayOptions& options) {
  add_session_flags(app, options);
  file_flag(app, "--out", "folder for results; each session gets a folder in it (default out)",
            [&](const std::string& text) { options.out = text; });
  add_picture_flags(app, options);
  add_look_flags(app, options.render);
  add_time_flags(app, options);
  add_render_flags(app, options.render);
  app.add_flag_callback(
      "--overwrite", [&] { options.overwrite = true; }, "replace results that are there");
  app.add_flag_callback(
      "--resume", [&] { options.resume = true; }, "go on with a replay that was interrupted");
  app.add_flag_callback(
      "--keep-going", [&] { options.session.keep_going = true; },
      "skip bad rows and images, end with exit code 5");
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "results on stdout as JSON");
}

void add_serve_flags(CLI::App& app, ServeOptions& options) {
  options.replay.clock = ReplayClock::realtime;
  options.replay.format = PictureFormat::none;
  options.replay.sheet = SheetChoice::none;
  add_session_flags(app, options.replay);
  value_flag(app, "--host", "ADDRESS", "address of this machine to listen on (default 127.0.0.1)",
             [&](const std::string& text) { options.host = non_empty("--host", text); });
  value_flag(app, "--port", "N", "port, 0 ... 65535; 0: a free one (default 8080)",
             [&](const std::string& text) {
               options.port = static_cast<int>(parse_whole_number("--port", text, 0, 65535));
             });
  app.add_option_function<std::vector<std::string>>(
         "--allowed-host",
         [&](const std::vector<std::string>& names) {
           for (const std::string& name : names) options.allowed_hosts.push_back(parse_host_name(name));
         },
         "further name under which clients may address the server; may be given several times")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  file_flag(app, "--auth-token-file",
            "file of mode 0600 with the token that clients must show; a must off loopback",
            [&](const std::string& text) { options.auth_token_file = text; });
  add_look_flags(app, options.replay.render);
  add_time_flags(app, options.replay);
  add_render_flags(app, options.replay.render);
  app.add_flag_callback(
      "--keep-going", [&] { options.replay.session.keep_going = true; }, "skip bad rows and images");
}

void check_serve_options(const ServeOptions& options) {
  check_replay_options(options.replay);
  // Without a token, what is served is for this machine alone.
  const bool loopback =
      options.host == "localhost" || options.host == "::1" || is_ipv4_loopback(options.host);
  if (!loopback && options.auth_token_file.empty())
    throw UsageError(
        "--host: '" + printable(options.host) +
        "' is not an address of loopback, where anybody could look in; give --auth-token-file, or "
        "use 127.0.0.1, ::1 or localhost");
}

}  // namespace herr
