// What the line of progress of a check says. Before: the runs so far. After: stderr.
#pragma once

#include <span>
#include <string>

#include "server/check/measure/run_values.h"
#include "server/check/statistics/pair_design.h"
#include "server/check/statistics/shift.h"

namespace herr {

// "noisy so far" where the machine is too restless for a verdict; else "slower", "faster" or "same so far",
// by the bounds of the shift, with its estimate: "slower so far (+8.1 %)"; "too early to tell" where it has
// no bounds yet. No verdict: those are given at looks alone.
std::string state_so_far(const Noise& noise, const Shift& shift);

// "7 of 15–30 pairs".
std::string pairs_text(int pairs, const PairDesign& design);
// "pair 7 of 15–30, noisy so far; 0:16 to 0:46 left": until the next look and the last, if pairs go on taking
// as long, and no longer than the time limit.
std::string pair_progress(int pairs, const PairDesign& design, const std::string& state, double pair_seconds,
                          double seconds_left);
// "run 3 of 10, noisy so far; 0:14 left".
std::string run_progress(int runs, int of, const std::string& state, double run_seconds, double seconds_left);

}  // namespace herr
