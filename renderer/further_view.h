// Pictures that a run makes of each frame beside the headset's viewports, and the one list of all pictures of
// a frame: files, parts of EXR files, contact sheets and HTTP follow it.
// Before: display profile and settings. After: Renderer::render_frame fills RenderedFrame::further.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/render_settings.h"
#include "renderer/viewport_image.h"
#include "sessions/format/display_profile.h"

namespace herr {

enum class PictureKind : std::uint8_t {
  context,  // viewports of the headset
  focus,
  blended,  // what an eye sees: focus viewports blended into the context (viewports/blended_view.h)
  outside,  // of a camera outside the headset (outside_view.h)
};
// In the order in which they stand on a sheet.
inline constexpr std::array kPictureKinds{PictureKind::context, PictureKind::focus, PictureKind::blended,
                                          PictureKind::outside};
const char* name_of(PictureKind kind);

// What is known of a picture before the first frame.
struct PictureOutline {
  std::string name;        // of a viewport its own; of a blended view one with a '-', which no viewport has
  std::optional<Eye> eye;  // none: seen from outside the head
  PictureKind kind = PictureKind::context;
  int width_px = 0, height_px = 0;
  double tan_left = 0, tan_right = 0, tan_down = 0, tan_up = 0;  // as of a Viewport
  double edge_blend_deg = 0;                                     // of a viewport
};

// A picture beside the viewports, of one frame.
struct FurtherView {
  std::string name;
  ViewportImage image;
};

// What RenderedFrame::further holds, in its order; empty unless the settings ask for something.
std::vector<PictureOutline> further_views(const DisplayProfile& profile, const RenderSettings& settings);

// All pictures of a frame: the profile's viewports in their order, then the further views.
std::vector<PictureOutline> pictures_of_frame(const DisplayProfile& profile, const RenderSettings& settings);

}  // namespace herr
