// What an eye sees through the headset: focus viewports blended into the context viewport over
// Viewport::edge_blend_deg at their borders, as the headset's optics do with the viewports that they get.
// Before: finished viewports. After: a picture beside them, whose planar field of view is the context's.
//
// weight of a focus viewport = t^2 (3 - 2 t), t = min(1, angle to its nearest border / edge_blend_deg): 0 at
// the border, 1 at edge_blend_deg inside it and beyond. Angles are those along the axis, as in
// sessions/format/covered_by_focus.h. The blend is of linear premultiplied RGBA.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/further_view.h"
#include "renderer/viewport_image.h"
#include "sessions/format/display_profile.h"

namespace herr {

inline constexpr int kBlendedStripRows = 16;  // rows of a job
inline constexpr int kMostBlendedSide_px = 8192;

// How the pixels along one axis of a view are made of those of a viewport: each is the mean over its own
// width, exactly by area; where a pixel of the viewport is wider, over that one's width, which is linear
// interpolation. At borders the mean is of what the viewport has.
struct BlendAxis {
  int begin = 0, end = 0;         // pixels of the view whose centres lie in the viewport
  std::vector<int> first, count;  // of the view's pixel begin + i: which pixels of the viewport
  std::vector<float> weights;     // `most` for each of them, `count` in use; their sum is 1
  std::size_t most = 1;
  std::vector<float> inside;  // t of this axis alone; 1 without a blend
  std::int64_t bytes() const;
};

struct BlendLayer {
  std::size_t viewport = 0;  // number in the profile
  BlendAxis x, y;
};

struct BlendedView {
  PictureOutline outline;
  std::vector<BlendLayer> layers;  // from below; the first ones have no blend
  int strips() const { return (outline.height_px + kBlendedStripRows - 1) / kBlendedStripRows; }
  std::int64_t bytes() const;
};

// Of an eye with one context viewport its field of view, and for Blend::context its pixels too. Several ones
// are seen together, the later over the earlier, in the smallest rectangle around them; an eye without any
// sees its focus viewports alone, without a blend. Blend::focus is as dense as the densest viewport, within
// kMostBlendedSide_px. None for an eye without viewports, and for Blend::off.
std::optional<PictureOutline> blended_outline(const DisplayProfile& profile, Eye eye, Blend density);
// Likewise, with everything that does not change from frame to frame.
std::optional<BlendedView> blended_view(const DisplayProfile& profile, Eye eye, Blend density);

// One worker's memory: a row of the widest view, and one of the widest viewport.
struct BlendScratch {
  BlendScratch(int widest_view_px, std::size_t widest_row);
  std::int64_t bytes() const;
  std::vector<float> row, source;
};

struct BlendJob {
  const BlendedView* view = nullptr;
  std::span<const ViewportImage> viewports;  // of the profile
  ViewportImage* out = nullptr;
};

// Makes rows [kBlendedStripRows * strip, ...) of the view.
using BlendStrip = void (*)(const BlendJob&, int strip, BlendScratch&);
BlendStrip blend_strip_for(Isa isa);

}  // namespace herr
