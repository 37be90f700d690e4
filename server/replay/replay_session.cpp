#include "server/replay/replay_session.h"

#include <array>
#include <memory>
#include <string>
#include <utility>

#include "server/cli/progress_bar.h"
#include "server/cli/stop_signal.h"
#include "server/cli/version.h"
#include "server/output/atomic_file.h"
#include "server/output/frame_writer.h"
#include "server/output/frames_csv.h"
#include "server/replay/frame_description.h"
#include "server/replay/opened_session.h"
#include "server/replay/output_folder.h"
#include "server/replay/picture_output.h"
#include "server/replay/steady_time.h"
#include "server/replay/summary_json.h"
#include "sessions/input_error.h"

namespace herr {
namespace {

class SessionReplay {
 public:
  SessionReplay(const std::filesystem::path& session, const ReplayOptions& options)
      : options_(options), folder_(options.out, session) {
    report_.name = session_folder_name(session);
    report_.session_folder = session;
    report_.out_folder = folder_.path();
  }

  SessionReport run();

 private:
  void start_output();
  void render_frames();
  void render_paced_frames();
  bool stopped();
  void render_one(std::int64_t frame, FramePacer* pacer, std::int64_t dropped);
  void count_new_images(const FrameSample& sample);
  void finish_pictures();
  void close_output();
  void note_failure();
  void add_run_warnings();
  bool wants_sheet(std::int64_t frame) const;

