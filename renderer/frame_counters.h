// The counters of a frame, one row each. JSON, frames.csv, `herr check`, `herr bench`, metrics and sums go
// over these rows: a new counter is one member of FrameCounters, one row, and the place where it is counted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "renderer/ray_kind.h"

namespace herr {

// Rays by kind and pixels of one frame: the same for the same input on any machine.
struct FrameCounters {
  RayCounts rays;
  std::int64_t polar_samples = 0;  // samples of both polar buffers that some viewport can see
  std::int64_t edge_samples = 0;   // of these, at edges: further rays went through them
  std::int64_t viewport_pixels = 0;
  std::int64_t invalid_rays = 0;      // not finite: never handed to Embree
  std::int64_t nonfinite_values = 0;  // NaN or Inf that a stage produced; replaced by 0 and counted
  // Light through glass that was followed no further: it brings the probes' light, without probes the
  // environment.
  std::int64_t cut_paths = 0;
  // Samples of real surfaces on which virtual lights add more than four times the feed shows, or where no
  // real light is known: there the surface's stated colour carries the rest.
  std::int64_t light_beyond_feed = 0;
  std::int64_t object_samples = 0;  // of samples, those whose first hit is a virtual object, no catcher
  std::int64_t commits = 0;         // Embree scenes committed
  std::int64_t instances_moved = 0, instances_spawned = 0, instances_removed = 0;
  std::int64_t instances_restyled = 0;  // another material, or another mesh
  std::int64_t meshes_refitted = 0, meshes_rebuilt = 0;
  std::int64_t plan_changes = 0;  // 1 where the frame plan is another than the frame before had

  // Exact, in any order.
  FrameCounters& operator+=(const FrameCounters& other);
};

// All are counts of one frame: those of several frames, and of several runs, add up.
struct CounterRow {
  const char* name;      // key in JSON, column in CSV
  const char* unit;      // what is counted
  const char* sentence;  // ends with a full stop
  std::int64_t FrameCounters::*value;
};
// Everything but the rays, which RayKind lists.
std::span<const CounterRow> counter_rows();

// Calls visit(name, value) for each: "primary_rays", ... by RayKind, then the rows. `Counters` is
// FrameCounters, const or not; value is a reference to its count.
template <typename Counters, typename Visit>
void for_each_counter(Counters& counters, Visit&& visit) {
  for (std::size_t k = 0; k < kRayKinds; ++k) {
    visit(std::string(name_of(static_cast<RayKind>(k))) + "_rays", counters.rays.of_kind[k]);
  }
  for (const CounterRow& row : counter_rows()) visit(std::string(row.name), counters.*row.value);
}

}  // namespace herr
