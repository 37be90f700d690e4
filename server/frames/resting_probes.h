// Probes as a scene that stood still for long would have left them. Before: a new renderer, a sample. After:
// its first frame.
#pragma once

#include "renderer/renderer.h"

namespace herr {

// Gathers light until the probes rest: 2.4 s in long steps, then 2 time constants at the display's rate, all
// before the sample's time. Nothing without probes.
void let_probes_rest(Renderer& renderer, const FrameSample& sample, const SceneState& state,
                     double display_hz);

}  // namespace herr
