// Where the policies of server/quality/ meet a replay: limits from its renderer and options, a decision
// before each frame, the cost after it. Before: replay_session, frame_loop. After: Renderer::render_frame.
#pragma once

#include <string>

#include "server/quality/quality_controller.h"
#include "server/results/session_report.h"
#include "server/settings/replay_options.h"

namespace herr {

// Milliseconds that the policy `deadline` holds: --target-ms, or the display period.
double quality_target_ms(const ReplayOptions& options, const FrameRange& range);
int narrowest_width(const ReplayOptions& options, const RenderSettings& settings);

QualityController quality_controller(const ReplayOptions& options, const SessionReport& report,
                                     const Renderer& renderer);

// A finished frame. `started_ns`: before its session was sampled; `missed`: as the display saw it.
FrameCost cost_of_frame(const RenderedFrame& frame, TimeNs started_ns, TimeNs finished_ns, bool missed);

// Frames of a policy that follows the clock on the wall, and of the clock realtime, are not made twice alike.
bool is_reproducible(const ReplayOptions& options);

// One line where frames had the least quality and still were too slow; empty where none was.
std::string floor_warning(const SessionReport& report, const ReplayOptions& options);

}  // namespace herr
