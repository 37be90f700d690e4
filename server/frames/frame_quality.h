// Where the policies of server/quality/ meet a replay: limits from its renderer and options, a decision
// before each frame, the cost after it. Before: replay_session, frame_loop. After: Renderer::render_frame.
#pragma once

#include "server/quality/quality_controller.h"
#include "server/results/session_report.h"
#include "server/settings/replay_options.h"

namespace herr {

QualityController quality_controller(const ReplayOptions& options, const SessionReport& report,
                                     const Renderer& renderer);

// A finished frame. `started_ns`: before its session was sampled; `missed`: as the display saw it.
FrameCost cost_of_frame(const RenderedFrame& frame, TimeNs started_ns, TimeNs finished_ns, bool missed);

}  // namespace herr
