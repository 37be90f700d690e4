// One frame of a session, taken once and rendered many times: by references, and by every setting of a study.
// Before: FrameStep::prepare. After: reference_picture, measure_setting. Valid until the step prepares
// another frame: scene and state are those of this moment.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/renderer.h"
#include "server/study/error/linear_picture.h"
#include "server/study/error/picture_errors.h"
#include "server/study/error/viewport_map.h"

namespace herr {

struct FrameInstant {
  std::int64_t number = 0;
  const Scene* scene = nullptr;
  const SceneState* state = nullptr;
  const FrameSample* sample = nullptr;
  const DisplayProfile* profile = nullptr;
  bool session_has_camera = false;
  std::vector<ViewportMap> maps;  // by this frame's gaze
};

// The maps of a sample's gaze.
std::vector<ViewportMap> viewport_maps(const FrameSample& sample, const DisplayProfile& profile);

// A renderer that is ready for the instant: its probes have gathered light until they rest, as if the scene
// had stood still before (2.4 s in long steps, then 2 time constants at the display's rate).
std::unique_ptr<Renderer> renderer_at(const FrameInstant& instant, const RenderSettings& settings);

// The viewports of a frame as pictures, black where no eye sees them. `out` keeps its storage.
void read_viewports(const RenderedFrame& frame, const FrameInstant& instant, const ParallelFor& parallel_for,
                    std::vector<LinearPicture>& out);

// The renderer's threads for other work between frames.
ParallelFor threads_of(Renderer& renderer);

}  // namespace herr
