// What a whole measured run comes down to. Before: Measurement. After: the rank
// tests, baseline_file, reports.
#pragma once

#include <span>
#include <vector>

#include "server/check/measure/cpu_time.h"
#include "server/check/measure/measurement.h"
#include "server/check/statistics/counter_gate.h"
#include "server/check/statistics/noise.h"

namespace herr {

struct RunValues {
  // Of each frame's time over the quicker of the calibrations before and after it (a unit so short
  // is either interrupted or it is not): what decides, and two that are only told. Only ratios of
  // two runs mean something.
  double median = 0, p95 = 0;
  double worst_twentieth = 0;  // the mean of the slowest 5 % of frames
  double frame_ms = 0;         // median as it was, not calibrated
  double rays_ms = 0;          // median of the calibration's bare rays: how fast the machine was
  std::optional<CpuTicks> cpu;
};

RunValues run_values(const Measurement& measurement);

// Logarithms of `value` of all runs.
std::vector<double> logarithms(std::span<const RunValues> runs, double RunValues::*value);

// The median of their frame times as they were.
double median_frame_ms(std::span<const RunValues> runs);

// Of all runs together: steal is not a number where one of them does not tell.
Noise noise_of(std::span<const RunValues> runs);
// Too restless so far, and no runs to come, up to `final_count` in all, could change that.
bool stays_noisy(std::span<const RunValues> runs, int final_count);

// Of one program over its runs. Kinds of rays that a run does not list count as 0; a counter that is unknown
// in one of the runs is left out.
std::vector<CounterRange> counter_ranges(std::span<const Measurement> runs);
// Adds kinds of rays that only the other one lists, as 0: a program that does not know a kind traces none.
void complete_ray_kinds(std::vector<CounterRange>& a, std::vector<CounterRange>& b);

}  // namespace herr
