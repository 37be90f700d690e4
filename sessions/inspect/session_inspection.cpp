#include "sessions/inspect/session_inspection.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sessions/camera/camera_image.h"
#include "sessions/format/session_header.h"
#include "sessions/streams/camera_sampler.h"
#include "sessions/streams/gaze_sampler.h"

namespace herr {
namespace {

double norm_of(const CsvRows& rows) {
  return std::hypot(std::hypot(rows.number(4), rows.number(5)), std::hypot(rows.number(6), rows.number(7)));
}

// Measures what the pass reads and writes down what it finds wrong.
class InspectingVisitor : public SessionVisitor {
 public:
  InspectingVisitor(const InspectionRequest& request, const ParsedSessionHeader& parsed, double display_hz,
                    SessionInspection& inspection)
      : request_(request),
        parsed_(parsed),
        display_hz_(display_hz),
        files_{request.folder},
        inspection_(inspection) {}

  void fault(FaultKind kind, const InputError& error) override {
    switch (kind) {
      case FaultKind::row:
      case FaultKind::image:
        return inspection_.findings.add(Severity::error, error, true);
      case FaultKind::stream:
        return inspection_.findings.add(Severity::error, error);
      case FaultKind::cut_off:
        inspection_.truncated = true;
        break;
      case FaultKind::gap:
        return;  // judge_stream tells of all gaps
      case FaultKind::stated:
        return inspection_.findings.add(Severity::note, error);
      case FaultKind::remark:
        if (!inspection_.header) return;  // nobody knows what should be there
        break;
    }
    inspection_.findings.add(Severity::warning, error);
  }

  void pose(const PoseRow& row, const CsvRows& rows) override {
    StreamSummary& poses = inspection_.poses;
    const TimeNs header_start_ns = parsed_.start_ns.value_or(row.stamp_ns);
    if (!poses.ages) poses.ages.emplace(std::max(row.stamp_ns, header_start_ns), display_hz_);
    const Pose& pose = row.world_from_head;
    const bool repeats =
        last_pose_ && last_pose_->position == pose.position && last_pose_->orientation == pose.orientation;
    last_pose_ = pose;
    poses.count(row.stamp_ns, rows.line(), repeats);
    poses.ages->sample(row.stamp_ns, parsed_.end_ns);
    inspection_.head.add(row, norm_of(rows), rows.line());
    inspection_.plausibility.add(row);
  }

  void gaze(const GazeRow& row, const CsvRows& rows) override {
    StreamSummary& gaze = *inspection_.gaze;
    const bool seen = row.valid[0] || row.valid[1];
    const bool repeats = seen && last_gaze_ && last_gaze_->valid == row.valid &&
                         last_gaze_->head_direction == row.head_direction;
    last_gaze_ = row;
    gaze.count(row.stamp_ns, rows.line(), repeats);
    if (inspection_.span && !gaze.ages)
      gaze.ages.emplace(inspection_.span->start_ns, display_hz_, kGazeCentredNs);
    if (gaze.ages && seen) gaze.ages->sample(row.stamp_ns, inspection_.span->end_ns);
    inspection_.eyes.add(row, rows);
    inspection_.plausibility.add(row, !parsed_.header.gaze_combined);
  }

  void camera(std::size_t index, const CameraRow& row, const CsvRows& rows) override {
    StreamSummary& camera = *inspection_.cameras[index];
    camera.count(row.stamp_ns, rows.line(), last_picture_[index] == row.filename);
    last_picture_[index] = row.filename;
    if (inspection_.span && !camera.ages) camera.ages.emplace(inspection_.span->start_ns, display_hz_);
    if (camera.ages) camera.ages->sample(row.stamp_ns, inspection_.span->end_ns);
    if (request_.decode) decode(index, row, rows);
  }

  // From here on the span is known, as far as it can be.
  void poses_done() override {
    if (inspection_.poses.rows == 0) return;
    const StreamSummary& poses = inspection_.poses;
    try {
      inspection_.span = replayable_span(files_.header(), parsed_, poses.first_ns, poses.last_ns);
    } catch (const InputError& error) {
      late_errors_.push_back(error);
    }
  }

  // What replay would refuse only after it has read all streams.
  void add_late_errors() {
    for (const InputError& error : late_errors_) inspection_.findings.add(Severity::error, error);
  }

 private:
  void decode(std::size_t index, const CameraRow& row, const CsvRows& rows) {
    try {
      const CameraModel& model = parsed_.header.cameras[index].model;
      InputFile file = checked_image(rows, row, files_.camera_data(index), model);
      inspection_.sanitised_values += read_camera_image(file).sanitised_values;
      ++inspection_.decoded_pictures;
    } catch (const InputError& error) {
      fault(FaultKind::image,
            InputError(rows.path(), rows.line(), "image '" + printable(row.filename) + "' " + error.problem(),
                       error.remedy()));
    }
  }

