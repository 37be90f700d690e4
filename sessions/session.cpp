#include "sessions/session.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sessions/check/session_check.h"
#include "sessions/files/input_error.h"
#include "sessions/format/session_header.h"
#include "sessions/inspect/attitude_findings.h"
#include "sessions/streams/camera_sampler.h"
#include "sessions/streams/event_stream.h"
#include "sessions/streams/gaze_sampler.h"
#include "sessions/streams/pose_sampler.h"

namespace herr {
namespace {

RowStream<PoseRow> open_poses(const SessionFiles& files, bool keep_going) {
  return {files.pose(), pose_layout(), parse_pose_row, {keep_going, {}}};
}

// A head that is upside down, as `herr inspect` says it: most likely its axes or the order of its quaternion
// are others.
std::vector<std::string> attitude_warnings(const AttitudeMeter& head,
                                           const std::filesystem::path& pose_file) {
  FindingList findings;
  judge_attitude(head, pose_file, findings);
  std::vector<std::string> warnings;
  for (const Finding& finding : findings.sorted())
    if (finding.severity == Severity::warning) warnings.push_back(finding.text());
  return warnings;
}

}  // namespace

struct Session::State {
  SessionFiles files;
  SessionOptions options;
  SessionHeader header;
  SessionFindings findings;
  TimeNs start_ns = 0, end_ns = 0;

  std::optional<PoseSampler> poses;
  std::optional<GazeSampler> gaze;
  std::vector<CameraSampler> cameras;
  std::optional<EventStream> events;
  std::optional<SceneEvent> next_event;
  std::optional<TimeNs> last_sample_ns, last_events_ns;

  void open_samplers(const CheckedSession& checked);
  void open_camera(std::size_t i);
};

void Session::State::open_camera(std::size_t i) {
  // Images were checked by the pass before; when bad ones are skipped, the same rows must be skipped again.
  RowStream<CameraRow> rows =
      options.keep_going
          ? open_camera_rows(files, i, header.cameras[i].model, {true, {}})
          : RowStream<CameraRow>(files.camera(i), camera_layout(), parse_camera_row, {false, {}});
  CameraSampler::Source source;
  source.data_folder = files.camera_data(i);
  source.camera = &header.cameras[i];
  source.keep_going = options.keep_going;
  source.on_skipped = [this](const InputError& error) {
    ++findings.skipped_images;
    add_warning(findings, std::string(error.what()) + " (the frame before is held)");
  };
  cameras.emplace_back(std::move(rows),
                       PoseSampler(open_poses(files, options.keep_going), SamplingMode::interpolate, 0),
                       std::move(source));
}

void Session::State::open_samplers(const CheckedSession& checked) {
  poses.emplace(open_poses(files, options.keep_going), options.sampling, options.predict_cap_s);
  GazeGeometry geometry{header.gaze_combined, header.vergence_m, {}};
  for (std::size_t eye = 0; eye < 2; ++eye) geometry.eye_in_head[eye] = header.head_from_eye[eye].position;
  std::optional<RowStream<GazeRow>> rows;
  if (checked.has_gaze)
    rows.emplace(files.gaze(), gaze_layout(), parse_gaze_row, RowPolicy{options.keep_going, {}});
  gaze.emplace(std::move(rows), options.sampling, geometry);
  for (std::size_t i = 0; i < header.cameras.size(); ++i) open_camera(i);
  if (!checked.has_events) return;
  events.emplace(files.events(), RowPolicy{options.keep_going, {}});
  next_event = events->next();
}

Session Session::open(const std::filesystem::path& folder, const SessionOptions& options) {
  if (!(options.predict_cap_s >= 0)) throw std::invalid_argument("predict_cap_s must be 0 or more");
  check_session_folder(folder);
  auto state = std::make_unique<State>();
  state->files.folder = folder;
  state->options = options;
  ParsedSessionHeader parsed = read_session_header(state->files.header());
  state->header = parsed.header;
  AttitudeMeter attitude;
  CheckedSession checked = check_session(state->files, state->header, options,
                                         [&attitude](const PoseRow& row) { attitude.add(row); });
  const SessionSpan span =
      replayable_span(state->files.header(), parsed, checked.first_pose_ns, checked.last_pose_ns);
  state->start_ns = span.start_ns;
  state->end_ns = span.end_ns;
  state->findings = std::move(checked.findings);
  for (const InputError& warning : parsed.warnings) add_warning(state->findings, warning.what());
  for (const std::string& warning : attitude_warnings(attitude, state->files.pose()))
    add_warning(state->findings, warning);
  state->open_samplers(checked);
  return Session(std::move(state));
}

Session::Session(std::unique_ptr<State> state) : state_(std::move(state)) {}
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;
Session::~Session() = default;

const SessionHeader& Session::header() const {
  return state_->header;
}
const SessionFindings& Session::findings() const {
  return state_->findings;
}
const std::filesystem::path& Session::folder() const {
  return state_->files.folder;
}
TimeNs Session::start_ns() const {
  return state_->start_ns;
}
TimeNs Session::end_ns() const {
  return state_->end_ns;
}

FrameSample Session::sample(TimeNs t_ns) {
  State& state = *state_;
  if (t_ns < state.start_ns) throw std::logic_error("a session is sampled before its start");
  if (state.last_sample_ns && t_ns < *state.last_sample_ns)
    throw std::logic_error("session time runs backwards");
  state.last_sample_ns = t_ns;
  FrameSample frame;
  frame.t_ns = t_ns;
  frame.start_ns = state.start_ns;
  frame.head = state.poses->at(t_ns);
  frame.head_speed = state.poses->speed();
  frame.gaze = state.gaze->at(t_ns);
  frame.head_from_eye = state.header.head_from_eye;
  if (state.cameras.empty()) return frame;
  frame.cameras[0] = state.cameras[0].at(t_ns);
  frame.cameras[1] = state.cameras.size() > 1 ? state.cameras[1].at(t_ns) : frame.cameras[0];
  return frame;
}

std::optional<SceneEvent> Session::next_event(TimeNs t_ns) {
  State& state = *state_;
  if (state.last_events_ns && t_ns < *state.last_events_ns)
    throw std::logic_error("session time runs backwards");
  state.last_events_ns = t_ns;
  if (!state.next_event || state.next_event->t_ns > t_ns) return std::nullopt;
  std::optional<SceneEvent> due = std::move(state.next_event);
  state.next_event = state.events->next();
  return due;
}

std::vector<SceneEvent> Session::events_until(TimeNs t_ns) {
  std::vector<SceneEvent> due;
  while (auto event = next_event(t_ns)) due.push_back(std::move(*event));
  return due;
}

void Session::visit_events(const std::function<void(const SceneEvent&)>& visit) const {
  if (!state_->events) return;
  EventStream events(state_->files.events(), RowPolicy{state_->options.keep_going, {}});
  while (const auto event = events.next()) visit(*event);
}

std::filesystem::path Session::events_file() const {
  return state_->files.events();
}

}  // namespace herr
