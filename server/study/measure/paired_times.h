// How long frames of two renderers take, side by side: blocks of AB BA, so that what drifts in the machine
// meets both alike, each block after the calibration's bare rays. Before: two renderers at one instant.
// After: paired_ratio.
#pragma once

#include <cstdint>
#include <vector>

#include "server/check/measure/calibration.h"
#include "server/study/reference/frame_instant.h"

namespace herr {

struct PairedTimes {
  std::vector<double> log_ratios;       // ln(tested / unit) of frame times, one a pair
  std::vector<double> work_log_ratios;  // of frame times without the stage from samples to pixels
  double frame_ms = 0, pixels_ms = 0;   // of the tested one, medians
  double calibration_ms = 0;            // median
  // Of the frames of all pairs: CPU time, the time that their threads could have had, and how often one of
  // them lost its core. The CPU time is 0 where the kernel does not tell.
  double cpu_ms = 0, cores_ms = 0;
  std::int64_t preemptions = 0;
};

struct TimingRules {
  int blocks = 2;         // of two pairs
  int fewest_blocks = 1;  // however long they take; with those of other frames three make an interval
  double seconds = 2.0;   // after them no further block begins
};

// `frame` is the first one of the tested renderer. What is rendered first, of either renderer, warms up,
// unless it takes so long that this makes no difference: then both count as the first pair.
PairedTimes time_pairs(Renderer& tested, Renderer& unit, const FrameInstant& instant,
                       Calibration& calibration, const TimingRules& rules, RenderedFrame& frame);

}  // namespace herr
