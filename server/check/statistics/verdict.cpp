#include "server/check/statistics/verdict.h"

#include <algorithm>
#include <cmath>

namespace herr {

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::inconclusive:
      return "inconclusive";
    case Verdict::not_comparable:
      return "not comparable";
    case Verdict::noisy:
      return "noisy";
    case Verdict::regression:
      return "regression";
  }
  return "unknown";
}

Verdict worse_of(Verdict a, Verdict b) {
  return std::max(a, b);
}

Verdict verdict_of(const Shift& shift, const ShiftRule& rule) {
  const double limit = std::log1p(rule.limit);
  if (shift.p <= rule.significance && shift.estimate > limit) return Verdict::regression;
  return shift.upper < limit ? Verdict::ok : Verdict::inconclusive;
}

}  // namespace herr
