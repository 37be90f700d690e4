// One frame of a session: sample the recording, bring the scene to that time, choose the quality, render,
// describe. This is done here alone; replay, serve, check and bench are loops around it. (bench --left-out
// renders instants that it has taken from it again and again.)
// Before: open_session. After: pictures are written, published or measured; FrameRecord goes to statistics.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "server/frames/frame_pacer.h"
#include "server/frames/opened_session.h"
#include "server/frames/work_beside.h"
#include "server/quality/quality_controller.h"
#include "server/results/session_report.h"
#include "server/settings/replay_options.h"
#include "server/statistics/frame_pace.h"
#include "server/statistics/frame_record.h"

namespace herr {

// Of the clock `realtime`: who says when frames are due, and how many were left out just before this one.
struct FramePacing {
  FramePacer* pacer = nullptr;  // null: every frame has its turn, however long that takes
  std::int64_t dropped = 0;
};

// Not thread-safe. Locks nothing, and allocates nothing beyond what decoding a camera image and instances
// beyond the most that were ever there take.
class FrameStep {
 public:
  // What open_session() made of `options`. All three must outlive it; it writes to `opened` alone.
  FrameStep(const ReplayOptions& options, const SessionReport& report, OpenedSession& opened);

  // Brings recording and scene to the time of frame `frame` of report.range and chooses its quality. Numbers
  // never decrease until begin_lap() or rewind(). Throws InputError for what the recording or a change of
  // the scene has wrong. Where the renderer was given back no quality is chosen.
  void prepare(std::int64_t frame);
  // Renders the prepared frame and describes it in record(). False: `abandon` (may be null) gave it up; then
  // neither `out` nor record() is of use. Throws as Renderer::render_frame.
  bool render(RenderedFrame& out, const std::atomic<bool>* abandon = nullptr, const FramePacing& pacing = {});
  // In place of render(): the renderer takes up what the frame changes in its state.
  void skip_frame();

  // After the frames of an earlier run of this session, as their rows tell.
  void go_on_after(const StutterWatch& earlier) { stutter_ = earlier; }

  // The recording from its start, and the scene as it was loaded. The renderer stays as it is, and so does
  // what the policy has learnt: an endless run goes on.
  void begin_lap();
  // Everything as open_session() left it: frames from here on are those of a fresh replay, bit for bit.
  // opened.renderer may be another one than before.
  void rewind();

  // Of the frame prepared last.
  const FrameSample& sample() const { return sample_; }
  const SceneState& scene_state() const { return opened_.player->state(); }
  const FrameQuality& quality() const { return decision_.quality; }
  // Of the frame rendered last. What comes after rendering (writing, waiting) is the caller's to add.
  const FrameRecord& record() const { return record_; }
  // steady_now_ns() when it was rendered: with its further views where a pacer was given, else without.
  TimeNs finished_ns() const { return finished_ns_; }

 private:
  void describe(const RenderedFrame& rendered, const FramePacing& pacing);
  // `whole_period`: the period has to hold what stands beside the frame, too.
  MissFacts miss_facts(bool whole_period) const;

  const ReplayOptions& options_;
  const SessionReport& report_;
  OpenedSession& opened_;
  std::optional<QualityController> controller_;
  StutterWatch stutter_;
  WorkBeside beside_;
  std::int64_t frame_ = 0;
  TimeNs started_ns_ = 0, sampled_ns_ = 0, finished_ns_ = 0;
  FrameSample sample_;
  QualityDecision decision_;
  FrameRecord record_;
};

}  // namespace herr
