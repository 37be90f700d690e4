// When pairs of runs are looked at, and what each look may decide. Looking again and again finds chance: so
// the chances of error that the rule allows are shared out evenly over the looks (Bonferroni), and hold for
// the check as a whole. Before: pairs of fresh runs. After: a verdict, or more pairs.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "server/check/statistics/verdict.h"

namespace herr {

struct PairDesign {
  std::vector<int> looks{15, 20, 25, 30};  // after so many pairs; ascending, at most kMostPairs
  ShiftRule rule;                          // significance: of all looks together
  double tail = 0.05;                      // upper bounds too low in all looks together, at most
};

struct PairJudgement {
  Verdict verdict = Verdict::inconclusive;
  bool last_look = false;
  Shift shift;  // of logarithms; p times the number of looks, at most 1
};

// Of the differences of all pairs so far, ln(candidate / baseline). Their number is one of the design's
// looks; throws std::invalid_argument otherwise.
PairJudgement judge_pairs(std::span<const double> differences, const PairDesign& design);

// A last look where no more pairs come, after however many. It takes the share of the look that would have
// come next, so there are no more looks than the shares were made for. Which pair is the last must not depend
// on which program was slower in any: the end of a time limit does not, since a pair lasts as long with its
// two runs exchanged. Where there are fewer than fewest_pairs(design), the verdict stays open. 1 ... as many
// pairs as the last look has; throws std::invalid_argument otherwise.
PairJudgement judge_cut_short(std::span<const double> differences, const PairDesign& design);

// As few as can show a regression: all of them slower, which chance brings about once in 2^n, times the
// number of looks. A check that could not have failed does not pass either.
int fewest_pairs(const PairDesign& design);

}  // namespace herr
