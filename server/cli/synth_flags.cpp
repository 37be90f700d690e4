#include "server/cli/synth_flags.h"

#include <CLI/CLI.hpp>
#include <string>

#include "server/cli/flags.h"
#include "server/cli/setting_flags.h"
#include "server/process/exit_code.h"
#include "server/settings/flag_values.h"
#include "server/settings/run_settings.h"
#include "server/synth/irregular_events.h"
#include "server/text/number_text.h"
#include "sessions/format/session_header.h"
#include "sessions/text/plain_values.h"

namespace herr {
namespace {

constexpr double kLongestSeconds = 86400;
constexpr double kFarthestM = 1e6;
constexpr std::int64_t kLargestSeed = 1'000'000'000;

// Adds a flag for a number; the help states its default.
class NumberFlags {
 public:
  explicit NumberFlags(CLI::App& app) : app_(&app) {}
  // Other names follow the first one, after a comma.
  void operator()(const std::string& names, const std::string& help, double lowest, double highest,
                  double& value) const {
    const std::string flag = names.substr(0, names.find(','));
    value_flag(*app_, names, "X", help + " (default " + shortest_text(value) + ")",
               [flag, help, lowest, highest, &value](const std::string& text) {
                 try {
                   value = parse_real_number(flag, text, lowest, highest);
                 } catch (const UsageError& error) {
                   const std::string what = error.what();
                   throw what.ends_with(kWithoutUnit) ? UsageError(what + ": " + help) : error;
                 }
               });
  }

 private:
  CLI::App* app_;
};

void point_flag(CLI::App& app, const std::string& flag, const std::string& help, glm::dvec3& point) {
  value_flag(app, flag, "X,Y,Z", help,
             [flag, &point](const std::string& text) { point = parse_point(flag, text, kFarthestM); });
}

void add_place_flags(CLI::App& app, SynthOptions& options) {
  file_flag(app, "--scene", "the room that the camera sees; without it there is no camera",
            [&](const std::string& text) { options.room = text; });
  add_asset_root_flag(app, options.asset_roots);
  file_flag(app, "--replay-scene", "scene that session.json names, relative to OUT (default: none)",
            [&](const std::string& text) { options.scene = text; });
  add_setting_flag(app, profile_setting(options.profile));
  point_flag(app, "--at", "metres: where the head stays, or the middle of a walk (default 0,1.5,3.7)",
             options.place);
  const NumberFlags number(app);
  number("--radius", "metres that a walk leaves that place along x and z, inside the room", 0.25, 1000,
         options.radius_m);
  point_flag(app, "--origin", "metres added to every recorded position (default 0,0,0)", options.origin);
}

void add_time_flags(CLI::App& app, SynthOptions& options) {
  const NumberFlags number(app);
  number("--duration", "seconds", 0.1, kLongestSeconds, options.duration_s);
  value_flag(app, "--start-ns", "N", "first stamp in nanoseconds (default 1000000000)",
             [&](const std::string& text) {
               options.start_ns = parse_whole_number("--start-ns", text, 0, kLastStampNs);
             });
  number("--pose-hz,--hz", "poses per second", 1, 1000, options.pose_hz);
  number("--gaze-hz", "gaze rows per second", 1, 1000, options.gaze_hz);
  number("--stamp-jitter-ms", "milliseconds that a sample comes late at most", 0, 1000,
         options.stamp_jitter_ms);
  number("--hitches-per-minute", "gaps of 40-350 ms in every stream", 0, kMostPerMinute,
         options.hitches_per_minute);
}

void add_camera_flags(CLI::App& app, SynthOptions& options) {
  value_flag(app, "--camera,--camera-size", "WxH|none",
             "size of the camera's pictures in pixels (default 480x360)", [&](const std::string& text) {
               options.camera = text != "none";
               options.camera_size.reset();
               if (!options.camera) return;
               const SizeValue size = parse_size("--camera", text, 16384);
               options.camera_size = glm::ivec2{size.width, size.height};
             });
  const NumberFlags number(app);
  number("--camera-hz", "pictures per second", 0.1, 240, options.camera_hz);
  number("--camera-hfov", "degrees that a picture is wide", 10, 150, options.camera_hfov_deg);
  value_flag(app, "--threads", "N", "render threads, 1 ... 512 (default: all this process may use)",
             [&](const std::string& text) {
               options.threads = static_cast<int>(parse_whole_number("--threads", text, 1, 512));
             });
}

}  // namespace

void add_synth_flags(CLI::App& app, SynthOptions& options) {
  app.add_option("OUT", options.out, "folder of the new session")->required()->type_name("");
  value_flag(app, "--seed", "N", "same seed and flags, same session (default 1)",
             [&](const std::string& text) {
               options.seed = static_cast<std::uint64_t>(parse_whole_number("--seed", text, 0, kLargestSeed));
             });
  value_flag(app, "--motion", "KIND", "of the head: " + joined(motion_names()) + " (default desk)",
             [&](const std::string& text) {
               options.motion = static_cast<MotionKind>(parse_word("--motion", text, motion_names()));
             });
  value_flag(app, "--gaze", "KIND", "of the eyes: " + joined(gaze_names()) + " (default fixations)",
             [&](const std::string& text) {
               options.gaze = static_cast<GazeKind>(parse_word("--gaze", text, gaze_names()));
             });
  const NumberFlags number(app);
  number("--gaze-noise-deg", "degrees of noise in each gaze row (standard deviation on each axis)", 0, 5,
         options.gaze_noise_deg);
  number("--blinks-per-minute", "blinks of 150-300 ms", 0, kMostPerMinute, options.blinks_per_minute);
  add_time_flags(app, options);
  add_place_flags(app, options);
  add_camera_flags(app, options);
  app.add_flag_callback(
      "--overwrite", [&] { options.overwrite = true; }, "replace the session that is there");
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "report on stdout as JSON");
}

}  // namespace herr
