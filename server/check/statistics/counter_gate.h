// Work that is counted, not timed: the same on every machine, so any real change shows at once.
// Before: the counters of runs of two programs. After: a verdict for each counter.
#pragma once

#include <string>
#include <vector>

#include "server/check/statistics/verdict.h"

namespace herr {

inline constexpr double kCounterLimit = 0.005;

// Of one program over all its runs, per frame. They are alike where the work is deterministic.
struct CounterRange {
  std::string name;
  double lowest = 0, highest = 0;
};

struct CounterJudgement {
  std::string name;
  Verdict verdict = Verdict::inconclusive;
  double baseline = 0, candidate = 0;  // the highest of each
  std::string reason;                  // one line, where the verdict is not plain from the numbers
};

// regression: even the lowest of the candidate is more than 0.5 % above the highest of the baseline. ok: the
// highest is at most 0.5 % above the lowest. Runs that differ too much to tell are inconclusive, and so is a
// counter that one side lacks, unless the candidate alone has it and it is 0. In the baseline's order, then
// what only the candidate has.
std::vector<CounterJudgement> judge_counters(const std::vector<CounterRange>& baseline,
                                             const std::vector<CounterRange>& candidate);

}  // namespace herr
