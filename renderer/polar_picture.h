// The polar buffers of the last frame, thinned, for people who look in. Before: Renderer::render_frame.
// After: `herr serve` shows them. A copy of a few hundred rows; only made while somebody looks.
#pragma once

#include "renderer/renderer.h"
#include "renderer/viewport_image.h"

namespace herr {

// Every n-th sample of the buffer of `eye`, x = radius from the gaze outwards, y = angle from the right
// vector counter-clockwise, at most `longest_px` wide and high. Texels are {s.r, s.g, s.b, r}: a pixel is
// feed * r + s; samples that no viewport sees hold what an earlier frame left. False where there is no polar
// buffer. `out` keeps its storage.
bool thin_polar_buffer(Renderer& renderer, Eye eye, int longest_px, ViewportImage& out);

}  // namespace herr