  const InspectionRequest& request_;
  const ParsedSessionHeader& parsed_;
  double display_hz_;
  SessionFiles files_;
  SessionInspection& inspection_;
  std::optional<Pose> last_pose_;
  std::optional<GazeRow> last_gaze_;
  std::array<std::string, 2> last_picture_;
  std::vector<InputError> late_errors_;
};

void name_streams(const SessionFiles& files, const SessionHeader& header, SessionInspection& inspection) {
  inspection.poses.name = "pose";
  inspection.poses.file = files.pose();
  inspection.poses.nominal_hz = header.pose_hz;
  inspection.gaze.emplace();
  inspection.gaze->name = "gaze";
  inspection.gaze->file = files.gaze();
  inspection.gaze->nominal_hz = header.gaze_hz;
  for (std::size_t i = 0; i < header.cameras.size(); ++i) {
    inspection.cameras[i].emplace();
    inspection.cameras[i]->name = "cam" + std::to_string(i);
    inspection.cameras[i]->file = files.camera(i);
    inspection.cameras[i]->nominal_hz = header.cameras[i].nominal_hz;
  }
}

// A head or a gaze that stands still is no fault where the recording says so: `herr convert` in a field of
// its own, `herr synth` in its provenance.
void expect_what_was_meant(const SessionHeader& header, PlausibilityMeter& plausibility) {
  const bool made = header.provenance.starts_with("made by herr");
  const auto says = [&](const char* words) {
    return made && header.provenance.find(words) != std::string::npos;
  };
  if (header.conversion.still_head || says("head still")) plausibility.expect_still_head();
  if (header.conversion.still_gaze || says("gaze still")) plausibility.expect_still_gaze();
}

template <typename Action>
void for_each_other_stream(SessionInspection& inspection, const Action& action) {
  if (inspection.gaze && inspection.gaze->rows > 0) action(*inspection.gaze);
  for (std::optional<StreamSummary>& camera : inspection.cameras)
    if (camera && camera->rows > 0) action(*camera);
}

void judge_all(const SessionFiles& files, SessionInspection& inspection) {
  FindingList& findings = inspection.findings;
  const StreamSummary& poses = inspection.poses;
  for (StreamSummary* stream : {&inspection.poses, inspection.gaze ? &*inspection.gaze : nullptr})
    if (stream && stream->rows >= PlausibilityMeter::kFewestRows) stream->stillness_told = true;
  judge_stream(poses, poses, findings);
  inspection.head.judge(poses.file, findings);
  inspection.eyes.judge(files.gaze(), findings);
  inspection.plausibility.judge(poses.file, files.gaze(), findings);
  for_each_other_stream(inspection, [&](const StreamSummary& stream) {
    judge_stream(poses, stream, findings);
    if (poses.rows > 0) judge_offset(poses, stream, findings);
  });
  if (inspection.header && inspection.header->cameras.empty())
    findings.add(Severity::note, InputError(files.header(), 0, "names no camera",
                                            "pictures are rendered without a camera feed"));
}

}  // namespace

SessionInspection inspect_session(const InspectionRequest& request) {
  SessionInspection inspection;
  inspection.folder = request.folder;
  const SessionFiles files{request.folder};
  ParsedSessionHeader parsed;
  try {
    check_session_folder(request.folder);
  } catch (const InputError& error) {
    inspection.findings.add(Severity::error, error);
    return inspection;
  }
  try {
    parsed = read_session_header(files.header());
    inspection.header = parsed.header;
  } catch (const InputError& error) {  // poses and gaze can be read without it
    inspection.findings.add(Severity::error, error);
  }
  for (const InputError& warning : parsed.warnings) inspection.findings.add(Severity::warning, warning);
  name_streams(files, parsed.header, inspection);

  const double display_hz = request.display_hz.value_or(parsed.header.profile.display_hz);
  InspectingVisitor visitor(request, parsed, display_hz, inspection);
  const VisitedSession visited = visit_session(files, parsed.header, request.strict, visitor);
  visitor.add_late_errors();
  inspection.event_rows = visited.event_rows;
  inspection.eyes.finish();
  expect_what_was_meant(parsed.header, inspection.plausibility);
  if (!visited.has_gaze) inspection.gaze.reset();
  if (inspection.span) {
    inspection.poses.ages->finish(inspection.span->end_ns);
    for_each_other_stream(inspection, [&](StreamSummary& stream) {
      if (stream.ages) stream.ages->finish(inspection.span->end_ns);
    });
  }
  judge_all(files, inspection);
  return inspection;
}

}  // namespace herr
