#include "sessions/session_check.h"

#include <system_error>
#include <utility>

#include "sessions/input_error.h"
#include "sessions/streams/camera_sampler.h"
#include "sessions/streams/stream_census.h"

namespace herr {
namespace {

constexpr std::size_t kMaxWarnings = 100;
constexpr TimeNs kClockSlackNs = 1'000'000'000;  // streams of one device start and stop within a second or so

// Exists, whatever it is: a folder in the place of a stream is then refused when it is opened.
bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;  // an unreadable parent: opening the required streams says so
  return std::filesystem::exists(std::filesystem::symlink_status(path, ignored));
}

void note_cut_off(const std::filesystem::path& file, std::int64_t line, const std::string& lost,
                  const SessionOptions& options, SessionFindings& findings) {
  if (lost.empty()) return;
  const InputError error(file, line,
                         "the file ends within this line; its " + std::to_string(lost.size()) + " bytes '" +
                             printable(lost) + "' were dropped",
                         "nothing else is lost");
  if (options.strict)
    throw InputError(file, line, "the file ends within this line: '" + printable(lost) + "'",
                     "end the line or remove it");
  findings.truncated = true;
  add_warning(findings, error.what());
}

RowPolicy counting(const SessionOptions& options, std::int64_t& counter, SessionFindings& findings) {
  return {options.keep_going, [&counter, &findings](const InputError& error) {
            ++counter;
            add_warning(findings, std::string(error.what()) + " (skipped)");
          }};
}

// Reads a stream to its end and judges it as a whole.
template <typename Row>
StreamCensus check_rows(RowStream<Row>& stream, bool slow_refused, const SessionOptions& options,
                        SessionFindings& findings) {
  StreamCensus census;
  while (const auto row = stream.next()) census.count(row->stamp_ns, stream.rows().line());
  const std::filesystem::path& file = stream.rows().path();
  note_cut_off(file, stream.rows().line(), stream.rows().cut_off(), options, findings);
  if (census.rows() == 0) throw InputError(file, 0, "has no samples", "record at least one row");
  census.check_rate(file, slow_refused);
  if (const auto warning = census.gap_warning(file)) add_warning(findings, *warning);
  return census;
}

// A stream that never meets the poses was stamped by another clock.
void check_overlap(const std::filesystem::path& file, const StreamCensus& census, const StreamCensus& poses) {
  if (census.first_ns() <= poses.last_ns() + kClockSlackNs &&
      census.last_ns() >= poses.first_ns() - kClockSlackNs)
    return;
  throw InputError(file, 0,
                   "runs from " + std::to_string(census.first_ns()) + " to " +
                       std::to_string(census.last_ns()) + " ns, the poses from " +
                       std::to_string(poses.first_ns()) + " to " + std::to_string(poses.last_ns()) + " ns",
                   "stamp all streams by one clock");
}

void check_events(const SessionFiles& files, const SessionOptions& options, CheckedSession& checked) {
  EventStream events(files.events(), counting(options, checked.findings.skipped_rows, checked.findings));
  while (events.next()) ++checked.findings.event_rows;
  note_cut_off(events.path(), events.line(), events.cut_off(), options, checked.findings);
}

void warn_of_unused_cameras(const SessionFiles& files, const SessionHeader& header,
                            SessionFindings& findings) {
  for (std::size_t i = header.cameras.size(); i < 2; ++i)
    if (is_there(files.camera_folder(i)))
      add_warning(findings,
                  InputError(files.camera_folder(i), 0, "is not used: session.json has no intrinsics for it",
                             "add it to cameras")
                      .what());
}

}  // namespace

void add_warning(SessionFindings& findings, const std::string& warning) {
  if (findings.warnings.size() < kMaxWarnings) findings.warnings.push_back(warning);
  if (findings.warnings.size() == kMaxWarnings)
    findings.warnings.push_back("further warnings are only counted");
}

RowStream<CameraRow> open_camera_rows(const SessionFiles& files, std::size_t i, const CameraModel& model,
                                      RowPolicy policy) {
  const auto parse = [folder = files.camera_data(i), &model](const CsvRows& rows) {
    CameraRow row = parse_camera_row(rows);
    (void)checked_image_path(rows, row, folder, model);
    return row;
  };
  return {files.camera(i), camera_layout(), parse, std::move(policy)};
}

CheckedSession check_session(const SessionFiles& files, const SessionHeader& header,
                             const SessionOptions& options) {
  CheckedSession checked;
  SessionFindings& findings = checked.findings;
  RowStream<PoseRow> poses(files.pose(), pose_layout(), parse_pose_row,
                           counting(options, findings.skipped_rows, findings));
  const StreamCensus pose_census = check_rows(poses, true, options, findings);
  findings.pose_rows = pose_census.rows();
  checked.first_pose_ns = pose_census.first_ns();
  checked.last_pose_ns = pose_census.last_ns();

  checked.has_gaze = is_there(files.gaze());
  if (checked.has_gaze) {
    RowStream<GazeRow> gaze(files.gaze(), gaze_layout(), parse_gaze_row,
                            counting(options, findings.skipped_rows, findings));
    const StreamCensus census = check_rows(gaze, true, options, findings);
    check_overlap(files.gaze(), census, pose_census);
    findings.gaze_rows = census.rows();
  } else {
    add_warning(findings,
                InputError(files.gaze(), 0, "does not exist", "the eyes look straight ahead").what());
  }

  for (std::size_t i = 0; i < header.cameras.size(); ++i) {
    // A slow camera is legal: a feed may be a few stills.
    RowStream<CameraRow> rows = open_camera_rows(files, i, header.cameras[i].model,
                                                 counting(options, findings.skipped_images, findings));
    const StreamCensus census = check_rows(rows, false, options, findings);
    check_overlap(files.camera(i), census, pose_census);
    findings.camera_rows[i] = census.rows();
  }
  warn_of_unused_cameras(files, header, findings);

  checked.has_events = is_there(files.events());
  if (checked.has_events) check_events(files, options, checked);
  return checked;
}

}  // namespace herr
