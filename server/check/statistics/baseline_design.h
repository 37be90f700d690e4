// Runs of now against stored runs of another program. The clock of the machine has drifted in between; the
// calibration takes out most of that, so the limit is wider than for pairs. Before: baseline_file, fresh
// runs. After: a verdict, after one look.
#pragma once

#include <span>

#include "server/check/statistics/verdict.h"

namespace herr {

struct BaselineDesign {
  int stored_runs = 20, runs = 10;
  ShiftRule rule{.limit = 0.05, .significance = 0.01};
  double tail = 0.05;  // upper bounds too low, at most
};

struct BaselineJudgement {
  Verdict verdict = Verdict::inconclusive;
  Shift shift;  // of logarithms
};

// Of logarithms of calibrated times. inconclusive where there are fewer runs than the design asks for: its
// figures would not hold.
BaselineJudgement judge_against_baseline(std::span<const double> now, std::span<const double> stored,
                                         const BaselineDesign& design);

}  // namespace herr
