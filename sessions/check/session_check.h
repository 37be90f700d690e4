// The pass over a whole session before its first frame: every row of every stream, every camera file's
// header. Before: the parsed header. After: Session::open keeps the findings and the span of the poses;
// inspect_session tells what it saw.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "sessions/check/session_findings.h"
#include "sessions/check/session_visitor.h"
#include "sessions/format/session_header.h"
#include "sessions/streams/event_stream.h"
#include "sessions/streams/row_stream.h"
#include "sessions/streams/session_options.h"
#include "sessions/streams/stream_census.h"
#include "sessions/streams/stream_rows.h"

namespace herr {

// Where a session's streams lie.
struct SessionFiles {
  std::filesystem::path folder;

  std::filesystem::path header() const { return folder / "session.json"; }
  std::filesystem::path pose() const { return folder / "pose" / "data.csv"; }
  std::filesystem::path gaze() const { return folder / "gaze" / "data.csv"; }
  std::filesystem::path events() const { return folder / "events.jsonl"; }
  std::filesystem::path camera_folder(std::size_t i) const { return folder / ("cam" + std::to_string(i)); }
  std::filesystem::path camera(std::size_t i) const { return camera_folder(i) / "data.csv"; }
  std::filesystem::path camera_data(std::size_t i) const { return camera_folder(i) / "data"; }
};

// Throws InputError unless there is a folder with a session.json.
void check_session_folder(const std::filesystem::path& folder);

// What the pass found usable.
struct VisitedSession {
  std::optional<StreamCensus> poses;
  std::int64_t event_rows = 0;
  bool has_gaze = false, has_events = false;
};

// Tells `visitor` of every row and every fault; throws what the visitor throws and nothing else.
// `strict`: a cut-off last line makes a stream unusable.
VisitedSession visit_session(const SessionFiles& files, const SessionHeader& header, bool strict,
                             SessionVisitor& visitor);

// The span that can be replayed: that of the poses as the header narrows it. Throws
// InputError when nothing is left.
struct SessionSpan {
  TimeNs start_ns = 0, end_ns = 0;
};
SessionSpan replayable_span(const std::filesystem::path& session_json, const ParsedSessionHeader& parsed,
                            TimeNs first_pose_ns, TimeNs last_pose_ns);

struct CheckedSession {
  SessionFindings findings;
  TimeNs first_pose_ns = 0, last_pose_ns = 0;
  bool has_gaze = false, has_events = false;
};

// The pass as replay needs it: throws the first fault, or counts what can be skipped
// where the options say so. `each_pose` (may be empty) is told of each good row of the poses.
CheckedSession check_session(const SessionFiles& files, const SessionHeader& header,
                             const SessionOptions& options,
                             const std::function<void(const PoseRow&)>& each_pose = {});

// A camera's rows with their images checked as they are read; `policy` as for RowStream.
RowStream<CameraRow> open_camera_rows(const SessionFiles& files, std::size_t i, const CameraModel& model,
                                      RowPolicy policy);

// Adds a warning, unless there are very many already: a list is for reading, and memory is bounded.
void add_warning(SessionFindings& findings, const std::string& warning);

}  // namespace herr
