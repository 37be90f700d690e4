// Where the probes of a volume really stand, which of them can ever matter, and how far each sees: worked out
// once, when the renderer is built, with the scene as it is then.
// Before: EmbreeScene has the geometry in place. After: frames only gather light.
#pragma once

#include "renderer/geometry/embree_scene.h"
#include "renderer/probes/probe_volume.h"
#include "renderer/threads/render_threads.h"

namespace herr {

class ProbePlacement {
 public:
  // Fills `volume`: probes near geometry; places, up to 0.45 of the spacing off the grid where a probe stood
  // too close to a surface; distance maps for each set. `scene` is the one that `geometry` was made from.
  static void settle(ProbeVolume& volume, const Scene& scene, const EmbreeScene& geometry,
                     RenderThreads& threads);
};

}  // namespace herr
