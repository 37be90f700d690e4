#include "server/replay/replay_session.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "server/frames/frame_quality.h"
#include "server/frames/frame_step.h"
#include "server/frames/opened_session.h"
#include "server/frames/warnings/picture_warnings_drawn.h"
#include "server/output/frame_writer.h"
#include "server/process/progress_bar.h"
#include "server/process/steady_time.h"
#include "server/process/stop_signal.h"
#include "server/replay/floor_frames.h"
#include "server/replay/picture_output.h"
#include "server/replay/session_check.h"
#include "server/results/checkpoint.h"
#include "server/results/earlier_frames.h"
#include "server/results/fingerprint.h"
#include "server/results/frame_files.h"
#include "server/results/frames_csv.h"
#include "server/results/memory_parts.h"
#include "server/results/output_folder.h"
#include "server/results/run_state.h"
#include "server/results/summary_json.h"
#include "server/settings/quality_target.h"
#include "sessions/files/atomic_file.h"
#include "sessions/files/folders.h"
#include "sessions/files/input_error.h"
#include "sessions/files/strict_json.h"

namespace herr {
namespace {

// Of an earlier run, in the folder that it wrote to; a damaged one says nothing.
bool summary_says_done(const std::filesystem::path& summary_json) {
  try {
    return JsonDocument(summary_json).root().text("state") == name_of(ReplayState::done);
  } catch (const InputError&) {
    return false;
  }
}

constexpr std::size_t kPlanChangesKept = 100;  // a list is for reading
// Where a run could be taken up again: every so many frames, and often enough where a frame takes minutes.
constexpr std::int64_t kCheckpointFrames = 500;
constexpr TimeNs kCheckpointIntervalNs = 30'000'000'000;

class SessionReplay {
 public:
  SessionReplay(const std::filesystem::path& session, const ReplayOptions& options)
      : options_(options), folder_(options.out, session) {
    report_.name = session_folder_name(session);
    report_.session_folder = session;
    report_.out_folder = folder_.path();
    report_.load = process_load();
  }

  SessionReport run();

 private:
  void start_output();
  void go_on_from(const EarlierFrames& earlier);
  void open_writer(const EarlierFrames& earlier);
  void take_over(EarlierFrames earlier);
  EarlierFrames earlier_frames() const;
  void skip_frames_before(std::int64_t frame);
  void render_frames();
  void render_paced_frames();
  bool stopped();
  bool render_one(std::int64_t frame, const FramePacing& pacing);
  void checkpoint_if_due();
  void save_checkpoint();
  void restore(const RunState& state, std::optional<TimeNs> last_frame_ns);
  void close_output();
  void describe_run();
  PictureMemory picture_memory() const;
  void note_failure();
  void add_run_warnings();
  void note_plan(std::int64_t frame);
  bool can_resume() const { return is_reproducible(options_); }

