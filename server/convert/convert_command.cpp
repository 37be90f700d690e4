#include "server/convert/convert_command.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/convert/check_report.h"
#include "server/convert/convert_feed.h"
#include "server/convert/convert_report.h"
#include "server/convert/feed_sources.h"
#include "server/convert/feed_writer.h"
#include "server/output/new_session_folder.h"
#include "server/process/exit_code.h"
#include "server/process/stop_signal.h"
#include "server/process/terminal.h"
#include "server/process/version.h"
#include "server/settings/flag_values.h"
#include "server/text/shell_word.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/import/check/bare_formats.h"
#include "sessions/import/import_rows.h"
#include "sessions/import/presets/built_in_maps.h"
#include "sessions/import/presets/choose_format.h"
#include "sessions/import/presets/gaze_beside.h"
#include "sessions/import/presets/recording_folder.h"
#include "sessions/inspect/plausibility.h"
#include "sessions/inspect/stream_summary.h"
#include "sessions/record/session_recorder.h"

namespace herr {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSortRows = 64;

// Rates that session.json can state.
constexpr double kLowestRateHz = 0.1, kHighestRateHz = 10000;

const BuiltInMap& built_in(const std::string& name) {
  return built_in_maps().at(parse_word("--preset", name, built_in_map_names()));
}

struct Recording {
  FormatRequest format;
  std::vector<FoundCamera> cameras;
};

// The files that the user names, or those that a recorder's folder holds.
Recording recording_of(const ConvertOptions& options) {
  Recording recording;
  FormatRequest& request = recording.format;
  if (!options.map.empty()) request.map = std::make_shared<const ColumnMap>(read_column_map(options.map));
  if (!options.preset.empty()) request.preset = std::string(built_in(options.preset).name);
  request.variant = options.variant;
  request.still = options.still;
  request.files = {options.head, options.gaze};
  if (facts_of_name(options.head).kind == FileKind::folder) {
    FoundRecording found = find_recording(options.head, request.preset, request.map.get());
    recording.cameras = std::move(found.cameras);
    if (!request.map) request.preset = found.preset;
    if (options.gaze) found.files.gaze = options.gaze;
    request.files = std::move(found.files);
  }
  // A log without a head is the gaze's.
  if (request.still.head && !request.files.gaze) request.files.gaze = request.files.head;
  if (request.still.head) request.files.head.clear();
  if (request.files.head.empty() && !request.still.head && !options.check)
    throw InputError(options.head, 0, "holds no recording of the head",
                     "give --still-head, or name the head's file");
  return recording;
}

SessionHeader header_for(const ConvertOptions& options, const NewSessionFolder& folder,
                         const ChosenFormat& format, DisplayProfile profile) {
  SessionHeader header = new_session_header(folder);
  header.provenance = std::string("converted by ") + program_with_version() + " from " +
                      printable(options.head.filename().string()) + " with " +
                      printable(format.format.words());
  header.licence = options.licence;
  header.profile = std::move(profile);
  header.scene = options.scene;
  header.feed_distance_m = options.feed.distance_m;
  return header;
}

// Thrown where rows and pictures pass by once a signal has asked for the end.
struct Stopped {};

void stop_on_signal() {
  if (stop_signal() != 0) throw Stopped{};
}

double stated_rate(double rate_hz) {
  return rate_hz >= kLowestRateHz && rate_hz <= kHighestRateHz ? rate_hz : 0;
}

// The user's file behind a file of the new session, which they have not seen.
fs::path users_file(const fs::path& session_file, const ConvertReport& report,
                    const ConvertOptions& options) {
  const std::string folder = session_file.parent_path().filename().string();
  if (folder == "gaze" && report.rows.has_gaze) return report.rows.gaze.file;
  for (std::size_t i = 0; i < report.feeds.size(); ++i)
    if (folder == "cam" + std::to_string(i)) return report.feeds[i].folder;
  return report.rows.poses.file.empty() ? options.head : report.rows.poses.file;
}

// What replay would say of it; the result is a session or there is none.
void check_result(const ConvertOptions& options, const NewSessionFolder& folder,
                  const ConvertReport& report) {
  try {
    (void)folder.findings();
  } catch (const InputError& error) {
    throw InputError(users_file(error.file(), report, options), 0,
                     "gives no usable session: " + folder.with_final_name(error.problem()),
                     "check the units, the clock and the columns of the format (" + report.format + ")");
  }
}

void check_options(const ConvertOptions& options) {
  check_feed_options(options.feed);
  check_scene_name("--scene", options.scene);
  if (options.head == options.out) throw UsageError("OUT: is the recording itself; choose another folder");
  if (options.still.gaze && options.gaze)
    throw UsageError("--still-gaze: --gaze is given too, and would not be read; give one of the two");
  if (options.still.head && options.still.gaze)
    throw UsageError("--still-gaze: with --still-head nothing is left of the recording; give one of the two");
}

// Rows on their way: into the session, and past the meter.
ImportReport import_into(SessionRecorder& recorder, PlausibilityMeter& meter, const ImportRequest& request) {
  const bool per_eye = request.columns.gaze != nullptr && request.columns.gaze->rays.size() > 1;
  ImportReport report = import_rows(request, {[&](const PoseRow& row) {
                                                stop_on_signal();
                                                recorder.add_pose(row);
                                                meter.add(row);
                                              },
                                              [&](const GazeRow& row) {
                                                stop_on_signal();
                                                recorder.add_gaze(row);
                                                meter.add(row, per_eye);
                                              }});
  return report;
}

StreamSummary summary_of(const ImportedStream& stream) {
  StreamSummary summary;
  summary.file = stream.file;
  summary.rows = stream.rows;
  summary.first_ns = stream.first_ns;
  summary.last_ns = stream.last_ns;
  summary.intervals = stream.intervals;
  return summary;
}

// The line that was typed, with the gaze, over the session that it made.
std::string command_with_gaze(const ConvertOptions& options, const fs::path& gaze) {
  std::string line = "herr convert";
  for (const std::string& word : options.arguments) line += " " + shell_word(word);
  return line + " --gaze " + shell_path(gaze) + (options.overwrite ? "" : " --overwrite");
}

// `gaze`: a file of it that lies beside the head's and was not named.
void judge(const PlausibilityMeter& meter, const ConvertOptions& options, const std::optional<fs::path>& gaze,
           ConvertReport& report) {
  report.head_words = meter.words();
  report.gaze_words = meter.gaze_words();
  FindingList findings;
  const fs::path& poses = report.rows.poses.file.empty() ? options.head : report.rows.poses.file;
  meter.judge(poses, report.rows.gaze.file.empty() ? poses : report.rows.gaze.file, findings);
  if (const std::string fault = rarity(report.rows.poses.intervals); !fault.empty())
    findings.add(Severity::warning,
                 InputError(poses, 0, fault, "correct the units of the map, or take another preset"));
  if (report.rows.has_gaze)
    judge_offset(summary_of(report.rows.poses), summary_of(report.rows.gaze), findings);
  for (const Finding& finding : findings.sorted()) report.warnings.push_back(finding.text());
  if (report.rows.has_gaze) return;
  if (gaze)
    report.warnings.push_back(printable(poses.filename().string()) + " holds no gaze, but " +
                              printable(gaze->string()) +
                              " lies beside it (without it the eyes look straight ahead); to take it: " +
                              command_with_gaze(options, *gaze));
  else
    report.warnings.push_back("no gaze was recorded: the eyes look straight ahead");
}

void finish_header(const ConvertReport& report, const ChosenFormat& format, SessionHeader& header) {
  header.gaze_combined = report.rows.gaze_combined || !report.rows.has_gaze;
  if (report.rows.gaze_combined) header.vergence_m = format.format.map->vergence_m;
  header.pose_hz = stated_rate(report.rows.poses.rate_hz());
  header.gaze_hz = stated_rate(report.rows.gaze.rate_hz());
  header.conversion = conversion_record(report);
}

// Formats whose files name no columns fit many tables by accident; the user's word settles it.
void check_bare_format(const FormatRequest& request, const ChosenFormat& format) {
  if (request.map || !request.preset.empty() || format.format.named_columns > 0 ||
      is_its_own_file(format, request))
    return;
  throw InputError(request.files.head.empty() ? *request.files.gaze : request.files.head, 0,
                   "has the columns of no preset; by their number it could be " + format.format.words(),
                   "give --preset where that is meant; 'herr convert --check FILE' proposes a map");
}

int convert(const ConvertOptions& options) {
  const Recording recording = recording_of(options);
  const std::vector<FeedSource> sources = feed_sources(options.feed, recording.cameras);
  DisplayProfile profile = load_display_profile(options.profile);
  const ChosenFormat format = choose_format(recording.format);
  check_bare_format(recording.format, format);
  ConvertReport report;
  report.out = options.out;
  report.format = format.format.words();
  report.remarks = format.remarks;
  const std::vector<Feed> feeds =
      open_feeds(options.feed, sources, format, recording.format.files, report.remarks);
  ImportRequest request = import_request(recording.format, format.format.columns);
  request.keep_going = options.keep_going;
  request.sort_rows = options.sort ? kSortRows : 0;

  NewSessionFolder folder(options.out, options.overwrite);
  if (!options.scene.empty()) (void)scene_beside(folder, "--scene", options.scene);
  SessionHeader header = header_for(options, folder, format, std::move(profile));
  SessionRecorder recorder(folder.path());
  PlausibilityMeter meter;
  const HeadColumns* head = request.columns.head;
  report.still = {head == nullptr || head->rotation_kind == RotationKind::fixed, options.still.gaze};
  if (report.still.head) meter.expect_still_head();
  if (report.still.gaze) meter.expect_still_gaze();
  report.rows = import_into(recorder, meter, request);
  const std::optional<fs::path> beside = report.rows.has_gaze ? std::nullopt : gaze_beside(recording.format);
  judge(meter, options, beside, report);
  // A recording of the head alone: the session says so, and nobody looks for its gaze.
  if (!report.rows.has_gaze && !beside) report.still.gaze = true;
  for (std::size_t i = 0; i < feeds.size(); ++i) {
    header.cameras.push_back(feeds[i].camera);
    report.feeds.push_back(write_feed(options.feed, i, feeds[i], report.rows, recorder, stop_on_signal));
  }
  finish_header(report, format, header);
  recorder.write_header(header);
  recorder.finish();
  check_result(options, folder, report);
  stop_on_signal();
  folder.keep();
  print_result(options.json ? convert_json(report) : convert_text(report));
  const std::vector<std::string> losses = heavy_losses(report);
  for (const std::string& loss : losses) print_message(loss);
  return losses.empty() ? kExitDone : kExitPartial;
}

}  // namespace

int run_convert(const ConvertOptions& options) {
  if (options.show_map) {
    print_result(std::string(built_in(options.preset).json));
    return kExitDone;
  }
  if (options.check) return run_format_check(options, recording_of(options).format);
  check_options(options);
  try {
    return convert(options);
  } catch (const Stopped&) {
    print_message("stopped: nothing was written");
    return kExitSignalBase + stop_signal();
  }
}

}  // namespace herr
