// What a check may say, and how a shift with its bounds becomes a verdict. Missing data never passes: what is
// neither shown to be slower nor shown not to be stays open.
// Before: signed_rank, rank_sum. After: exit codes and reports.
#pragma once

#include "server/check/statistics/shift.h"

namespace herr {

// From good to bad.
enum class Verdict { ok, inconclusive, not_comparable, noisy, regression };
// "ok", "inconclusive", "not comparable", "noisy", "regression".
const char* name_of(Verdict verdict);
// What a check with two findings says: a regression that was found stays found.
Verdict worse_of(Verdict a, Verdict b);

// A shift of logarithms is a ratio: 0.03 stands for 3 % slower.
struct ShiftRule {
  double limit = 0.03;         // slower by more than this is a regression
  double significance = 0.01;  // chance of so large a shift, at most
};

// regression: p is at most the significance and the estimate is above the limit. ok: the upper bound is below
// the limit. Otherwise inconclusive. `shift` is one of natural logarithms of times.
Verdict verdict_of(const Shift& shift, const ShiftRule& rule);

}  // namespace herr
