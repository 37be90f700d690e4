// What an outside view keeps between frames: the same tiles as those of eyes, on a planar grid of its own.
// Before: OutsideView, at construction. After: frame/render_outside.cpp fills it anew for each frame.
#pragma once

#include <vector>

#include "renderer/foveation/radiance_buffer.h"
#include "renderer/outside/line_drawing.h"
#include "renderer/outside_view.h"
#include "renderer/threads/stage_clock.h"
#include "renderer/tiles/tile_job.h"

namespace herr {

struct OutsideWork {
  OutsideWork(const OutsideView& view, std::size_t viewports, int workers);
  std::int64_t bytes() const;

  OutsideView view;
  Viewport plane;         // its pixels are rays
  RadianceBuffer buffer;  // one texel per ray
  RayGrid grid;
  ShadingInputs shading;
  std::vector<OverlayLine> lines;
  std::vector<ScreenLine> screen_lines;
  std::vector<float> gaze_distance;

  // Per worker.
  std::vector<TileCounters> counters;
  std::vector<StageCycles> cycles;
  std::vector<LineScratch> line_scratch;
};

// Rows [y0, y1) of the picture: each pixel the mean of its rays, opaque.
void average_rays(const OutsideWork& work, int y0, int y1, ViewportImage& out);

}  // namespace herr
