// From what one frame was made of and how long it took to its row in frames.csv: ages,
// motion-to-photon, missed.
#pragma once

#include "renderer/renderer.h"
#include "server/frames/frame_pacer.h"
#include "server/results/session_report.h"
#include "server/settings/replay_options.h"
#include "server/statistics/frame_record.h"

namespace herr {

// Presentation time: virtual = frame start + max(frame time, one period); max = frame start + frame time.
// Costs of sampling and writing are filled in by the caller.
FrameRecord describe_frame(std::int64_t frame, const FrameSample& sample, const RenderedFrame& rendered,
                           const SessionReport& report, ReplayClock clock);

// Why the frame had its quality, and how fast the head moved.
void describe_quality(const QualityDecision& decision, const FrameSample& sample, FrameRecord& record);

// What the clock `realtime` says of a frame that describe_frame() described: presentation at a display tick.
void describe_pacing(const FramePacer::Outcome& outcome, std::int64_t dropped, FrameRecord& record);

}  // namespace herr
