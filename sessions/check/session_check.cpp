#include "sessions/check/session_check.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/streams/camera_sampler.h"

namespace herr {
namespace {

constexpr std::size_t kMaxWarnings = 100;
constexpr TimeNs kClockSlackNs = 1'000'000'000;  // streams of one device start and stop within a second or so

// Exists, whatever it is: a folder in the place of a stream is then refused when it is opened.
bool is_there(const std::filesystem::path& path) {
  const FileKind kind =
      facts_of_name(path).kind;  // unknown, in an unreadable folder: opening the streams says so
  return kind != FileKind::missing && kind != FileKind::unknown;
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

// "one of the sessions in it: a, b": a folder of sessions is easily taken for one.
std::string sessions_below(const std::filesystem::path& folder) {
  constexpr std::size_t kMostNamed = 5;
  std::vector<std::string> names;
  std::error_code unreadable;  // what cannot be listed has nothing to name
  for (const std::string& name : list_folder(folder, unreadable)) {
    if (path_exists(folder / name / "session.json")) names.push_back(name);
  }
  if (names.empty()) return "a session folder; a recording is made a session by 'herr convert'";
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    text += (i == 0 ? "" : ", ") + printable(names[i]);
  if (names.size() > kMostNamed) text += " and " + std::to_string(names.size() - kMostNamed) + " more";
  return (names.size() == 1 ? "the session in it: " : "one of the sessions in it: ") + text;
}

// One walk through the streams of a session.
class SessionPass {
 public:
  SessionPass(const SessionFiles& files, bool strict, SessionVisitor& visitor)
      : files_(files), strict_(strict), visitor_(visitor) {}

  VisitedSession run(const SessionHeader& header) {
    judged([&] {
      if (!is_there(files_.pose()))
        throw InputError(files_.pose(), 0, "does not exist, and a session needs the poses of the head",
                         "copy it there, or make the session anew with 'herr convert'");
      RowStream<PoseRow> poses(files_.pose(), pose_layout(), parse_pose_row, telling(FaultKind::row));
      const auto tell = [&](const PoseRow& row) { visitor_.pose(row, poses.rows()); };
      visited_.poses = read_rows(poses, true, tell);
    });
    visitor_.poses_done();
    visit_gaze(header);
    for (std::size_t i = 0; i < header.cameras.size(); ++i)
      judged([&] { visit_camera(i, header.cameras[i].model); });
    for (std::size_t i = header.cameras.size(); i < 2; ++i)
      if (is_there(files_.camera_folder(i)))
        visitor_.fault(FaultKind::remark,
                       InputError(files_.camera_folder(i), 0,
                                  "is not used: session.json has no intrinsics for it", "add it to cameras"));
    visited_.has_events = is_there(files_.events());
    if (visited_.has_events) judged([&] { visit_events(); });
    return visited_;
  }

 private:
  // What a stage throws is a fault of its stream; the visitor decides whether the pass goes on.
  template <typename Stage>
  void judged(const Stage& stage) {
    try {
      stage();
    } catch (const InputError& error) {
      if (told_) throw;  // the visitor's own answer to a fault
      tell(FaultKind::stream, error);
    }
  }

  void tell(FaultKind kind, const InputError& error) {
    told_ = true;
    visitor_.fault(kind, error);
    told_ = false;
  }

  RowPolicy telling(FaultKind kind) {
    return {true, [this, kind](const InputError& error) { tell(kind, error); }};
  }

  void note_cut_off(const std::filesystem::path& file, std::int64_t line, const std::string& lost) {
    if (lost.empty()) return;
    if (strict_)
      tell(FaultKind::stream,
           InputError(file, line, "the file ends within this line: '" + printable(lost) + "'",
                      "end the line or remove it"));
    else
      tell(FaultKind::cut_off,
           InputError(file, line,
                      "the file ends within this line; its " + std::to_string(lost.size()) + " bytes '" +
                          printable(lost) + "' were dropped",
                      "nothing else is lost"));
  }

  // Reads a stream to its end and judges it as a whole.
  template <typename Row, typename Tell>
  StreamCensus read_rows(RowStream<Row>& stream, bool slow_refused, const Tell& tell_row) {
    StreamCensus census;
    while (const auto row = stream.next()) {
      census.count(row->stamp_ns, stream.rows().line());
      tell_row(*row);
    }
    const std::filesystem::path& file = stream.rows().path();
    note_cut_off(file, stream.rows().line(), stream.rows().cut_off());
    if (census.rows() == 0) throw InputError(file, 0, "has no samples", "record at least one row");
    census.check_rate(file, slow_refused);
    if (const auto gap = census.gap_warning(file)) tell(FaultKind::gap, *gap);
    return census;
  }

  void visit_gaze(const SessionHeader& header) {
    visited_.has_gaze = is_there(files_.gaze());
    if (!visited_.has_gaze) {
      // A conversion of poses alone says so; then there is nothing to look for.
      const bool stated = header.conversion.still_gaze;
      tell(stated ? FaultKind::stated : FaultKind::remark,
           InputError(files_.gaze(), 0,
                      stated ? "no gaze was recorded, as session.json says" : "does not exist",
                      "the eyes look straight ahead"));
      return;
    }
    judged([&] {
      RowStream<GazeRow> gaze(files_.gaze(), gaze_layout(), parse_gaze_row, telling(FaultKind::row));
      const auto tell_row = [&](const GazeRow& row) { visitor_.gaze(row, gaze.rows()); };
      const StreamCensus census = read_rows(gaze, true, tell_row);
      if (visited_.poses) check_overlap(files_.gaze(), census, *visited_.poses);
    });
  }

  void visit_camera(std::size_t i, const CameraModel& model) {
    // A slow camera is legal: a feed may be a few stills.
    RowStream<CameraRow> rows = open_camera_rows(files_, i, model, telling(FaultKind::image));
    const auto tell_row = [&](const CameraRow& row) { visitor_.camera(i, row, rows.rows()); };
    const StreamCensus census = read_rows(rows, false, tell_row);
    if (visited_.poses) check_overlap(files_.camera(i), census, *visited_.poses);
  }

  void visit_events() {
    EventStream events(files_.events(), telling(FaultKind::row));
    while (events.next()) ++visited_.event_rows;
    note_cut_off(events.path(), events.line(), events.cut_off());
  }

  const SessionFiles& files_;
  bool strict_;
  SessionVisitor& visitor_;
  VisitedSession visited_;
  bool told_ = false;  // an exception in flight comes from the visitor
};

// Replay's answers to faults: stop, or skip and count.
class ReplayVisitor : public SessionVisitor {
 public:
  ReplayVisitor(bool keep_going, SessionFindings& findings,
                const std::function<void(const PoseRow&)>& each_pose)
      : keep_going_(keep_going), findings_(findings), each_pose_(each_pose) {}

  void fault(FaultKind kind, const InputError& error) override {
    switch (kind) {
      case FaultKind::row:
        return skip(error, findings_.skipped_rows);
      case FaultKind::image:
        return skip(error, findings_.skipped_images);
      case FaultKind::stream:
        throw error;
      case FaultKind::cut_off:
        findings_.truncated = true;
        break;
      case FaultKind::stated:
        return;
      case FaultKind::gap:
      case FaultKind::remark:
        break;
    }
    add_warning(findings_, error.what());
  }
  void pose(const PoseRow& row, const CsvRows& /*rows*/) override {
    ++findings_.pose_rows;
    if (each_pose_) each_pose_(row);
  }
  void gaze(const GazeRow& /*row*/, const CsvRows& /*rows*/) override { ++findings_.gaze_rows; }
  void camera(std::size_t index, const CameraRow& /*row*/, const CsvRows& /*rows*/) override {
    ++findings_.camera_rows[index];
  }

 private:
  void skip(const InputError& error, std::int64_t& counter) {
    if (!keep_going_) throw error;
    ++counter;
    add_warning(findings_, std::string(error.what()) + " (skipped)");
  }

  bool keep_going_;
  SessionFindings& findings_;
  const std::function<void(const PoseRow&)>& each_pose_;
};

}  // namespace

void check_session_folder(const std::filesystem::path& folder) {
  const FileFacts facts = facts_of(folder);
  if (facts.kind == FileKind::missing)
    throw InputError(folder, 0, "there is no such session folder", "check the path");
  if (facts.kind == FileKind::unknown)
    throw InputError(folder, 0, "cannot be examined: " + facts.error.message(),
                     "check the path and its permissions");
  if (facts.kind != FileKind::folder)
    throw InputError(
        folder, 0, "is not a folder",
        "name the folder that holds session.json; a recording is made a session by 'herr convert " +
            printable(folder.string()) + " OUT'");
  if (!path_exists(folder / "session.json"))
    throw InputError(folder, 0, "holds no session.json: it is not a session",
                     "name " + sessions_below(folder));
}

void add_warning(SessionFindings& findings, const std::string& warning) {
  if (findings.warnings.size() < kMaxWarnings) findings.warnings.push_back(warning);
  if (findings.warnings.size() == kMaxWarnings)
    findings.warnings.push_back("further warnings are only counted");
}

RowStream<CameraRow> open_camera_rows(const SessionFiles& files, std::size_t i, const CameraModel& model,
                                      RowPolicy policy) {
  const auto parse = [folder = files.camera_data(i), &model](const CsvRows& rows) {
    CameraRow row = parse_camera_row(rows);
    (void)checked_image(rows, row, folder, model);
    return row;
  };
  return {files.camera(i), camera_layout(), parse, std::move(policy)};
}

VisitedSession visit_session(const SessionFiles& files, const SessionHeader& header, bool strict,
                             SessionVisitor& visitor) {
  return SessionPass(files, strict, visitor).run(header);
}

SessionSpan replayable_span(const std::filesystem::path& session_json, const ParsedSessionHeader& parsed,
                            TimeNs first_pose_ns, TimeNs last_pose_ns) {
  const SessionSpan span{std::max(first_pose_ns, parsed.start_ns.value_or(first_pose_ns)),
                         std::min(last_pose_ns, parsed.end_ns.value_or(last_pose_ns))};
  if (span.start_ns > span.end_ns)
    throw InputError(session_json, 0, "field start_ns or end_ns leaves nothing to replay",
                     "the poses run from " + std::to_string(first_pose_ns) + " to " +
                         std::to_string(last_pose_ns) + " ns");
  return span;
}

CheckedSession check_session(const SessionFiles& files, const SessionHeader& header,
                             const SessionOptions& options,
                             const std::function<void(const PoseRow&)>& each_pose) {
  CheckedSession checked;
  ReplayVisitor visitor(options.keep_going, checked.findings, each_pose);
  const VisitedSession visited = visit_session(files, header, options.strict, visitor);
  checked.first_pose_ns = visited.poses->first_ns();
  checked.last_pose_ns = visited.poses->last_ns();
  checked.has_gaze = visited.has_gaze;
  checked.has_events = visited.has_events;
  checked.findings.event_rows = visited.event_rows;
  return checked;
}

}  // namespace herr
