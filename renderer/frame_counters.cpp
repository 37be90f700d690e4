#include "renderer/frame_counters.h"

#include <array>

namespace herr {
namespace {

constexpr std::array kRows{
    CounterRow{"polar_samples", "samples", "Samples of both polar buffers that some viewport can see.",
               &FrameCounters::polar_samples},
    CounterRow{"edge_samples", "samples", "Samples at edges, through which further rays went.",
               &FrameCounters::edge_samples},
    CounterRow{"viewport_pixels", "pixels", "Pixels of all viewports.", &FrameCounters::viewport_pixels},
    CounterRow{"invalid_rays", "rays", "Rays that are not finite: never handed to Embree.",
               &FrameCounters::invalid_rays},
    CounterRow{"nonfinite_values", "values", "NaN or Inf values that a stage produced.",
               &FrameCounters::nonfinite_values},
    CounterRow{"cut_paths", "paths",
               "Paths through glass that ended at a limit and took the light from outside for the rest.",
               &FrameCounters::cut_paths},
    CounterRow{
        "light_beyond_feed", "samples",
        "Samples of real surfaces where virtual light is more than the feed carries: its rest is added "
        "by the surface's stated colour.",
        &FrameCounters::light_beyond_feed},
    CounterRow{"object_samples", "samples",
               "Samples whose first hit is a virtual object: 0 where none is in view.",
               &FrameCounters::object_samples},
    CounterRow{"commits", "scenes", "Embree scenes committed.", &FrameCounters::commits},
    CounterRow{"instances_moved", "instances", "Instances that stand elsewhere than in the frame before.",
               &FrameCounters::instances_moved},
    CounterRow{"instances_spawned", "instances", "Instances that were not there in the frame before.",
               &FrameCounters::instances_spawned},
    CounterRow{"instances_removed", "instances", "Instances that were there in the frame before.",
               &FrameCounters::instances_removed},
    CounterRow{"instances_restyled", "instances", "Instances with another material, or another mesh.",
               &FrameCounters::instances_restyled},
    CounterRow{"meshes_refitted", "meshes", "Meshes that bent, their boxes moved along.",
               &FrameCounters::meshes_refitted},
    CounterRow{"meshes_rebuilt", "meshes", "Meshes that bent, their boxes sorted anew.",
               &FrameCounters::meshes_rebuilt},
    CounterRow{"plan_changes", "frames", "Frames whose plan is another than the frame before had.",
               &FrameCounters::plan_changes}};

static_assert(sizeof(FrameCounters) == sizeof(RayCounts) + kRows.size() * sizeof(std::int64_t),
              "each counter has a row");

}  // namespace

std::span<const CounterRow> counter_rows() {
  return kRows;
}

FrameCounters& FrameCounters::operator+=(const FrameCounters& other) {
  rays += other.rays;
  for (const CounterRow& row : kRows) this->*row.value += other.*row.value;
  return *this;
}

}  // namespace herr
