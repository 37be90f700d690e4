// What a finished frame cost, sorted by what a choice of quality changes: the time and the number of its rays
// by kind, and the rest. Before: the renderer's stage times and counters. After: CostModel, DeadlinePolicy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "renderer/renderer.h"

namespace herr {

// Kinds of work whose amount follows from the quality of a frame.
enum class WorkKind : std::uint8_t {
  eye,        // rays from the eye and all that is done once for each: as many as columns x rows
  occlusion,  // short rays: as many as columns x rows
  second,     // mirrored and refracted rays: as many as columns x rows
  light,      // shadow rays at first and second hits: columns x rows x light samples
  probe,      // rays of probes, their light and what it changes: as many as probes updated
};
inline constexpr std::size_t kWorkKinds = 5;

struct FrameCost {
  TimeNs finished_ns = 0;  // of any clock; only differences count
  double total_ms = 0;     // from the begin of its work to its end, sampling included
  bool missed = false;     // it was not done in time, whatever total_ms says
  FrameQuality quality;    // that it had
  std::array<double, kWorkKinds> work_ms{};
  std::array<std::int64_t, kWorkKinds> rays{};
};

// Threads that wait at the end of a parallel phase wait in proportion to its work: `idle` is shared out.
FrameCost frame_cost(const RenderedFrame& frame, double total_ms, bool missed, TimeNs finished_ns);

}  // namespace herr
