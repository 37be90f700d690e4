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

// The bright end of what is shown, and the linear value that it is brought to (8-bit sRGB 231): single
// highlights and lamps above it turn white.
inline constexpr double kMeteredShare = 0.95, kMeteredValue = 0.8;

// Stops, a multiple of 1/100 within [-kMostExposure_ev, kMostExposure_ev], that bring the luminance (Rec.
// 709) below which kMeteredShare of the covered pixels lie to kMeteredValue. Pixels count by their coverage,
// colours are taken without it; focus viewports repeat what context viewports see and count only where there
// are no others. None where nothing covers a pixel or everything is black.
std::optional<double> metered_ev(const std::vector<ViewportImage>& pictures, const DisplayProfile& profile);

// Renders the first frame of the recording, without its camera feed, and sets the renderer's exposure by it.
// Everything else is as open_session() left it afterwards. Where nothing can be metered the exposure is 0,
// and scene.warnings says so.
void choose_exposure(const SessionReport& report, OpenedSession& opened);

}  // namespace herr
