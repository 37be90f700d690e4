// Rays through bare Embree, nothing else: the speed of light that `bench` holds a frame against.
// Packets follow the order in which the rays were made, with the best flag for their
// kind; gaps are idle lanes.
#pragma once

#include <cstddef>

#include "renderer/embree/embree_api.h"
#include "renderer/render_settings.h"
#include "renderer/tiles/ray_recorder.h"

namespace herr {

// Traces rays [first, first + count) of a kind; first is a multiple of 16. Thread-safe. Returns the hits, so
// that the work cannot be left out.
std::size_t trace_bare(Isa isa, RTCScene scene, RayKind kind, const RecordedRays& rays, std::size_t first,
                       std::size_t count);

}  // namespace herr
