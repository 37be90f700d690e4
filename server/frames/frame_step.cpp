#include "server/frames/frame_step.h"

#include <algorithm>
#include <cmath>

#include "server/frames/frame_description.h"
#include "server/frames/frame_quality.h"
#include "server/process/steady_time.h"
#include "server/settings/quality_target.h"

namespace herr {

FrameStep::FrameStep(const ReplayOptions& options, const SessionReport& report, OpenedSession& opened)
    : options_(options), report_(report), opened_(opened) {
  controller_.emplace(quality_controller(options_, report_, *opened_.renderer));
}

void FrameStep::prepare(std::int64_t frame) {
  frame_ = frame;
  const TimeNs t_ns = report_.range.time_ns(frame);
  started_ns_ = steady_now_ns();
  beside_.begin_sampling();
  sample_ = opened_.session->sample(t_ns);
  sampled_ns_ = steady_now_ns();
  opened_.player->advance(*opened_.session, t_ns);
  beside_.end_sampling();
  if (!opened_.renderer) return;
  decision_ = controller_->decide(sample_.head_speed, opened_.renderer->full_quality(sample_).polar_width);
}

bool FrameStep::render(RenderedFrame& out, const std::atomic<bool>* abandon, const FramePacing& pacing) {
  beside_.begin_rendering();
  if (!opened_.renderer->render_frame(sample_, scene_state(), decision_.quality, out, abandon)) return false;
  beside_.end_rendering();
  finished_ns_ = steady_now_ns();
  // A display waits for further views too; where every frame has its turn they are none of its cost.
  if (pacing.pacer == nullptr) finished_ns_ -= std::llround(out.times.views_ms * 1e6);
  describe(out, pacing);
  const bool missed = pacing.pacer != nullptr && record_.missed;
  controller_->observe(cost_of_frame(out, started_ns_, finished_ns_, missed));
  return true;
}

void FrameStep::describe(const RenderedFrame& rendered, const FramePacing& pacing) {
  record_ = describe_frame(frame_, sample_, rendered, report_, options_.clock);
  describe_quality(decision_, sample_, record_);
  record_.sample_ms = static_cast<double>(sampled_ns_ - started_ns_) * 1e-6;
  record_.stutter = stutter_.next_ms(record_.times.frame_ms);
  if (pacing.pacer != nullptr) {
    describe_pacing(pacing.pacer->finish(started_ns_, finished_ns_), pacing.dropped, record_);
  }
  const double shown_ms = pacing.pacer != nullptr ? static_cast<double>(finished_ns_ - started_ns_) * 1e-6
                                                  : record_.times.frame_ms;
  if (record_.missed) record_.over_ms = std::max(0.0, shown_ms - record_.period_ms);
  record_.over_target = shown_ms > quality_target_ms(options_, report_.range);
  if (record_.missed) record_.cause = cause_of_miss(miss_facts(pacing.pacer != nullptr));
}

MissFacts FrameStep::miss_facts(bool whole_period) const {
  MissFacts facts;
  facts.frame_ms = record_.times.frame_ms;
  facts.period_ms = report_.range.period_ms();
  facts.cpu_ms = record_.cpu_ms;
  facts.preemptions = record_.preemptions;
  facts.threads = std::max(1, std::min(report_.settings.threads, report_.load.cores));
  if (whole_period) facts.beside_cpu_ms = beside_.cpu_ms(record_.cpu_ms, facts.threads);
  return facts;
}

void FrameStep::skip_frame() {
  opened_.renderer->skip_frame(sample_, scene_state());
}

void FrameStep::begin_lap() {
  open_recording(options_, report_, opened_);
  opened_.player->restart();
}

void FrameStep::rewind() {
  begin_lap();
  opened_.renderer->restart(scene_state());
  controller_.emplace(quality_controller(options_, report_, *opened_.renderer));
  stutter_ = {};
}

}  // namespace herr
