// A machine that was too restless so far: can the runs to come still make it quiet enough, whatever they
// measure? Where they cannot, going on is a waste. Before: the calibration and CPU times of the runs so far.
// After: the check ends early as `noisy`.
#pragma once

#include <span>

namespace herr {

// Will robust_cv() of `final_count` values, no fewer than these, exceed kMostCalibrationCv whatever positive
// values follow these? With c = kMostCalibrationCv / 1.4826, a machine that is quiet enough in the end has a
// median absolute deviation of at most c m, m the median of all M = final_count values. So at least M / 2 of
// them lie within [m (1 - c), m (1 + c)]. At most M - N of those are still to come, N the number there is: at
// least N - M / 2 of the present ones lie within a span whose ends have the ratio (1 + c) / (1 - c). Where no
// such span holds so many, the answer is yes. A smaller final count asks for more: it holds for each count up
// to M.
bool speed_stays_restless(std::span<const double> rays_ms, int final_count);

// Of one run, or of several together, in one unit.
struct CpuDemand {
  double asked = 0;   // used and stolen
  double stolen = 0;  // not a number where the kernel does not tell
};
// Will the share stolen of `final_count` runs exceed kMostSteal even where nothing is stolen from those to
// come? The same work asks for no more CPU time than it asked for in the most demanding run so far, A. With S
// stolen of T asked for, the share in the end is then at least S / (T + (M - N) A). A run that does not tell
// leaves the whole unknown: yes.
bool steal_stays_high(std::span<const CpuDemand> runs, int final_count);

}  // namespace herr