  const ReplayOptions& options_;
  const OutputFolder folder_;
  SessionReport report_;
  OpenedSession opened_;
  std::unique_ptr<FrameWriter> writer_;
  std::unique_ptr<PictureOutput> pictures_;
  std::unique_ptr<AtomicFile> csv_;
  RenderedFrame rendered_;
  SceneState state_;
  std::array<std::shared_ptr<const CameraImage>, 2> shown_images_;
};

SessionReport SessionReplay::run() {
  try {
    open_session(options_, report_, opened_);  // nothing is written yet
    // After a signal no frame is rendered: what an earlier run left stays.
    if (stop_signal() == 0) start_output();
    render_frames();
    finish_pictures();
  } catch (...) {
    note_failure();
  }
  // What was finished is described even after a failure. When that fails as well (a full disk), the first
  // failure is the one to tell: the second follows from it.
  try {
    if (csv_) close_output();
  } catch (...) {
    if (report_.state != ReplayState::failed) note_failure();
  }
  return std::move(report_);
}

void SessionReplay::note_failure() {
  report_.state = ReplayState::failed;
  report_.exit_code = exit_code_of_current_exception(report_.error);
}

void SessionReplay::start_output() {
  folder_.prepare(options_.format);
  // Two frames may wait: enough to even out the disk, little enough to hold in memory.
  const bool png = options_.format == PictureFormat::png;
  const std::size_t files_per_frame = png ? report_.profile.viewports.size() : 1;
  writer_ = std::make_unique<FrameWriter>(2 * files_per_frame);
  PictureOutput::Config config;
  config.format = options_.format;
  config.with_alpha = !report_.plan.camera;
  config.profile = report_.profile;
  config.metadata.session = printable(report_.name);
  config.metadata.scene = printable(report_.scene_name);
  config.metadata.program = program_with_version();
  config.metadata.isa = name_of(report_.settings.isa);
  config.metadata.settings = settings_text(report_.settings);
  pictures_ = std::make_unique<PictureOutput>(std::move(config), folder_, *opened_.renderer, *writer_);
  csv_ = std::make_unique<AtomicFile>(folder_.frames_csv());
  csv_->write(frames_csv_header());
}

void SessionReplay::render_frames() {
  if (options_.clock == ReplayClock::realtime) {
    render_paced_frames();
    return;
  }
  ProgressBar progress(report_.name, report_.range.count);
  for (std::int64_t i = 0; i < report_.range.count; ++i) {
    if (stopped()) return;
    render_one(report_.range.first + i, nullptr, 0);
    progress.update(i + 1);
  }
}

void SessionReplay::render_paced_frames() {
  const FrameRange& range = report_.range;
  ProgressBar progress(report_.name, range.count);
  FramePacer pacer(steady_now_ns(), range.period_ms() * 1e6, range.first, range.count);
  while (const auto begin = pacer.begin(steady_now_ns())) {
    sleep_until(begin->due_ns, [] { return stop_signal() != 0; });
    if (stopped()) return;
    render_one(begin->frame, &pacer, begin->dropped);
    progress.update(begin->frame - range.first + 1);
  }
  report_.statistics.dropped_frames += pacer.frames_dropped_at_end();
}

bool SessionReplay::stopped() {
  const int signal = stop_signal();
  if (signal == 0) return false;
  report_.state = ReplayState::interrupted;
  report_.exit_code = kExitSignalBase + signal;
  return true;
}

// `pacer`: of the clock realtime, which left `dropped` frames out before this one.
void SessionReplay::render_one(std::int64_t frame, FramePacer* pacer, std::int64_t dropped) {
  const TimeNs t_ns = report_.range.time_ns(frame);
  const TimeNs started_ns = steady_now_ns();
  const FrameSample sample = opened_.session->sample(t_ns);
  const TimeNs sampled_ns = steady_now_ns();

  scene_state_at(opened_.scene, static_cast<double>(t_ns - opened_.session->start_ns()) * kSecondsPerNs,
                 state_);
  opened_.renderer->render_frame(sample, state_, rendered_);

  count_new_images(sample);
  FrameRecord record = describe_frame(frame, sample, rendered_, report_.range.period_ms(), options_.clock,
                                      report_.findings.gaze_rows > 0);
  if (pacer != nullptr) describe_pacing(pacer->finish(started_ns, steady_now_ns()), dropped, record);
  const bool sheet = wants_sheet(frame);
  const PictureOutput::Cost cost = pictures_->write_frame(frame, sample, rendered_, sheet);
  if (sheet) report_.contact_sheets.push_back(folder_.contact_sheet(frame).filename().string());
  record.sample_ms = static_cast<double>(sampled_ns - started_ns) * 1e-6;
  record.write_ms = cost.encode_ms;
  record.wait_ms = cost.wait_ms;
  record.nonfinite_pictures = cost.nonfinite_values;
  report_.statistics.add(record);
  csv_->write(frames_csv_row(record));
}

// An image is shown for several frames, and by a single camera to both eyes: it counts once.
void SessionReplay::count_new_images(const FrameSample& sample) {
  for (std::size_t eye = 0; eye < sample.cameras.size(); ++eye) {
    if (!sample.cameras[eye]) continue;
    const std::shared_ptr<const CameraImage>& image = sample.cameras[eye]->image;
    const bool counted = image == shown_images_[eye] || (eye == 1 && image == shown_images_[0]);
    if (!counted) report_.sanitised_camera_values += image->sanitised_values;
    shown_images_[eye] = image;
  }
}

bool SessionReplay::wants_sheet(std::int64_t frame) const {
  switch (options_.sheet) {
    case SheetChoice::none:
      return false;
    case SheetChoice::all:
      return true;
    case SheetChoice::middle:
      return frame == report_.range.middle();
    case SheetChoice::one:
      return frame == options_.sheet_frame;
  }
  return false;
}

void SessionReplay::finish_pictures() {
  if (writer_) writer_->finish();
}

// frames.csv and summary.json, after the pictures that they name.
void SessionReplay::close_output() {
  // After bad input, frames that are still in the queue are good: they are written. After a failed write this
  // throws. (Usage: the write was not allowed. Any other usage error comes before there is something to
  // close.)
  const bool write_failed = report_.exit_code == kExitTemporary || report_.exit_code == kExitUsage;
  if (report_.state == ReplayState::failed && !write_failed) writer_->finish();
  report_.findings = opened_.session->findings();
  report_.files_written = writer_->files_written();
  report_.bytes_written = writer_->bytes_written();
  report_.writer_waits = writer_->waits();
  const bool skipped = report_.findings.skipped_rows > 0 || report_.findings.skipped_images > 0;
  if (report_.exit_code == kExitDone && skipped) report_.exit_code = kExitPartial;
  add_run_warnings();
  csv_->commit();
  write_whole_file(folder_.summary_json(), json_text(summary_json(report_, options_)));
  sync_folder(folder_.path());
}

void SessionReplay::add_run_warnings() {
  report_.warnings = report_.findings.warnings;
  report_.warnings.insert(report_.warnings.end(), opened_.scene.warnings.begin(),
                          opened_.scene.warnings.end());
  const RunStatistics& statistics = report_.statistics;
  const std::int64_t nonfinite = statistics.counters.nonfinite_values + statistics.nonfinite_pictures;
  if (nonfinite > 0) {
    report_.warnings.push_back(
        std::to_string(nonfinite) +
        " NaN or Inf values arose while rendering and show as black; please report it");
  }
  if (report_.sanitised_camera_values > 0) {
    report_.warnings.push_back(
        std::to_string(report_.sanitised_camera_values) +
        " values of camera images are NaN, Inf, negative or past the range of half and were replaced by 0 or "
        "65504; check the recording");
  }
  if (report_.findings.event_rows > 0) {
    report_.warnings.push_back(
        "scene events are not applied by this version: " + std::to_string(report_.findings.event_rows) +
        " lines of events.jsonl left out");
  }
  if (options_.sheet == SheetChoice::one && report_.contact_sheets.empty()) {
    report_.warnings.push_back("--contact-sheet: frame " + std::to_string(options_.sheet_frame) +
                               " was not rendered");
  }
}

}  // namespace

SessionReport replay_session(const std::filesystem::path& session, const ReplayOptions& options) {
  return SessionReplay(session, options).run();
}

}  // namespace herr