  const ReplayOptions& options_;
  const OutputFolder folder_;
  SessionReport report_;
  OpenedSession opened_;
  std::optional<FolderLock> lock_;
  std::optional<FrameFiles> files_;
  std::optional<RunTracker> tracker_;
  std::optional<FrameStep> step_;
  Fingerprint fingerprint_;
  std::unique_ptr<FrameWriter> writer_;
  std::unique_ptr<PictureOutput> pictures_;
  RenderedFrame rendered_;
  FloorFrames floor_frames_;
  bool reading_ = false;  // session and scene: an error is one of theirs
  DrawnPictures drawn_;   // by this run
  std::int64_t frames_since_checkpoint_ = 0;
  TimeNs checkpoint_ns_ = 0;  // when the last one was written
};

SessionReport SessionReplay::run() {
  try {
    reading_ = true;
    open_session(options_, report_, opened_);  // nothing is written yet
    reading_ = false;
    // After a signal no frame is rendered: what an earlier run left stays.
    if (!stopped()) start_output();
    if (writer_) {
      reading_ = true;
      render_frames();
      reading_ = false;
      writer_->finish();
    }
  } catch (...) {
    note_failure();
  }
  // What was finished is described even after a failure. When that fails as well (a full disk), the first
  // failure is the one to tell: the second follows from it.
  try {
    if (writer_) close_output();
  } catch (...) {
    if (report_.state != ReplayState::failed) note_failure();
  }
  return std::move(report_);
}

void SessionReplay::note_failure() {
  report_.state = ReplayState::failed;
  report_.exit_code = exit_code_of_current_exception(report_.error);
  report_.unopened = !writer_ && reading_;
  if (reading_) add_keep_going(options_, report_);
}

void SessionReplay::start_output() {
  const bool resume = options_.resume && path_exists(folder_.checkpoint_json());
  lock_.emplace(folder_.prepare(options_.formats, resume ? EarlierResults::resume : EarlierResults::replace));
  files_.emplace(folder_, options_, report_.pictures(), report_.range);
  step_.emplace(options_, report_, opened_);
  tracker_.emplace(*opened_.session, *opened_.renderer, report_.range.first);
  if (can_resume()) fingerprint_ = fingerprint_of(report_, options_, opened_.scene);
  EarlierFrames earlier;
  earlier.next_frame = report_.range.first;
  if (resume) {
    earlier = earlier_frames();
    go_on_from(earlier);
    if (report_.nothing_to_do) return;
  } else if (can_resume()) {
    // Before frames.csv: a folder with results has a checkpoint.
    write_whole_file(folder_.checkpoint_json(), checkpoint_text(fingerprint_, tracker_->whole_state()));
  }
  open_writer(earlier);
  skip_frames_before(earlier.next_frame);
}

EarlierFrames SessionReplay::earlier_frames() const {
  return read_earlier_frames(folder_.frames_csv(), *files_, report_.range);
}

void SessionReplay::restore(const RunState& state, std::optional<TimeNs> last_frame_ns) {
  try {
    tracker_->restore(state, last_frame_ns);
  } catch (const std::invalid_argument& error) {
    throw InputError(folder_.checkpoint_json(), 0, std::string("is damaged: ") + error.what(),
                     "give --overwrite to start again");
  }
}

// Session, renderer and report as they were when the interrupted run ended; nothing is written.
void SessionReplay::go_on_from(const EarlierFrames& earlier) {
  const Checkpoint checkpoint = read_checkpoint(folder_.checkpoint_json());
  if (const std::string what = difference(checkpoint.fingerprint, fingerprint_); !what.empty()) {
    throw UsageError("--resume: " + printable(folder_.path().string()) + ": " + what +
                     "; give what the interrupted replay was given, or --overwrite to start again");
  }
  const RunState& state = checkpoint.state;
  check_fits(state, report_.range, folder_.checkpoint_json());
  // A checkpoint past the first missing frame is of no use: files have gone since.
  if (state.next_frame <= earlier.next_frame) {
    std::optional<TimeNs> last_frame_ns;
    if (state.next_frame > report_.range.first) last_frame_ns = report_.range.time_ns(state.next_frame - 1);
    restore(state, last_frame_ns);
  }
  step_->go_on_after(earlier.stutter);
  report_.remark = earlier.remark;
  report_.kept_frames = earlier.statistics.frames;
  take_over(earlier);
  report_.nothing_to_do = earlier.next_frame == report_.range.first + report_.range.count &&
                          tracker_->state().next_frame == earlier.next_frame &&
                          summary_says_done(folder_.summary_json());
  if (report_.nothing_to_do) describe_run();
}

void SessionReplay::take_over(EarlierFrames earlier) {
  report_.statistics = std::move(earlier.statistics);
  report_.files_written = earlier.picture_files;
  report_.bytes_written = earlier.picture_bytes;
  report_.writer_waits = earlier.writer_waits;
  report_.contact_sheets = std::move(earlier.contact_sheets);
}

void SessionReplay::open_writer(const EarlierFrames& earlier) {
  AppendFile csv(folder_.frames_csv(), earlier.csv_bytes);
  // An earlier summary tells of the end of a run, and this one has not ended.
  if (const std::error_code error = remove_path(folder_.summary_json()))
    throw WriteError(folder_.summary_json(), "remove", error.value());
  if (earlier.csv_bytes == 0) csv.append(frames_csv_header());
  csv.flush();
  // Two frames may wait: enough to even out the disk, little enough to hold in memory. One more place for a
  // frame's row and one for a checkpoint.
  const std::size_t jobs_per_frame = std::max<std::size_t>(files_->files_per_frame(), 1) + 2;
  writer_ = std::make_unique<FrameWriter>(2 * jobs_per_frame, std::move(csv));
  checkpoint_ns_ = steady_now_ns();
  PictureOutput::Config config;
  config.formats = options_.formats;
  config.with_alpha = !report_.plan.camera;
  config.pictures = report_.pictures();
  config.metadata = picture_metadata(report_, options_, opened_.scene.world_from_session);
  pictures_ = std::make_unique<PictureOutput>(std::move(config), *files_, *opened_.renderer, *writer_);
}

// What the frames between the checkpoint and the first missing one change in session and renderer.
void SessionReplay::skip_frames_before(std::int64_t frame) {
  while (tracker_->state().next_frame < frame) {
    if (stopped()) return;
    step_->prepare(tracker_->state().next_frame);
    tracker_->sampled(step_->sample());
    step_->skip_frame();
    tracker_->frame_done();
  }
}

void SessionReplay::render_frames() {
  if (options_.clock == ReplayClock::realtime) {
    render_paced_frames();
    return;
  }
  const FrameRange& range = report_.range;
  ProgressBar progress(report_.name, range.count, report_.kept_frames);
  for (std::int64_t i = report_.kept_frames; i < range.count; ++i) {
    if (stopped() || !render_one(range.first + i, {})) return;
    progress.update(i + 1);
    checkpoint_if_due();
  }
}

void SessionReplay::checkpoint_if_due() {
  const TimeNs now_ns = steady_now_ns();
  if (++frames_since_checkpoint_ < kCheckpointFrames && now_ns - checkpoint_ns_ < kCheckpointIntervalNs)
    return;
  frames_since_checkpoint_ = 0;
  checkpoint_ns_ = now_ns;
  save_checkpoint();
}

void SessionReplay::save_checkpoint() {
  if (can_resume()) {
    writer_->checkpoint(folder_.checkpoint_json(), checkpoint_text(fingerprint_, tracker_->whole_state()));
  }
}

void SessionReplay::render_paced_frames() {
  const FrameRange& range = report_.range;
  ProgressBar progress(report_.name, range.count);
  FramePacer pacer(steady_now_ns(), range.period_ms() * 1e6, range.first, range.count);
  while (const auto begin = pacer.begin(steady_now_ns())) {
    sleep_until(begin->due_ns, [] { return stop_signal() != 0; });
    if (stopped() || !render_one(begin->frame, {&pacer, begin->dropped})) return;
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

// False after a signal: then the frame was given up.
bool SessionReplay::render_one(std::int64_t frame, const FramePacing& pacing) {
  step_->prepare(frame);
  tracker_->sampled(step_->sample());
  if (!step_->render(rendered_, &stop_flag(), pacing)) return !stopped();
  note_plan(frame);
  FrameRecord record = step_->record();
  const PictureOutput::Cost cost = pictures_->write_frame(frame, step_->sample(), rendered_);
  if (const auto sheet = files_->contact_sheet(frame)) {
    report_.contact_sheets.push_back(sheet->filename().string());
  }
  record.write_ms = cost.encode_ms;
  record.wait_ms = cost.wait_ms;
  record.nonfinite_pictures = cost.nonfinite_values;
  record.clipped_pixels = cost.clipped_pixels;
  drawn_.add(rendered_.viewports, opened_.scene.world_from_session * step_->sample().head.world_from_head);
  report_.statistics.add(record);
  floor_frames_.add(record, quality_target_ms(options_, report_.range),
                    std::max(1, std::min(report_.settings.threads, report_.load.cores)));
  report_.writer_waits += record.wait_ms > 0 ? 1 : 0;
  writer_->add_row(frames_csv_row(record));
  tracker_->frame_done();
  return true;
}

// The last checkpoint and summary.json, after the frames that they tell of.
void SessionReplay::close_output() {
  // After bad input, frames that are still in the queue are good: they are written. After a
  // failed write this throws. (Usage: the write was not allowed. Any other usage error comes
  // before there is something to close.)
  const bool write_failed = report_.exit_code == kExitTemporary || report_.exit_code == kExitUsage;
  if (report_.state != ReplayState::failed || !write_failed) {
    save_checkpoint();
    writer_->finish();
    report_.files_written += writer_->files_written();
    report_.bytes_written += writer_->bytes_written();
  } else if (can_resume()) {
    // Frames that were in the queue are lost.
    take_over(earlier_frames());
  }
  describe_run();
  write_whole_file(folder_.summary_json(), json_text(summary_json(report_, options_)));
  sync_folder(folder_.path());
}

PictureMemory SessionReplay::picture_memory() const {
  PictureMemory memory{frame_bytes(rendered_), 0, 0};
  if (step_) memory.camera = camera_bytes(step_->sample());
  if (pictures_) memory.encoders += pictures_->bytes_held();
  if (writer_) memory.encoders += writer_->bytes_held();
  return memory;
}

void SessionReplay::describe_run() {
  report_.findings = tracker_->findings();
  if (opened_.renderer) report_.memory = memory_parts(*opened_.renderer, opened_.scene, picture_memory());
  report_.load = process_load();
  report_.sanitised_camera_values = tracker_->state().sanitised_camera_values;
  report_.findings.skipped_rows += opened_.player->skipped_changes();
  const bool skipped = report_.findings.skipped_rows > 0 || report_.findings.skipped_images > 0;
  if (report_.exit_code == kExitDone && skipped) report_.exit_code = kExitPartial;
  add_run_warnings();
}

// What the frame's plan has that the one before had not, and the other way round.
void SessionReplay::note_plan(std::int64_t frame) {
  if (rendered_.counters.plan_changes == 0 || report_.plan_changes.size() >= kPlanChangesKept) return;
  const FramePlan& plan = opened_.renderer->plan();
  const FramePlan& before = report_.plan_changes.empty() ? report_.plan : report_.plan_changes.back().plan;
  report_.plan_changes.push_back({frame, differing_entries(before, plan), plan});
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
  const std::vector<std::string>& changes = opened_.player->warnings();
  report_.warnings.insert(report_.warnings.end(), changes.begin(), changes.end());
  if (std::string warning = drawn_.warning(opened_.scene, statistics.frames,
                                           statistics.counters.object_samples, report_.profile);
      !warning.empty())
    report_.warnings.push_back(std::move(warning));
  if (const std::string warning = floor_frames_.warning(options_.profile_scale); !warning.empty()) {
    report_.warnings.push_back(warning);
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
