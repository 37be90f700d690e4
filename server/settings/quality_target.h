// What the policies of server/quality/ are held to: the options of a run as numbers.
#pragma once

#include <string>

#include "renderer/render_settings.h"
#include "server/settings/frame_range.h"
#include "server/settings/replay_options.h"

namespace herr {

// Milliseconds that the policy `deadline` holds: --target-ms, or the display period.
double quality_target_ms(const ReplayOptions& options, const FrameRange& range);
// As a line to be pasted and a report tell it, to a hundredth: "11.11".
std::string target_text(double target_ms);
int narrowest_width(const ReplayOptions& options, const RenderSettings& settings);
int lowest_height(const ReplayOptions& options, const RenderSettings& settings);

// Frames of a policy that follows the clock on the wall, and of the clock realtime, are not made twice alike.
bool is_reproducible(const ReplayOptions& options);

}  // namespace herr
