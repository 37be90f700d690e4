// The exposure that suits a picture: for `--auto-exposure`, scenes that ask for it, and `herr look`.
// Before: viewports as rendered, without a camera feed. After: Renderer::set_exposure.
#pragma once

#include <optional>
#include <vector>

#include "renderer/viewport_image.h"
#include "sessions/format/display_profile.h"

namespace herr {

struct OpenedSession;
struct SessionReport;

// Stops, a multiple of 1/100 within [-kMostExposure_ev, kMostExposure_ev], by the rule of output/exposure.h:
// 99 % of the covered pixels are at most 0.9 in their brightest channel, taken without their coverage. Focus
// viewports repeat what context viewports see and count only where there are no others. None where nothing
// covers a pixel or everything is black.
std::optional<double> metered_ev(const std::vector<ViewportImage>& pictures, const DisplayProfile& profile);

// Renders the first frame of the recording, without its camera feed, and sets the renderer's exposure by it.
// Everything else is as open_session() left it afterwards. Where nothing can be metered the exposure is 0,
// and scene.warnings says so.
void choose_exposure(const SessionReport& report, OpenedSession& opened);

}  // namespace herr
