#include "server/cli/convert_flags.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "server/cli/flags.h"
#include "server/cli/setting_flags.h"
#include "server/process/exit_code.h"
#include "server/settings/flag_values.h"
#include "server/settings/run_settings.h"
#include "server/text/number_text.h"
#include "sessions/files/input_error.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/text/date_text.h"

namespace herr {
namespace {

constexpr double kLongestOffsetMs = 4e12;  // what a session can hold

// Minutes east of Greenwich.
int zone_from(const std::string& flag, const std::string& text) {
  const std::optional<int> minutes = parse_zone(text);
  if (!minutes) throw UsageError(flag + ": '" + text + "' is no time zone; write +01:00, -05:30 or Z");
  return *minutes;
}

// Given once for each camera.
template <typename Values>
void repeated_flag(CLI::App& app, const std::string& flag, const char* kind, const std::string& help,
                   Values& values) {
  app.add_option_function<std::vector<std::string>>(
         flag,
         [flag, &values](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) values.emplace_back(non_empty(flag, text));
         },
         help)
      ->type_name(kind)
      ->expected(1)
      ->take_all();
}

void add_format_flags(CLI::App& app, ConvertOptions& options) {
  const auto word = [&app](const std::string& flag, const char* kind, const std::string& help,
                           std::string& target) {
    value_flag(app, flag, kind, help,
               [flag, &target](const std::string& text) { target = non_empty(flag, text); });
  };
  file_flag(app, "--gaze", "file of the gaze, where it is not in HEAD",
            [&](const std::string& text) { options.gaze = text; });
  word("--preset", "NAME", "format of the files (default: recognised): " + joined(built_in_map_names()),
       options.preset);
  word("--variant", "NAME", "which of the format's siblings, where the data cannot tell", options.variant);
  file_flag(app, "--map", "column map (JSON) of a format that no preset knows",
            [&](const std::string& text) { options.map = text; });
  app.add_flag_callback(
      "--show-map", [&] { options.show_map = true; },
      "print the preset's column map, to be changed and used with --map");
  app.add_flag_callback(
      "--check", [&] { options.check = true; },
      "convert nothing: say what the recording seems to be and which command converts it; ends with 4 where "
      "it cannot tell");
  file_flag(app, "--write-map", "with --check: where a proposed column map goes",
            [&](const std::string& text) { options.write_map = text; });
  app.add_flag_callback(
      "--still-head", [&] { options.still.head = true; },
      "HEAD holds gaze alone; the head stays at the origin");
  app.add_flag_callback(
      "--still-gaze", [&] { options.still.gaze = true; },
      "the eyes look straight ahead, whatever HEAD holds");
  app.add_flag_callback(
      "--sort", [&] { options.sort = true; }, "put rows that come at most 64 rows late where they belong");
}

void add_feed_flags(CLI::App& app, FeedOptions& feed) {
  repeated_flag(app, "--camera", "DIR", "folder of pictures for the camera feed; twice: left and right eye",
                feed.pictures);
  repeated_flag(app, "--camera-stamps", "FILE",
                "table that says when each was taken (default: data.csv or frames.csv beside them)",
                feed.stamps);
  repeated_flag(
      app, "--camera-names", "PATTERN",
      "or the stamps stand in the names: frame_{ms}, with {s} {ms} {us} {ns} {date}, and {*} for any text",
      feed.names);
  value_flag(app, "--camera-zone", "ZONE",
             "time zone of dates in tables, names and EXIF that state none: +01:00",
             [&](const std::string& text) { feed.zone_minutes = zone_from("--camera-zone", text); });
  value_flag(app, "--camera-hz", "X",
             "no stamps were recorded: so many pictures a second from the first pose on",
             [&](const std::string& text) { feed.hz = parse_real_number("--camera-hz", text, 0.1, 1000); });
  app.add_flag_callback(
      "--camera-loop", [&] { feed.loop = true; },
      "with --camera-hz: begin again at the end, as long as the poses last");
  value_flag(app, "--camera-offset-ms", "X", "added to the stamp of each picture; may be negative",
             [&](const std::string& text) {
               feed.offset_ms = parse_signed_number("--camera-offset-ms", text, kLongestOffsetMs);
             });
  value_flag(
      app, "--camera-hfov", "X", "width of the view in degrees, of a lens without distortion",
      [&](const std::string& text) { feed.hfov_deg = parse_real_number("--camera-hfov", text, 1, 170); });
  repeated_flag(
      app, "--camera-calibration", "FILE",
      "lens and its place instead: EuRoC's sensor.yaml, Kalibr's camchain-imucam.yaml, Project Aria's JSON",
      feed.calibration);
  repeated_flag(app, "--camera-label", "NAME", "which camera of that calibration", feed.label);
  app.add_flag_callback(
      "--no-camera", [&] { feed.none = true; }, "leave the pictures of a recorder's folder out");
  value_flag(app, "--feed-distance", "M",
             "metres from the displayed eye at which the feed is seen (default 2)",
             [&](const std::string& text) {
               feed.distance_m = parse_real_number("--feed-distance", text, 0.01, 10000);
             });
}

}  // namespace

void add_convert_flags(CLI::App& app, ConvertOptions& options) {
  app.add_option("HEAD", options.head, "the recording: its trajectory of the head, or a recorder's folder")
      ->type_name("");
  app.add_option("OUT", options.out, "folder of the new session")->type_name("");
  add_format_flags(app, options);
  add_feed_flags(app, options.feed);
  add_setting_flag(app, profile_setting(options.profile));
  value_flag(app, "--scene", "PATH", "scene file that session.json names, relative to OUT; it must be there",
             [&](const std::string& text) { options.scene = text; });
  value_flag(app, "--licence", "TEXT", "licence of the recording",
             [&](const std::string& text) { options.licence = text; });
  app.add_flag_callback(
      "--overwrite", [&] { options.overwrite = true; }, "replace the session that is there");
  app.add_flag_callback(
      "--keep-going", [&] { options.keep_going = true; },
      "leave bad rows out instead of stopping at the first; above 5 % lost it ends with 5, as always");
  app.add_flag_callback(
      "--json", [&] { options.json = true; }, "results on stdout as JSON");
}

void check_convert_flags(const ConvertOptions& options) {
  if (!options.preset.empty() && !options.map.empty())
    throw UsageError("--preset: --map is given too; give the name of a format (" +
                     joined(built_in_map_names()) + ") or a column map");
  if (options.show_map && options.preset.empty())
    throw UsageError("--show-map: give --preset with one of " + joined(built_in_map_names()));
  if (options.show_map) return;
  if (options.head.empty()) throw UsageError("HEAD: missing; give the recording");
  if (!options.write_map.empty() && !options.check) throw UsageError("--write-map: give --check too");
  if (options.check && !options.out.empty()) throw UsageError("OUT: --check converts nothing; leave it out");
  if (options.check && (!options.preset.empty() || !options.map.empty() || !options.variant.empty()))
    throw UsageError("--check: proposes a format; leave --preset, --variant and --map out");
  if (options.check && (options.still.head || options.still.gaze))
    throw UsageError("--check: finds out what was not recorded; leave --still-head and --still-gaze out");
  if (options.check && !options.feed.pictures.empty())
    throw UsageError("--check: looks at head and gaze alone; leave --camera out");
  if (!options.check && options.out.empty())
    throw UsageError("OUT: missing; give the folder of the new session");
}

}  // namespace herr
