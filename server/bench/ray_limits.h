// How many rays of each kind the frame plan implies at most; more is a fault of the renderer.
// Before: bench_frames counted. After: `herr bench` prints the line and ends with exit code 70.
#pragma once

#include <cstddef>
#include <string>

#include "renderer/bench_frame.h"

namespace herr {

// One line that names the first kind of which more were traced than `plan` implies; empty when there is none.
// `lights` and the settings' light samples bound the shadow rays of a hit.
std::string rays_beyond_plan(const BenchResult& result, const FramePlan& plan, std::size_t lights,
                             const RenderSettings& settings);

}  // namespace herr
