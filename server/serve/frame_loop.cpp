#include "server/serve/frame_loop.h"

#include <utility>

#include "renderer/polar_picture.h"
#include "server/process/steady_time.h"
#include "server/results/memory_parts.h"
#include "server/results/output_folder.h"
#include "server/serve/latest_picture.h"

namespace herr {
namespace {

// Histograms are a third of a megabyte: copied ten times a second they cost nothing that one could measure.
constexpr TimeNs kPublishIntervalNs = 100'000'000;
// Polar buffers are copied, some megabytes a frame, for this long after somebody has asked
// for one or for the page.
constexpr TimeNs kPolarWatchNs = 10'000'000'000;

}  // namespace

const char* name_of(ServePhase phase) {
  switch (phase) {
    case ServePhase::starting:
      return "starting";
    case ServePhase::running:
      return "running";
    case ServePhase::stopping:
      return "stopping";
  }
  return "unknown";
}

FrameLoop::FrameLoop(const ReplayOptions& options, ServeBoard& board, const std::atomic<bool>& stop)
    : options_(options), board_(board), stop_(stop) {
  state_.started_ns = steady_now_ns();
  publish(true);
}

void FrameLoop::run() {
  while (!stop_) {
    for (const std::filesystem::path& folder : options_.sessions) {
      open(folder);
      replay_lap();
      if (stop_) return;
    }
    ++state_.lap;
  }
}

// Scene and renderer stay while the folder stays.
void FrameLoop::open(const std::filesystem::path& folder) {
  if (opened_ && folder == opened_folder_) {
    step_->begin_lap();
    return;
  }
  auto report = std::make_shared<SessionReport>();
  report->name = session_folder_name(folder);
  report->session_folder = folder;
  step_.reset();
  opened_.reset();
  opened_ = std::make_unique<OpenedSession>();
  open_session(options_, *report, *opened_);
  report->warnings = report->findings.warnings;
  report->warnings.insert(report->warnings.end(), opened_->scene.warnings.begin(),
                          opened_->scene.warnings.end());
  report->warnings.insert(report->warnings.end(), opened_->player->warnings().begin(),
                          opened_->player->warnings().end());
  opened_folder_ = folder;
  subject_ = std::move(report);
  step_.emplace(options_, *subject_, *opened_);
  state_.subject = subject_;
  state_.memory = subject_->memory;
}

void FrameLoop::replay_lap() {
  if (options_.clock == ReplayClock::realtime) {
    replay_paced();
    return;
  }
  const FrameRange& range = subject_->range;
  for (std::int64_t i = 0; i < range.count && !stop_; ++i) render(range.first + i, {});
}

void FrameLoop::replay_paced() {
  const auto stop = [this] { return stop_.load(); };
  const FrameRange& range = subject_->range;
  FramePacer pacer(steady_now_ns(), range.period_ms() * 1e6, range.first, range.count);
  while (const auto begin = pacer.begin(steady_now_ns())) {
    if (!sleep_until(begin->due_ns, stop)) return;
    render(begin->frame, {&pacer, begin->dropped});
  }
  dropped_at_end_ += pacer.frames_dropped_at_end();
  // The last frame stays for its period: the next lap begins at the next tick.
  sleep_until(pacer.tick_ns(range.first + range.count), stop);
}

void FrameLoop::render(std::int64_t frame, FramePacing pacing) {
  step_->prepare(frame);
  // Into pictures that nobody looks at; the published ones stay as they are.
  const std::shared_ptr<ServedPictures> pictures = picture_storage_.take();
  // What the lap before left out at its end counts with the frame that came next.
  pacing.dropped += std::exchange(dropped_at_end_, 0);
  if (!step_->render(pictures->frame, &stop_, pacing)) return;

  RecentFrame recent;
  recent.sequence = ++state_.rendered;
  recent.lap = state_.lap;
  recent.finished_ns = step_->finished_ns();
  recent.record = step_->record();
  recent_.add(recent);
  state_.run.add(recent.record);
  state_.frame = frame;
  state_.phase = ServePhase::running;
  pictures->sequence = recent.sequence;
  pictures->coverage = !subject_->plan.camera;
  pictures->subject = subject_;
  pictures->has_polar = recent.finished_ns - board_.polar_asked_ns < kPolarWatchNs;
  for (std::size_t eye = 0; pictures->has_polar && eye < pictures->polar.size(); ++eye) {
    pictures->has_polar =
        thin_polar_buffer(*opened_->renderer, static_cast<Eye>(eye), kReducedPicturePx, pictures->polar[eye]);
  }
  note_memory(*pictures);
  board_.pictures.set(pictures);
  publish(state_.rendered == 1);
}

// Parts keep their places: nothing is allocated once each is there. Pictures that are published, watched and
// spare are of one size.
void FrameLoop::note_memory(const ServedPictures& pictures) {
  if (pictures.frame.counters.plan_changes > 0) {
    state_.memory = memory_parts(*opened_->renderer, opened_->scene, {});
  }
  std::int64_t one = frame_bytes(pictures.frame);
  for (const ViewportImage& polar : pictures.polar) one += bytes_of(polar.rgba_half);
  set_pictures({one * picture_storage_.made(), camera_bytes(step_->sample()), 0}, state_.memory);
}

void FrameLoop::announce_end() {
  state_.phase = ServePhase::stopping;
  publish(true);
}

void FrameLoop::publish(bool at_once) {
  state_.taken_ns = steady_now_ns();
  if (!at_once && state_.taken_ns - published_ns_ < kPublishIntervalNs) return;
  published_ns_ = state_.taken_ns;
  const std::shared_ptr<ServeSnapshot> snapshot = snapshot_storage_.take();
  // Copies keep the storage of the snapshot that was taken. The records go straight in.
  std::vector<RecentFrame> records = std::move(snapshot->recent);
  records.assign(recent_.frames().begin(), recent_.frames().end());
  *snapshot = state_;
  snapshot->recent = std::move(records);
  board_.snapshot.set(snapshot);
}

}  // namespace herr
